// Progress of a build, and the request to stop it.
#pragma once

#include "base/error.h"

#include <functional>
#include <mutex>
#include <utility>

namespace raywise {

class Progress {
public:
    // Called with a fraction from 0 to 1 and a constant text; returns true to cancel.
    using Callback = std::function<bool(double fraction, const char* stage)>;

    Progress() = default;
    explicit Progress(Callback callback) : callback_(std::move(callback)) {}

    // Reports; any thread may call. Throws Error(ERROR_CANCELLED) when the caller wants to stop, here and in every later call.
    void report(double fraction, const char* stage) {
        if (!callback_) return;
        const std::lock_guard lock(mutex_);
        if (!cancelled_) cancelled_ = callback_(fraction, stage);
        if (cancelled_) throw Error(Status::ERROR_CANCELLED, "commit: the progress callback asked to stop");
    }

private:
    Callback callback_;
    std::mutex mutex_;
    bool cancelled_ = false;
};

} // namespace raywise
