#include "accel/scan/linear_scan.h"

#include "accel/dense_region.h"
#include "geometry/corner_lines.h"

#include <algorithm>
#include <atomic>

namespace raywise {
namespace {

// Whole blocks; progress is reported after each task.
constexpr std::uint64_t blocks_per_task = 2048;

// Blocks of more triangles leave the second-level cache. Where triangles share their vertices a ray that comes alone then takes as long over
// them as by outcodes, and many at a time take longer: docs/decisions/0027-few-rays.md.
constexpr std::uint32_t most_gathered_beside_outcodes = 16384;

// As many rays as go through the triangles together, 16 by the widest registers, take 1.7 ns a triangle: 60 us, where waking a thread takes
// 25 at most. Fewer than go together are not worth a thread of their own, however long they take.
constexpr std::uint32_t fewest_triangles_for_thread = 32768;
constexpr std::size_t rays_for_thread = 16;

// Each of the triangles that tell where most are waits for memory that nothing else has asked for yet: 256 took half as long as one ray. A frame
// that is not quite in the middle costs a filter little.
constexpr std::uint32_t frame_sample = 16;

// Where most triangles are is not worth the question where they are a handful.
SceneFrame frame_of_bounds(const Box& bounds) {
    const double size = max_component(bounds.size());
    return {SceneFrame::choose_center(bounds.center(), size), size, bounds};
}

// A scan takes rays in float64: what widening them costs is nothing beside it.
RayPacket widened(const RayPacketF& rays, Scratch& scratch) {
    auto* const wide = scratch.take<Ray>(rays.count);
    for (std::size_t i = 0; i < rays.count; ++i) wide[i] = raywise::widened(rays.rays[i]);
    return {wide, rays.queries, rays.count};
}

} // namespace

LinearScan::LinearScan(const BuildInput& input) : primitives_(input.primitives) {
    if (primitives_.hittable_count() == 0) return;
    const bool is_tiny = primitives_.count() <= most_tested_singly;
    if (is_tiny && input.few_rays) return;
    frame_ = is_tiny ? frame_of_bounds(primitives_.outer_bounds()) : scene_frame(primitives_, frame_sample);
    if (input.few_rays) return;
    if (primitives_.count() > most_gathered_beside_outcodes && suit_outcodes(primitives_)) return;
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

std::size_t LinearScan::rays_worth_thread() const {
    return primitives_.count() >= fewest_triangles_for_thread ? rays_for_thread : 0;
}

PrimitiveHit LinearScan::closest(const Ray& ray, const Query& query) const {
    ClosestCollector collector(ray, query);
    scan_closest(scanned(), &ray, 1, &collector);
    return collector.best();
}

bool LinearScan::any(const Ray& ray, const Query& query) const {
    AnyCollector collector(ray, query);
    scan_any(scanned(), &ray, 1, &collector);
    return collector.found();
}

void LinearScan::all(const Ray& ray, const Query& query, std::vector<PrimitiveHit>& hits) const {
    AllCollector collector(ray, query, hits);
    scan_all(scanned(), ray, collector);
}

void LinearScan::closest_many(const RayPacket& rays, PrimitiveHit* hits, Scratch& scratch) const {
    const Collectors<ClosestCollector> collectors(rays, scratch);
    scan_closest(scanned(), rays.rays, rays.count, collectors.data());
    for (std::size_t i = 0; i < rays.count; ++i) hits[i] = collectors[i].best();
}

void LinearScan::any_many(const RayPacket& rays, bool* found, Scratch& scratch) const {
    const Collectors<AnyCollector> collectors(rays, scratch);
    scan_any(scanned(), rays.rays, rays.count, collectors.data());
    for (std::size_t i = 0; i < rays.count; ++i) found[i] = collectors[i].found();
}

void LinearScan::closest_many_f32(const RayPacketF& rays, PrimitiveHit* hits, Scratch& scratch) const {
    closest_many(widened(rays, scratch), hits, scratch);
}

void LinearScan::any_many_f32(const RayPacketF& rays, bool* found, Scratch& scratch) const {
    any_many(widened(rays, scratch), found, scratch);
}

} // namespace raywise
