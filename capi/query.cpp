#include "query.h"

#include "scene/explain.h"
#include "shared_memory.h"

namespace raywise::capi {
namespace {

Parallel read_query_parallel(const rw_query_options& options) {
    return read_parallel(options.threads, options.parallel_for, options.parallel_user);
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
    memory.writes("options.invalid_rays", options.invalid_rays, 1);
    return memory;
}

void report_invalid(const rw_query_options& options, std::uint64_t invalid) {
    if (options.invalid_rays != nullptr) *options.invalid_rays = invalid;
}

Error over_capacity(std::uint64_t needed, std::uint64_t capacity) {
    return {Status::ERROR_CAPACITY,
            "hits: there are " + std::to_string(needed) + ", capacity is " + std::to_string(capacity)};
}

} // namespace

void intersect_with(const Tracer& tracer, const rw_ray* ray, const rw_ray_options* options, rw_hit* hit) {
    const Ray& r = read_ray(ray);
    rw_hit& out = required(hit, "hit");
    std::vector<std::uint32_t> skips = read_skips(options, tracer.primitives());
    write_hit(tracer.closest(r, {sorted(skips)}), out);
}

void occluded_with(const Tracer& tracer, const rw_ray* ray, const rw_ray_options* options, std::int32_t* answer) {
    const Ray& r = read_ray(ray);
    std::int32_t& out = required(answer, "occluded");
    std::vector<std::uint32_t> skips = read_skips(options, tracer.primitives());
    out = tracer.any(r, {sorted(skips)}) ? 1 : 0;
}

void intersect_all_with(const Tracer& tracer, const rw_ray* ray, const rw_ray_options* options, rw_hit* hits,
                        std::uint64_t capacity, std::uint64_t* needed) {
    const Ray& r = read_ray(ray);
    std::uint64_t& count = required(needed, "needed");
    if (hits == nullptr && capacity > 0) throw null_argument("hits");
    std::vector<std::uint32_t> skips = read_skips(options, tracer.primitives());
    std::vector<Hit> found;
    tracer.all(r, found, {sorted(skips)});
    count = found.size();
    for (std::size_t i = 0; i < std::min<std::uint64_t>(capacity, found.size()); ++i) write_hit(found[i], hits[i]);
    if (hits != nullptr && found.size() > capacity) throw over_capacity(found.size(), capacity);
}

void intersect_batch(const Tracer& tracer, const rw_rays* rays, const rw_hits* hits, const rw_query_options* options) {
    const RayArrays in = read_checked_rays(rays, tracer);
    const HitArrays out = read_hits(hits, in.count);
    const rw_query_options o = read_optional_struct(options, "options");
    BatchMemory memory = memory_of(in, o);
    memory.writes(out, in.count);
    memory.refuse_shared();
    report_invalid(o, raywise::intersect_batch(tracer, in, out, read_query_parallel(o)));
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
    report_invalid(o, raywise::occluded_batch(tracer, in, out, read_query_parallel(o)));
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
    report_invalid(o, raywise::intersect_all_batch(tracer, in, offsets, out, capacity, count, read_query_parallel(o)));
    if (needed != nullptr) *needed = count;
    if (hits != nullptr && count > capacity) throw over_capacity(count, capacity);
}

void candidate_count(std::uint32_t* count) { required(count, "count") = static_cast<std::uint32_t>(structure_count); }

void get_candidate(const Plan& plan, const Tracer& tracer, std::uint32_t index, rw_candidate* candidate) {
    if (index >= structure_count) {
        throw Error(Status::ERROR_INVALID_ARGUMENT,
                    "index: " + std::to_string(index) + " is not below " + std::to_string(structure_count));
    }
    const CandidateReport report = report_candidate(plan, tracer, static_cast<Structure>(index));
    const PlannedCandidate& figures = report.figures;
    rw_candidate facts{};
    facts.flags = (report.chosen ? RW_CANDIDATE_CHOSEN : 0u) | (report.forced ? RW_CANDIDATE_FORCED : 0u) |
                  (figures.over_limit ? RW_CANDIDATE_OVER_LIMIT : 0u) |
                  (figures.measured ? RW_CANDIDATE_MEASURED : 0u) |
                  (figures.applicable ? 0u : RW_CANDIDATE_NOT_APPLICABLE);
    facts.structure = name_of(report.structure);
    facts.predicted_build_ns = figures.predicted.build_ns;
    facts.predicted_ray_ns = figures.predicted.ray_ns;
    facts.predicted_error = figures.predicted.error;
    facts.predicted_total_ns = report.predicted_total_ns;
    facts.break_even_rays = report.break_even_rays;
    facts.predicted_bytes = static_cast<std::uint64_t>(figures.predicted.bytes);
    facts.actual_bytes = figures.actual_bytes;
    facts.actual_build_ns = figures.actual_build_ns;
    facts.actual_ray_ns = figures.actual_ray_ns;
    write_struct(candidate, "candidate", facts);
}

std::int32_t explain(const Plan& plan, const Tracer& tracer, const Profile& profile, std::int32_t format, char* buffer,
                     std::uint64_t capacity, std::uint64_t* needed) {
    return write_text(is_json(format) ? explain_json(plan, tracer, profile) : explain_text(plan, tracer, profile),
                      buffer, capacity, needed);
}

} // namespace raywise::capi
