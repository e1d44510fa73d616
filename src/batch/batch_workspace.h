// The memory that batches take beside the caller's arrays: kept from one batch to the next, so that a batch like the last one takes none.
#pragma once

#include "base/page_array.h"
#include "base/scratch.h"
#include "batch/batch_progress.h"
#include "batch/ray_window.h"
#include "batch/skip_arrays.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace raywise {

// All hits of a ray, in the memory of the thread that found them.
struct HitsOfRay {
    const PrimitiveHit* hits;
    std::uint64_t count;
    std::uint64_t first; // how many the rays before have
};

class BatchWorkspace {
public:
    // What one thread takes.
    struct alignas(64) PerThread {
        Scratch scratch;                // for the arrays of a block
        std::vector<PrimitiveHit> hits; // all hits of a block
        Scratch kept_hits;              // the same of all blocks
        SkipBlock skips;
        BlockPace pace;
        double quickest = 0.0;     // of its blocks in a window: nanoseconds a ray
        std::uint64_t invalid = 0; // of all of its rays, how many held a NaN
    };

    // Has the workspace to itself as long as it lives. Throws Error(ERROR_IN_USE) when another batch has.
    class Use {
    public:
        Use(BatchWorkspace& workspace, unsigned threads);
        ~Use() { workspace_.is_used_.store(false, std::memory_order_release); }
        Use(const Use&) = delete;
        Use& operator=(const Use&) = delete;

        WindowMemory& window() const { return workspace_.window_; }
        std::vector<PerThread>& threads() const { return workspace_.threads_; }
        // One for each of the rays of a batch that asks for all hits.
        HitsOfRay* hits_of_rays(std::size_t rays) const;

    private:
        BatchWorkspace& workspace_;
    };

private:
    std::atomic<bool> is_used_{false};
    WindowMemory window_;
    std::vector<PerThread> threads_;
    PageArray<HitsOfRay> hits_of_rays_;
};

} // namespace raywise
