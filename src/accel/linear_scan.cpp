#include "accel/linear_scan.h"

#include "accel/linear_scan_kernels.h"
#include "geometry/corner_lines.h"

#include <algorithm>
#include <atomic>

namespace raywise {
namespace {

// Whole blocks; progress is reported after each task.
constexpr std::uint64_t blocks_per_task = 2048;

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

SurfaceHit LinearScan::closest(const PreparedRay& ray) const {
    SurfaceHit hit;
    closest_many(&ray, 1, &hit);
    return hit;
}

bool LinearScan::any(const PreparedRay& ray) const {
    bool found = false;
    any_many(&ray, 1, &found);
    return found;
}

void LinearScan::all(const PreparedRay& ray, std::vector<PrimitiveHit>& hits) const {
    if (primitives_.hittable_count() == 0) return;
    scan_all({primitives_, frame_, blocks_.empty() ? nullptr : blocks_.data()}, ray, hits);
}

void LinearScan::closest_many(const PreparedRay* rays, std::size_t count, SurfaceHit* hits) const {
    if (primitives_.hittable_count() == 0) {
        std::fill_n(hits, count, SurfaceHit{});
    } else {
        scan_closest({primitives_, frame_, blocks_.empty() ? nullptr : blocks_.data()}, rays, count, hits);
    }
}

void LinearScan::any_many(const PreparedRay* rays, std::size_t count, bool* found) const {
    if (primitives_.hittable_count() == 0) {
        std::fill_n(found, count, false);
    } else {
        scan_any({primitives_, frame_, blocks_.empty() ? nullptr : blocks_.data()}, rays, count, found);
    }
}

} // namespace raywise
