#include "batch/batch.h"

#include "base/scratch.h"
#include "batch/ray_order.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <vector>

namespace raywise {
namespace {

// Fewer rays than this are answered on the caller's thread: waking another costs more.
constexpr std::uint64_t fewest_rays = 256;

// Several blocks for each thread balance uneven work.
constexpr std::uint64_t blocks_per_thread = 8;

// Rays put in order together, where the structure takes one at a time: many more, and each part of the scene would be come to once;
// many fewer, and their keys stay in the caches.
constexpr std::uint64_t rays_per_order = 8192;

// Rays read from the caller's arrays.
struct RayBlock {
    std::uint64_t first = 0; // the number of its first ray in the batch
    std::size_t size = 0;
    Ray* rays = nullptr;
    SkipBlock skips;
    Scratch scratch; // for whatever the block takes
};

bool takes_many(const Tracer& tracer) { return tracer.accel().rays_at_a_time() > 1; }

// Calls body(block) for all rays, on several threads. Returns how many of the rays held a NaN, and notes the time. Each thread takes the
// next block that nobody has taken, so that all end at about the same time, and keeps its memory from one to the next.
template <class Body>
std::uint64_t for_blocks(const Tracer& tracer, const RayArrays& rays, const Parallel& parallel, const Body& body) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const std::uint64_t most = takes_many(tracer) ? tracer.accel().rays_at_a_time() : rays_per_order;
    const std::uint64_t even = (rays.count + parallel.threads() - 1) / parallel.threads();
    const std::uint64_t size = std::clamp(even / blocks_per_thread, fewest_rays, most);
    const std::uint64_t blocks = (rays.count + size - 1) / size;
    std::atomic<std::uint64_t> next{0};
    std::atomic<std::uint64_t> invalid{0};
    parallel.for_each(std::min<std::uint64_t>(parallel.threads(), blocks), [&](std::uint64_t) {
        RayBlock block;
        for (std::uint64_t i = next.fetch_add(1); i < blocks; i = next.fetch_add(1)) {
            block.scratch.reset();
            block.first = i * size;
            block.size = std::min(size, rays.count - block.first);
            block.rays = block.scratch.take<Ray>(block.size);
            invalid.fetch_add(rays.read(block.first, block.size, block.rays), std::memory_order_relaxed);
            block.skips.read(rays.skip, block.first, block.size, tracer.primitives());
            body(block);
        }
    });
    const auto ns = std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
    tracer.usage().rays.fetch_add(rays.count, std::memory_order_relaxed);
    tracer.usage().batch_ns.fetch_add(static_cast<std::uint64_t>(ns), std::memory_order_relaxed);
    return invalid.load();
}

// answer(k, ray, skip) for each ray: near ones one after the other.
template <class Answer>
void for_each_in_order(const Tracer& tracer, const RayBlock& block, const Answer& answer) {
    RayOrder order(tracer.primitives().bounds());
    const std::vector<std::uint32_t>& sorted = order.sort(block.rays, block.size);
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        __builtin_prefetch(&block.rays[sorted[std::min(i + 4, sorted.size() - 1)]]);
        const std::uint32_t k = sorted[i];
        answer(k, block.rays[k], block.skips[k]);
    }
}

// A structure that takes many rays at a time does not look for those with a NaN.
std::uint64_t count_invalid(const Tracer& tracer, std::uint64_t invalid) {
    if (takes_many(tracer)) tracer.usage().invalid_rays.fetch_add(invalid, std::memory_order_relaxed);
    return invalid;
}

void write_hits(const Tracer& tracer, const RayBlock& block, const SurfaceHits& found, const HitArrays& hits) {
    constexpr std::size_t together = 64; // few enough to stay at hand between the two loops
    Hit as_asked[together];
    for (std::size_t begin = 0; begin < block.size; begin += together) {
        const std::size_t n = std::min(together, block.size - begin);
        for (std::size_t k = 0; k < n; ++k) {
            const std::size_t i = begin + k;
            as_asked[k] = tracer.to_caller(block.rays[i], found.hits[i], found.corners[i]);
        }
        hits.write(block.first + begin, n, as_asked);
    }
}

} // namespace

std::uint64_t intersect_batch(const Tracer& tracer, const RayArrays& rays, const HitArrays& hits,
                              const Parallel& parallel) {
    const std::uint64_t invalid = for_blocks(tracer, rays, parallel, [&](RayBlock& block) {
        if (takes_many(tracer)) {
            const SurfaceHits found{block.scratch.take<PrimitiveHit>(block.size),
                                    block.scratch.take<Corners>(block.size)};
            tracer.accel().closest_many({block.rays, block.skips.data(), block.size, tracer.primitives().bounds()},
                                        found, block.scratch);
            write_hits(tracer, block, found, hits);
        } else {
            Hit* const found = block.scratch.take<Hit>(block.size);
            for_each_in_order(tracer, block, [&](std::size_t k, const Ray& ray, SkipList skip) {
                found[k] = tracer.closest(ray, skip);
            });
            hits.write(block.first, block.size, found);
        }
    });
    return count_invalid(tracer, invalid);
}

std::uint64_t occluded_batch(const Tracer& tracer, const RayArrays& rays, const OutputArray& occluded,
                             const Parallel& parallel) {
    const std::uint64_t invalid = for_blocks(tracer, rays, parallel, [&](RayBlock& block) {
        bool* const found = block.scratch.take<bool>(block.size);
        if (takes_many(tracer)) {
            tracer.accel().any_many({block.rays, block.skips.data(), block.size, tracer.primitives().bounds()}, found,
                                    block.scratch);
        } else {
            for_each_in_order(tracer, block,
                              [&](std::size_t k, const Ray& ray, SkipList skip) { found[k] = tracer.any(ray, skip); });
        }
        occluded.write(block.first, block.size, found);
    });
    return count_invalid(tracer, invalid);
}

std::uint64_t intersect_all_batch(const Tracer& tracer, const RayArrays& rays, std::uint64_t* offsets,
                                  const HitArrays& hits, std::uint64_t capacity, std::uint64_t& needed,
                                  const Parallel& parallel) {
    std::vector<std::vector<Hit>> found(rays.count);
    const std::uint64_t invalid = for_blocks(tracer, rays, parallel, [&](RayBlock& block) {
        for_each_in_order(tracer, block, [&](std::size_t k, const Ray& ray, SkipList skip) {
            tracer.all(ray, found[block.first + k], skip);
        });
    });
    std::vector<std::uint64_t> first(rays.count + 1, 0);
    for (std::uint64_t i = 0; i < rays.count; ++i) first[i + 1] = first[i] + found[i].size();
    if (first.back() <= capacity) {
        parallel.for_blocks(rays.count, fewest_rays, [&](std::uint64_t begin, std::uint64_t end) {
            for (std::uint64_t i = begin; i < end; ++i) hits.write(first[i], found[i].size(), found[i].data());
        });
    }
    // Last, so that an error before leaves the caller's offsets alone.
    std::copy(first.begin(), first.end(), offsets);
    needed = first.back();
    return invalid;
}

} // namespace raywise
