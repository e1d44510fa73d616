#include "query.h"

#include "shared_memory.h"

namespace raywise::capi {
namespace {

BatchOptions read_batch_options(const rw_query_options& options) {
    BatchOptions result;
    result.parallel = read_parallel(options.threads, options.parallel_for, options.parallel_user);
    result.watch = read_watch(options);
    if (options.workspace != nullptr) result.workspace = &options.workspace->value;
    return result;
}

RayArrays read_checked_rays(const rw_rays* rays, const Tracer& tracer) {
    RayArrays arrays = read_rays(rays, "rays");
    arrays.skip.check(arrays.count, tracer.primitives());
    return arrays;
}

// What every batch reads and writes.
BatchMemory memory_of(const RayArrays& rays, const rw_query_options& options) {
    BatchMemory memory;
    memory.reads(rays);
    memory.reads("options.cancel", options.cancel);
    memory.writes("options.invalid_rays", options.invalid_rays, 1);
    return memory;
}

void report_invalid(const rw_query_options& options, std::uint64_t invalid) {
    if (options.invalid_rays != nullptr) *options.invalid_rays = invalid;
}

} // namespace

Error over_capacity(std::uint64_t needed, std::uint64_t capacity) {
    return {Status::ERROR_CAPACITY,
            "hits: there are " + std::to_string(needed) + ", capacity is " + std::to_string(capacity)};
}

template <class AnyRay>
Hit closest_with(const Tracer& tracer, const AnyRay& ray, const rw_ray_options& options) {
    std::vector<std::uint32_t> skips = read_skips(options, tracer.primitives());
    return tracer.closest(ray, {sorted(skips)});
}
template Hit closest_with(const Tracer&, const Ray&, const rw_ray_options&);
template Hit closest_with(const Tracer&, const RayF&, const rw_ray_options&);

template <class AnyRay>
bool any_with(const Tracer& tracer, const AnyRay& ray, const rw_ray_options& options) {
    std::vector<std::uint32_t> skips = read_skips(options, tracer.primitives());
    return tracer.any(ray, {sorted(skips)});
}
template bool any_with(const Tracer&, const Ray&, const rw_ray_options&);
template bool any_with(const Tracer&, const RayF&, const rw_ray_options&);

std::vector<Hit> all_with(const Tracer& tracer, const Ray& ray, const rw_ray_options* options) {
    std::vector<std::uint32_t> skips;
    if (options != nullptr) skips = read_skips(*options, tracer.primitives());
    std::vector<Hit> found;
    tracer.all(ray, found, {sorted(skips)});
    return found;
}

Vec3 checked_normal(const Tracer& tracer, std::uint32_t instance, std::uint32_t geometry, std::uint32_t primitive) {
    if (primitive == invalid_id) throw Error(Status::ERROR_INVALID_ARGUMENT, "hit: it is a miss, which has no normal");
    const Primitives& primitives = tracer.primitives();
    const std::uint32_t number = number_of({instance, geometry, primitive}, primitives, "hit");
    if (!primitives.is_hittable(number)) {
        throw Error(Status::ERROR_INVALID_ARGUMENT, "hit: primitive " + std::to_string(primitive) + " of geometry " +
                                                        std::to_string(geometry) +
                                                        " has no area or is not valid: no ray hits it");
    }
    return unit_normal(primitives.corners(number));
}

void intersect_batch(const Tracer& tracer, const rw_rays* rays, const rw_hits* hits, const rw_query_options* options) {
    const RayArrays in = read_checked_rays(rays, tracer);
    const HitArrays out = read_hits(hits, in.count);
    const rw_query_options o = read_optional_struct(options, "options");
    BatchMemory memory = memory_of(in, o);
    memory.writes(out, in.count);
    memory.refuse_shared();
    report_invalid(o, raywise::intersect_batch(tracer, in, out, read_batch_options(o)));
}

void occluded_batch(const Tracer& tracer, const rw_rays* rays, const rw_output* answers,
                    const rw_query_options* options) {
    const RayArrays in = read_checked_rays(rays, tracer);
    const OutputArray out = read_output(required(answers, "occluded"), in.count, 1, OutputKind::flags, "occluded");
    if (!out.wanted() && in.count > 0) throw Error(Status::ERROR_INVALID_ARGUMENT, "occluded: data is NULL");
    const rw_query_options o = read_optional_struct(options, "options");
    BatchMemory memory = memory_of(in, o);
    memory.writes("occluded", out, in.count, 1);
    memory.refuse_shared();
    report_invalid(o, raywise::occluded_batch(tracer, in, out, read_batch_options(o)));
}

void intersect_all_batch(const Tracer& tracer, const rw_rays* rays, std::uint64_t* offsets, const rw_hits* hits,
                         std::uint64_t capacity, std::uint64_t* needed, const rw_query_options* options) {
    const RayArrays in = read_checked_rays(rays, tracer);
    required(offsets, "offsets");
    if (hits == nullptr && capacity > 0) throw null_argument("hits");
    const HitArrays out = hits != nullptr ? read_hits(hits, capacity) : HitArrays{};
    const rw_query_options o = read_optional_struct(options, "options");
    BatchMemory memory = memory_of(in, o);
    memory.writes("offsets", offsets, in.count + 1);
    memory.writes("needed", needed, 1);
    memory.writes(out, capacity);
    memory.refuse_shared();
    std::uint64_t count = 0;
    report_invalid(o, raywise::intersect_all_batch(tracer, in, offsets, out, capacity, count, read_batch_options(o)));
    if (needed != nullptr) *needed = count;
    if (hits != nullptr && count > capacity) throw over_capacity(count, capacity);
}

} // namespace raywise::capi
