// Scenes made from each other, frame after frame: what the released ones had, and what building took, is kept for the next one.
#pragma once

#include "base/page_pool.h"

#include <atomic>
#include <optional>

namespace raywise {

// One for all scenes that were made from each other; memory is kept as long as one of them lives. Any number of threads may make frames.
class FrameMemory {
public:
    // Whoever moves a scene once and for all has no use for it: memory is kept from the second frame on.
    void begin_frame() noexcept {
        if (frames_.fetch_add(1) == 1) keep_.emplace();
    }

private:
    std::atomic<unsigned long> frames_{0};
    std::optional<KeepPages> keep_; // written by one thread, and looked at when no other is left
};

} // namespace raywise
