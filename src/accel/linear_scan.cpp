#include "accel/linear_scan.h"

#include "geometry/corner_lines.h"

#include <algorithm>
#include <atomic>

namespace raywise {
namespace {

// Whole blocks; progress is reported after each task.
constexpr std::uint64_t blocks_per_task = 2048;

// Those of many rays that can hit something, and which they are.
struct TraceableRays {
    TraceableRays(const UnpreparedRays& all, Scratch& scratch)
        : rays(scratch.take<PreparedRay>(all.count)), index(scratch.take<std::size_t>(all.count)) {
        for (std::size_t i = 0; i < all.count; ++i) {
            if (!PreparedRay::is_traceable(all.rays[i])) continue;
            rays[count] = all[i].prepare();
            index[count++] = i;
        }
    }

    PreparedRay* const rays;
    std::size_t* const index;
    std::size_t count = 0;
};

} // namespace

LinearScan::LinearScan(const BuildInput& input) : primitives_(input.primitives) {
    if (primitives_.hittable_count() == 0) return;
    frame_ = SceneFrame(primitives_.bounds());
    if (input.few_rays) return;
    const std::size_t size = corner_blocks_for(primitives_.count()) * corner_block_numbers;
    // Without blocks a scan is slower; that is no reason to have none.
    if (input.memory_limit != 0 && sizeof *this + size * sizeof(float) > input.memory_limit) return;
    blocks_ = PageArray<float>(size);
    gather(input);
}

void LinearScan::gather(const BuildInput& input) {
    const std::uint64_t blocks = corner_blocks_for(primitives_.count());
    std::atomic<std::uint64_t> done{0};
    input.parallel.for_each((blocks + blocks_per_task - 1) / blocks_per_task, [&](std::uint64_t task) {
        const std::uint64_t begin = task * blocks_per_task;
        const std::uint64_t end = std::min(blocks, begin + blocks_per_task);
        gather_blocks(primitives_, frame_, static_cast<std::uint32_t>(begin * corner_block),
                      static_cast<std::uint32_t>(std::min<std::uint64_t>(primitives_.count(), end * corner_block)),
                      blocks_.data() + begin * corner_block_numbers);
        input.progress.report(static_cast<double>(done += end - begin) / static_cast<double>(blocks), "linear_scan");
    });
}

ScannedScene LinearScan::scanned() const { return {primitives_, frame_, blocks_.empty() ? nullptr : blocks_.data()}; }

SurfaceHit LinearScan::closest(const PreparedRay& ray) const {
    SurfaceHit hit;
    if (primitives_.hittable_count() > 0) scan_closest(scanned(), &ray, 1, &hit);
    return hit;
}

bool LinearScan::any(const PreparedRay& ray) const {
    bool found = false;
    if (primitives_.hittable_count() > 0) scan_any(scanned(), &ray, 1, &found);
    return found;
}

void LinearScan::all(const PreparedRay& ray, std::vector<PrimitiveHit>& hits) const {
    if (primitives_.hittable_count() > 0) scan_all(scanned(), ray, hits);
}

void LinearScan::closest_many(const UnpreparedRays& rays, const SurfaceHits& hits, Scratch& scratch) const {
    std::fill_n(hits.hits, rays.count, PrimitiveHit{});
    if (primitives_.hittable_count() == 0) return;
    const TraceableRays traceable(rays, scratch);
    auto* const found = scratch.take<SurfaceHit>(traceable.count);
    scan_closest(scanned(), traceable.rays, traceable.count, found);
    for (std::size_t k = 0; k < traceable.count; ++k) hits.put(traceable.index[k], found[k]);
}

void LinearScan::any_many(const UnpreparedRays& rays, bool* found, Scratch& scratch) const {
    std::fill_n(found, rays.count, false);
    if (primitives_.hittable_count() == 0) return;
    const TraceableRays traceable(rays, scratch);
    auto* const answers = scratch.take<bool>(traceable.count);
    scan_any(scanned(), traceable.rays, traceable.count, answers);
    for (std::size_t k = 0; k < traceable.count; ++k) found[traceable.index[k]] = answers[k];
}

} // namespace raywise
