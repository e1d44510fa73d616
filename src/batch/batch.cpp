#include "batch/batch.h"

#include "batch/ray_order.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

namespace raywise {
namespace {

// Rays handed to a thread at once. Fewer than this are answered on the caller's thread: waking another costs more.
constexpr std::uint64_t rays_per_task = 256;

// Rays put in order together: many more, and each part of the scene would be come to once; many fewer, and their keys stay in the
// caches.
constexpr std::uint64_t rays_per_order = 8192;

template <class T>
void store(std::byte* address, T value) {
    std::memcpy(address, &value, sizeof value); // the caller's arrays need not be aligned
}

// Calls body(begin, end) for all rays, on several threads, each returning how many of its rays held a NaN. Returns the sum, and notes the
// time.
template <class Body>
std::uint64_t for_rays(const Tracer& tracer, const RayArrays& rays, const Parallel& parallel, const Body& body) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    std::atomic<std::uint64_t> invalid{0};
    parallel.for_blocks(rays.count, rays_per_task, [&](std::uint64_t begin, std::uint64_t end) {
        invalid.fetch_add(body(begin, end), std::memory_order_relaxed);
    });
    const auto ns = std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
    tracer.usage().rays.fetch_add(rays.count, std::memory_order_relaxed);
    tracer.usage().batch_ns.fetch_add(static_cast<std::uint64_t>(ns), std::memory_order_relaxed);
    return invalid.load();
}

// Reads rays first ... first + block.size() - 1.
std::uint64_t read_block(const RayArrays& rays, std::uint64_t first, std::vector<Ray>& block) {
    std::uint64_t invalid = 0;
    for (std::size_t k = 0; k < block.size(); ++k) {
        block[k] = rays.ray(first + k);
        invalid += block[k].has_nan() ? 1 : 0;
    }
    return invalid;
}

// answer(i, ray, skip) for each ray: near ones one after the other.
template <class Answer>
std::uint64_t for_each_ray(const Tracer& tracer, const RayArrays& rays, const Parallel& parallel,
                           const Answer& answer) {
    return for_rays(tracer, rays, parallel, [&](std::uint64_t begin, std::uint64_t end) {
        RayOrder order(tracer.primitives().bounds());
        std::vector<Ray> block;
        std::vector<std::uint32_t> skipped;
        std::uint64_t invalid = 0;
        for (std::uint64_t first = begin; first < end; first += rays_per_order) {
            block.resize(std::min(rays_per_order, end - first));
            invalid += read_block(rays, first, block);
            const std::vector<std::uint32_t>& sorted = order.sort(block);
            for (std::size_t i = 0; i < sorted.size(); ++i) {
                __builtin_prefetch(&block[sorted[std::min(i + 4, sorted.size() - 1)]]);
                const std::uint32_t k = sorted[i];
                answer(first + k, block[k], rays.skip.of_ray(first + k, tracer.primitives(), skipped));
            }
        }
        return invalid;
    });
}

// answer(first, rays, skips, count) for as many rays at a time as the structure asks for.
template <class Answer>
std::uint64_t for_each_group(const Tracer& tracer, const RayArrays& rays, const Parallel& parallel,
                             const Answer& answer) {
    const std::size_t size = tracer.accel().rays_at_a_time();
    return for_rays(tracer, rays, parallel, [&](std::uint64_t begin, std::uint64_t end) {
        std::vector<Ray> block;
        std::vector<std::vector<std::uint32_t>> skipped(size);
        std::vector<SkipList> skips(size);
        std::uint64_t invalid = 0;
        for (std::uint64_t first = begin; first < end; first += size) {
            block.resize(std::min<std::uint64_t>(size, end - first));
            invalid += read_block(rays, first, block);
            for (std::size_t k = 0; k < block.size(); ++k)
                skips[k] = rays.skip.of_ray(first + k, tracer.primitives(), skipped[k]);
            answer(first, block.data(), skips.data(), block.size());
        }
        return invalid;
    });
}

} // namespace

Ray RayArrays::ray(std::uint64_t i) const {
    Ray ray;
    ray.origin = origin.vec3(i);
    ray.direction = direction.vec3(i);
    if (tmin.data != nullptr) ray.tmin = tmin.number(i);
    if (tmax.data != nullptr) ray.tmax = tmax.number(i);
    return ray;
}

void OutputArray::put_number(std::uint64_t element, int component, double value) const {
    std::byte* address = data + static_cast<std::ptrdiff_t>(element) * stride + component * component_stride;
    if (scalar == Scalar::float32) {
        store(address, static_cast<float>(value));
    } else {
        store(address, value);
    }
}

void OutputArray::put_integer(std::uint64_t element, std::uint64_t value) const {
    std::byte* address = data + static_cast<std::ptrdiff_t>(element) * stride;
    if (scalar == Scalar::uint8) {
        store(address, static_cast<std::uint8_t>(value));
    } else if (scalar == Scalar::uint32) {
        store(address, static_cast<std::uint32_t>(value));
    } else {
        store(address, value);
    }
}

void OutputArray::put_id(std::uint64_t element, std::uint32_t id) const {
    put_integer(element, id == invalid_id ? std::numeric_limits<std::uint64_t>::max() : id);
}

void HitArrays::put(std::uint64_t element, const Hit& hit) const {
    if (t.wanted()) t.put_number(element, 0, hit.t);
    if (uv.wanted()) {
        uv.put_number(element, 0, hit.u);
        uv.put_number(element, 1, hit.v);
    }
    if (normal.wanted()) {
        for (int axis = 0; axis < 3; ++axis) normal.put_number(element, axis, hit.normal[axis]);
    }
    if (instance.wanted()) instance.put_id(element, hit.instance);
    if (geometry.wanted()) geometry.put_id(element, hit.geometry);
    if (primitive.wanted()) primitive.put_id(element, hit.primitive);
}

std::uint64_t intersect_batch(const Tracer& tracer, const RayArrays& rays, const HitArrays& hits,
                              const Parallel& parallel) {
    if (tracer.accel().rays_at_a_time() == 1) {
        return for_each_ray(tracer, rays, parallel, [&](std::uint64_t i, const Ray& ray, SkipList skip) {
            hits.put(i, tracer.closest(ray, skip));
        });
    }
    return for_each_group(tracer, rays, parallel,
                          [&](std::uint64_t first, const Ray* group, const SkipList* skips, std::size_t count) {
                              std::vector<Hit> found(count);
                              tracer.closest_many(group, skips, count, found.data());
                              for (std::size_t k = 0; k < count; ++k) hits.put(first + k, found[k]);
                          });
}

std::uint64_t occluded_batch(const Tracer& tracer, const RayArrays& rays, const OutputArray& occluded,
                             const Parallel& parallel) {
    if (tracer.accel().rays_at_a_time() == 1) {
        return for_each_ray(tracer, rays, parallel, [&](std::uint64_t i, const Ray& ray, SkipList skip) {
            occluded.put_integer(i, tracer.any(ray, skip) ? 1 : 0);
        });
    }
    return for_each_group(tracer, rays, parallel,
                          [&](std::uint64_t first, const Ray* group, const SkipList* skips, std::size_t count) {
                              const auto found = std::make_unique<bool[]>(count);
                              tracer.any_many(group, skips, count, found.get());
                              for (std::size_t k = 0; k < count; ++k) occluded.put_integer(first + k, found[k] ? 1 : 0);
                          });
}

std::uint64_t intersect_all_batch(const Tracer& tracer, const RayArrays& rays, std::uint64_t* offsets,
                                  const HitArrays& hits, std::uint64_t capacity, std::uint64_t& needed,
                                  const Parallel& parallel) {
    std::vector<std::vector<Hit>> found(rays.count);
    const std::uint64_t invalid =
        for_each_ray(tracer, rays, parallel,
                     [&](std::uint64_t i, const Ray& ray, SkipList skip) { tracer.all(ray, found[i], skip); });
    std::vector<std::uint64_t> first(rays.count + 1, 0);
    for (std::uint64_t i = 0; i < rays.count; ++i) first[i + 1] = first[i] + found[i].size();
    if (first.back() <= capacity) {
        parallel.for_blocks(rays.count, rays_per_task, [&](std::uint64_t begin, std::uint64_t end) {
            for (std::uint64_t i = begin; i < end; ++i) {
                for (std::size_t k = 0; k < found[i].size(); ++k) hits.put(first[i] + k, found[i][k]);
            }
        });
    }
    // Last, so that an error before leaves the caller's offsets alone.
    std::copy(first.begin(), first.end(), offsets);
    needed = first.back();
    return invalid;
}

} // namespace raywise
