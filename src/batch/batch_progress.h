// How far a batch is, and the request to stop it: looked at by each of its threads between blocks.
#pragma once

#include "base/parallel.h"
#include "base/progress.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <thread>

namespace raywise {

// What the caller of a batch watches it with.
struct BatchWatch {
    Progress::Callback progress;                   // empty: none
    const volatile std::int32_t* cancel = nullptr; // not 0: stop; anybody may set it at any time; null: none

    // By a load that no compiler may leave out or repeat, and that may race with the host's store.
    bool is_cancelled() const { return cancel != nullptr && __atomic_load_n(cancel, __ATOMIC_RELAXED) != 0; }
};

class BatchProgress {
public:
    // rays: of the batch. Made by the thread that asks for it.
    BatchProgress(const BatchWatch& watch, std::uint64_t rays, const Parallel& parallel);

    bool is_watched() const { return watch_.cancel != nullptr || watch_.progress; }

    // Reports, when the last report was a while ago. Throws Error(ERROR_CANCELLED) when the caller wants to stop, on every thread.
    void poll() {
        if (is_watched()) look();
    }
    void add(std::uint64_t rays) {
        if (is_watched()) done_.fetch_add(rays, std::memory_order_relaxed);
    }
    // All is done; reports that in any case. Throws as poll().
    void finish();

private:
    using Clock = std::chrono::steady_clock;
    void look();
    void report(const char* stage);
    void throw_if_stopped() const;
    double fraction() const;

    const BatchWatch& watch_;
    const std::uint64_t rays_;
    // Only in a loop of the host's, of which the thread that asks need not be one. Else it is that thread alone that calls back: what
    // the callback touches may belong to it, as an interpreter's signals belong to the main thread.
    const bool any_thread_reports_;
    const std::thread::id caller_ = std::this_thread::get_id();
    std::atomic<std::uint64_t> done_{0};
    std::atomic<const char*> stopped_by_{nullptr};
    std::mutex reporting_;
    Clock::time_point next_report_{}; // the first poll reports
};

// How many rays a thread takes from one poll to the next: as many as take about so long.
class BlockPace {
public:
    std::uint64_t rays(std::uint64_t most) const { return next_ < most ? next_ : most; }
    void took(std::uint64_t rays, double ns);

private:
    std::uint64_t next_ = 8; // few enough for the slowest structure, whose rays are not timed yet
};

} // namespace raywise
