#include "fuzz/questions.h"

#include "fuzz/callbacks.h"
#include "fuzz/caller_struct.h"
#include "fuzz/rays.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

namespace raywise::fuzz {
namespace {

constexpr unsigned char blank = 0xC3;

bool same_bits(const rw_hit& a, const rw_hit& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

[[noreturn]] void disagree(const Asked& asked, const char* question, const rw_ray& ray, const rw_hit& wanted,
                           const rw_hit& found) {
    describe(ray);
    fail(
        "%s, %s: the judge says t %a u %a v %a geometry %u primitive %u, it says t %a u %a v %a geometry %u primitive "
        "%u",
        asked.name().c_str(), question, wanted.t, wanted.u, wanted.v, wanted.geometry, wanted.primitive, found.t,
        found.u, found.v, found.geometry, found.primitive);
}

// The same numbers in float32, as far as they are: the answer to those, rounded.
void ask_narrow(const Asked& asked, const rw_ray& ray, const rw_ray_options* options) {
    rw_ray_f32 narrow;
    rw_ray wide;
    for (int axis = 0; axis < 3; ++axis) {
        wide.origin[axis] = narrow.origin[axis] = static_cast<float>(ray.origin[axis]);
        wide.direction[axis] = narrow.direction[axis] = static_cast<float>(ray.direction[axis]);
    }
    wide.tmin = narrow.tmin = static_cast<float>(ray.tmin);
    wide.tmax = narrow.tmax = static_cast<float>(ray.tmax);
    rw_hit hit;
    rw_hit_f32 rounded;
    Outcome("intersect").check(asked.intersect(&wide, options, &hit));
    Outcome("intersect_f32").check(asked.intersect(&narrow, options, &rounded));
    const bool same = rounded.t == static_cast<float>(hit.t) && rounded.u == static_cast<float>(hit.u) &&
                      rounded.v == static_cast<float>(hit.v) && rounded.instance == hit.instance &&
                      rounded.geometry == hit.geometry && rounded.primitive == hit.primitive;
    if (!same) {
        describe(wide);
        fail("%s: in float32 t %a u %a v %a primitive %u, in float64 t %a u %a v %a primitive %u", asked.name().c_str(),
             static_cast<double>(rounded.t), static_cast<double>(rounded.u), static_cast<double>(rounded.v),
             rounded.primitive, hit.t, hit.u, hit.v, hit.primitive);
    }
    if (asked.usage() != nullptr && has_nan(wide)) asked.usage()->nan_rays += 2;
}

void ask_ray(Input& input, const Asked& asked, const rw_ray& ray, const Skips& skips,
             const std::vector<rw_hit>& wanted) {
    const rw_ray_options skipping = options_of(skips);
    const rw_ray_options* options = skips.empty() && input.one_in(2) ? nullptr : &skipping;
    const rw_hit closest = wanted.empty() ? miss() : wanted.front();
    rw_hit hit;
    std::memset(&hit, blank, sizeof hit);
    Outcome("intersect").check(asked.intersect(&ray, options, &hit));
    if (!same_bits(hit, closest)) disagree(asked, "closest hit", ray, closest, hit);

    ask_narrow(asked, ray, options);

    std::int32_t occluded = 77;
    Outcome("occluded").check(asked.occluded(&ray, options, &occluded));
    if (occluded != (wanted.empty() ? 0 : 1))
        disagree(asked, occluded != 0 ? "any hit (yes)" : "any hit (no)", ray, closest, hit);

    // One place too few, as many as there are, or one too many.
    std::uint64_t capacity = wanted.size() + 1 - input.below(3);
    if (capacity > wanted.size() + 1) capacity = 0;
    std::vector<rw_hit> hits(capacity + 1);
    std::memset(hits.data(), blank, hits.size() * sizeof(rw_hit));
    const rw_hit untouched = hits.back();
    std::uint64_t needed = 77;
    Outcome("intersect_all")
        .fails_if(wanted.size() > capacity, RW_ERROR_CAPACITY)
        .check(asked.intersect_all(&ray, options, hits.data(), capacity, &needed));
    if (needed != wanted.size()) {
        describe(ray);
        fail("%s: the judge finds %zu hits, it finds %llu", asked.name().c_str(), wanted.size(),
             static_cast<unsigned long long>(needed));
    }
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const rw_hit& right = i < std::min<std::uint64_t>(capacity, wanted.size()) ? wanted[i] : untouched;
        if (!same_bits(hits[i], right)) disagree(asked, "all hits", ray, right, hits[i]);
    }
    if (asked.usage() != nullptr && has_nan(ray)) asked.usage()->nan_rays += 3;
}

// The options of a batch, and whether they are in order.
struct Query {
    Query(Input& input, const Workspace& workspace) : loop(input) {
        if (input.one_in(2)) return;
        rw_query_options o{};
        o.threads = input.pick({0u, 0u, 1u, 2u, 3u, 1000u});
        o.parallel_for = loop.function();
        o.parallel_user = loop.user();
        if (input.one_in(2)) o.invalid_rays = &invalid_rays;
        wants_invalid = o.invalid_rays != nullptr;
        if (input.one_in(4)) o.progress = go_on;
        if (input.one_in(4)) o.cancel = &cancel;
        if (o.cancel != nullptr && input.one_in(4)) cancel = input.pick({1, -1, 256});
        if (input.one_in(2)) o.workspace = workspace.get();
        options.emplace(input, o);
    }
    const rw_query_options* get() const { return options ? options->get() : nullptr; }
    Outcome outcome() const {
        Outcome outcome("options");
        return outcome.fails_if(options && options->is_wrong(), RW_ERROR_INVALID_ARGUMENT)
            .fails_if(cancel != 0, RW_ERROR_CANCELLED);
    }
    void check(bool answered, std::uint64_t nan_count) const {
        if (!options) return;
        demand(options->is_unchanged(), "query options were written to");
        if (!wants_invalid) return;
        if (answered) {
            demand(invalid_rays == nan_count, "the rays with a NaN were miscounted");
        } else {
            demand(invalid_rays == 77, "invalid_rays was written to on an error");
        }
    }

    static std::int32_t go_on(void*, double, const char*) { return 0; }

    HostLoop loop;
    std::int32_t cancel = 0; // set before the batch: not a ray is answered
    std::uint64_t invalid_rays = 77;
    bool wants_invalid = false;
    std::optional<CallerStruct<rw_query_options>> options;
};

void count(const Asked& asked, const RayBatch& batch, bool answered, bool refused) {
    if (asked.usage() == nullptr) return;
    if (answered) {
        asked.usage()->batch_rays += batch.rays().size();
        asked.usage()->nan_rays += batch.nan_count();
    } else if (!refused) {
        asked.usage()->is_known = false;
    }
}

// All outputs of rw_hits, for `elements` answers.
class HitOutputs {
public:
    HitOutputs(Input& input, std::uint64_t elements) {
        if (!input.one_in(4)) t_ = OutputArray(input, elements, 1, OutputKind::numbers);
        if (!input.one_in(2)) uv_ = OutputArray(input, elements, 2, OutputKind::numbers);
        if (!input.one_in(2)) normal_ = OutputArray(input, elements, 3, OutputKind::numbers);
        if (!input.one_in(2)) instance_ = OutputArray(input, elements, 1, OutputKind::ids);
        if (!input.one_in(2)) geometry_ = OutputArray(input, elements, 1, OutputKind::ids);
        if (!input.one_in(4)) primitive_ = OutputArray(input, elements, 1, OutputKind::ids);
        rw_hits hits{};
        hits.t = t_.output();
        hits.uv = uv_.output();
        hits.normal = normal_.output();
        hits.instance = instance_.output();
        hits.geometry = geometry_.output();
        hits.primitive = primitive_.output();
        if (input.one_in(64)) hits.flags = 1u << input.below(32);
        struct_.emplace(input, hits);
        outcome_.fails_if(hits.flags != 0 || struct_->is_wrong(), RW_ERROR_INVALID_ARGUMENT);
        for (const OutputArray* each : {&t_, &uv_, &normal_, &instance_, &geometry_, &primitive_}) {
            each->complain(outcome_);
        }
    }

    const rw_hits* get() const { return struct_->get(); }
    const Outcome& outcome() const { return outcome_; }

    // normal_of: a scene of the same meshes.
    void expect(std::uint64_t element, const rw_hit& hit, const rw_scene* normal_of) {
        double normal[3] = {0.0, 0.0, 0.0};
        if (hit.primitive != RW_INVALID_ID) Outcome("normal").check(rw_scene_normal(normal_of, &hit, normal));
        t_.expect_number(element, 0, hit.t);
        uv_.expect_number(element, 0, hit.u);
        uv_.expect_number(element, 1, hit.v);
        for (int axis = 0; axis < 3; ++axis) normal_.expect_number(element, axis, normal[axis]);
        instance_.expect_id(element, hit.instance);
        geometry_.expect_id(element, hit.geometry);
        primitive_.expect_id(element, hit.primitive);
    }

    bool are_answered() { return holds(&OutputArray::is_answered); }
    bool are_untouched() { return holds(&OutputArray::is_untouched); }
    bool are_partly_answered() { return holds(&OutputArray::is_partly_answered); }

private:
    bool holds(bool (OutputArray::*predicate)()) {
        bool all = struct_->is_unchanged();
        for (OutputArray* each : {&t_, &uv_, &normal_, &instance_, &geometry_, &primitive_}) {
            const bool one = (each->*predicate)(); // asked of each, since it also makes it as it was
            all = all && one;
        }
        return all;
    }

    OutputArray t_;
    OutputArray uv_;
    OutputArray normal_;
    OutputArray instance_;
    OutputArray geometry_;
    OutputArray primitive_;
    std::optional<CallerStruct<rw_hits>> struct_;
    Outcome outcome_{"hits"};
};

// Whether a batch that must not misbehave did, or one that did went unnoticed.
bool check_batch(const char* call, const Outcome& arguments, const Query& query, std::int32_t status) {
    Outcome outcome(call);
    outcome.add(arguments).add(query.outcome()).fails_if(query.loop.has_misbehaved(), RW_ERROR_HOST_PARALLEL);
    return outcome.check(status);
}

} // namespace

void ask_single(Input& input, const Reference& reference, const std::vector<Asked>& asked) {
    rw_ray ray = make_ray(input, reference.meshes());
    Skips skips;
    if (input.one_in(3)) skips = make_skips(input, reference.meshes());
    std::vector<rw_hit> wanted = reference.all(ray, skips);
    for (const Asked& each : asked) ask_ray(input, each, ray, skips, wanted);
    if (wanted.empty() || !input.one_in(2)) return;
    // The interval ends exactly at a hit, or one step beside it.
    const double t = wanted[input.below(wanted.size())].t;
    static constexpr double directions[] = {-INFINITY, 0.0, INFINITY};
    const double towards = input.pick(directions);
    const double limit = towards == 0.0 ? t : std::nextafter(t, towards);
    if (input.one_in(2)) {
        ray.tmin = limit;
    } else {
        ray.tmax = limit;
    }
    // Sometimes the ray goes on behind what it met first.
    if (input.one_in(3)) skips.push_back({RW_INVALID_ID, wanted.front().geometry, wanted.front().primitive});
    wanted = reference.all(ray, skips);
    for (const Asked& each : asked) ask_ray(input, each, ray, skips, wanted);
}

void ask_intersect_batch(Input& input, const Reference& reference, const std::vector<Asked>& asked,
                         const Workspace& workspace) {
    const RayBatch batch(input, reference.meshes());
    HitOutputs outputs(input, batch.rays().size());
    Outcome arguments = batch.outcome();
    arguments.add(batch.skip_outcome());
    arguments.add(outputs.outcome());
    if (!arguments.must_fail()) {
        for (std::size_t i = 0; i < batch.rays().size(); ++i)
            outputs.expect(i, reference.closest(batch.rays()[i], batch.skips(i)), reference.judge());
    }
    for (const Asked& each : asked) {
        Query query(input, workspace);
        const bool answered = check_batch("intersect_batch", arguments, query,
                                          each.intersect_batch(batch.get(), outputs.get(), query.get()));
        if (answered) {
            if (!outputs.are_answered())
                fail("%s: a batch differs from the judge's single answers", each.name().c_str());
        } else if (query.loop.has_misbehaved()) {
            demand(outputs.are_partly_answered(), "a batch that failed wrote something else than answers");
        } else {
            demand(outputs.are_untouched(), "a batch that was refused wrote to its outputs");
        }
        query.check(answered, batch.nan_count());
        count(each, batch, answered, !query.loop.has_misbehaved());
    }
    demand(batch.is_unchanged(), "a batch's rays were written to");
}

void ask_occluded_batch(Input& input, const Reference& reference, const std::vector<Asked>& asked,
                        const Workspace& workspace) {
    const RayBatch batch(input, reference.meshes());
    OutputArray output(input, batch.rays().size(), 1, OutputKind::flags);
    const bool absent = input.one_in(32);
    if (absent) output = OutputArray();
    Outcome arguments = batch.outcome();
    arguments.add(batch.skip_outcome());
    output.complain(arguments);
    arguments.may_fail_if(absent, RW_ERROR_INVALID_ARGUMENT)
        .fails_if(absent && !batch.rays().empty(), RW_ERROR_INVALID_ARGUMENT);
    if (!arguments.must_fail()) {
        for (std::size_t i = 0; i < batch.rays().size(); ++i)
            output.expect_flag(i, !reference.all(batch.rays()[i], batch.skips(i)).empty());
    }
    for (const Asked& each : asked) {
        Query query(input, workspace);
        const bool answered = check_batch("occluded_batch", arguments, query,
                                          each.occluded_batch(batch.get(), &output.output(), query.get()));
        if (answered) {
            if (!output.is_answered()) fail("%s: an occlusion batch differs from the judge", each.name().c_str());
        } else if (query.loop.has_misbehaved()) {
            demand(output.is_partly_answered(), "an occlusion batch that failed wrote something else than answers");
        } else {
            demand(output.is_untouched(), "an occlusion batch that was refused wrote to its output");
        }
        query.check(answered, batch.nan_count());
        count(each, batch, answered, !query.loop.has_misbehaved());
    }
    demand(batch.is_unchanged(), "an occlusion batch's rays were written to");
}

void ask_all_batch(Input& input, const Reference& reference, const std::vector<Asked>& asked,
                   const Workspace& workspace) {
    const RayBatch batch(input, reference.meshes());
    Outcome arguments = batch.outcome();
    arguments.add(batch.skip_outcome());
    std::vector<std::vector<rw_hit>> wanted;
    std::vector<std::uint64_t> offsets = {0};
    for (std::size_t i = 0; i < batch.rays().size(); ++i) {
        wanted.push_back(reference.all(batch.rays()[i], batch.skips(i)));
        offsets.push_back(offsets.back() + wanted.back().size());
    }
    const std::uint64_t total = offsets.back();
    std::uint64_t capacity = total + input.below(3);
    if (total > 0 && input.one_in(4)) capacity = input.below(static_cast<std::size_t>(total));
    const bool only_offsets = input.one_in(4);
    if (only_offsets) capacity = input.one_in(8) ? 1 : 0;

    HitOutputs outputs(input, capacity);
    const bool fits = total <= capacity;
    if (only_offsets) {
        arguments.fails_if(capacity > 0, RW_ERROR_INVALID_ARGUMENT);
    } else {
        arguments.add(outputs.outcome());
        if (fits && !arguments.must_fail()) {
            for (std::size_t i = 0; i < wanted.size(); ++i) {
                for (std::size_t k = 0; k < wanted[i].size(); ++k)
                    outputs.expect(offsets[i] + k, wanted[i][k], reference.judge());
            }
        }
    }
    for (const Asked& each : asked) {
        Query query(input, workspace);
        std::vector<std::uint64_t> found(offsets.size(), 77);
        std::uint64_t needed = 77;
        const bool wants_needed = !input.one_in(8);
        const std::int32_t status =
            each.intersect_all_batch(batch.get(), found.data(), only_offsets ? nullptr : outputs.get(), capacity,
                                     wants_needed ? &needed : nullptr, query.get());
        // Refused before anything was asked; failed half-way; or answered, be it without room for the hits.
        Outcome refused("intersect_all_batch");
        refused.add(arguments).add(query.outcome());
        const bool misbehaved = query.loop.has_misbehaved();
        Outcome outcome = refused;
        outcome.fails_if(misbehaved, RW_ERROR_HOST_PARALLEL)
            .fails_if(!only_offsets && !fits && !refused.must_fail() && !misbehaved, RW_ERROR_CAPACITY);
        outcome.check(status);
        const bool answered = status == RW_OK || status == RW_ERROR_CAPACITY;
        if (answered) {
            if (found != offsets) fail("%s: the offsets of all hits differ from the judge's", each.name().c_str());
            if (wants_needed && needed != total)
                fail("%s: `needed` is not the number of all hits", each.name().c_str());
        } else if (!misbehaved) {
            demand(std::all_of(found.begin(), found.end(), [](std::uint64_t x) { return x == 77; }) && needed == 77,
                   "a batch of all hits that was refused wrote to its offsets");
        }
        if (status == RW_OK && !only_offsets) {
            if (!outputs.are_answered()) fail("%s: all hits of a batch differ from the judge's", each.name().c_str());
        } else if (misbehaved) {
            demand(outputs.are_partly_answered(), "a batch of all hits that failed wrote something else than answers");
        } else {
            demand(outputs.are_untouched(), "a batch of all hits wrote hits although it returned none");
        }
        query.check(answered, batch.nan_count());
        count(each, batch, answered, !misbehaved);
    }
    demand(batch.is_unchanged(), "the rays of a batch of all hits were written to");
}

void ask_once(Input& input, const Reference& reference, const rw_profile* profile, const Workspace& workspace) {
    Outcome arguments("once");
    Meshes meshes = reference.meshes();
    std::shared_ptr<const Reference> other; // of one mesh more
    if (input.one_in(4)) {
        meshes.push_back(std::make_shared<Mesh>(input));
        arguments.add(meshes.back()->outcome());
        if (!arguments.must_fail()) other = std::make_shared<Reference>(meshes, false);
    }
    const Reference& judge = other ? *other : reference;

    // The structs as a program of this version or of a newer one has them: as far apart as they say they are large.
    const std::size_t size = sizeof(rw_triangles) + (input.one_in(8) ? 16 : 0);
    std::vector<unsigned char> structs(meshes.size() * size);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        rw_triangles triangles = meshes[i]->triangles();
        triangles.struct_size = static_cast<std::uint32_t>(size);
        std::memcpy(structs.data() + i * size, &triangles, sizeof triangles);
    }

    const RayBatch batch(input, meshes);
    Query query(input, workspace);
    rw_once_options o{};
    o.kind = input.one_in(16) ? input.between(-1, 6) : input.between(0, 4);
    arguments.fails_if(o.kind < RW_RAYS_ANY_KIND || o.kind > RW_RAYS_DIFFUSE, RW_ERROR_INVALID_ARGUMENT);
    o.profile = profile;
    o.structure = input.one_in(3) ? nullptr : structure_names()[input.below(structure_names().size())].c_str();
    if (input.one_in(32)) {
        o.structure = "octree";
        arguments.fails_if(true, RW_ERROR_UNKNOWN_STRUCTURE);
    }
    if (input.one_in(4)) o.memory_limit = input.between<std::uint64_t>(1, 100000);
    arguments.may_fail_if(o.memory_limit != 0, RW_ERROR_MEMORY_LIMIT);
    o.query = query.get();
    const CallerStruct<rw_once_options> options(input, o);
    arguments.fails_if(options.is_wrong(), RW_ERROR_INVALID_ARGUMENT).add(batch.outcome()).add(batch.skip_outcome());
    const auto* first = structs.empty() ? nullptr : reinterpret_cast<const rw_triangles*>(structs.data());
    const auto mesh_count = static_cast<std::uint32_t>(meshes.size());

    bool answered = false;
    if (input.one_in(2)) {
        HitOutputs outputs(input, batch.rays().size());
        arguments.add(outputs.outcome());
        if (!arguments.must_fail()) {
            for (std::size_t i = 0; i < batch.rays().size(); ++i)
                outputs.expect(i, judge.closest(batch.rays()[i], batch.skips(i)), judge.judge());
        }
        answered = check_batch("once_intersect", arguments, query,
                               rw_once_intersect(first, mesh_count, batch.get(), outputs.get(), options.get()));
        demand(answered                      ? outputs.are_answered()
               : query.loop.has_misbehaved() ? outputs.are_partly_answered()
                                             : outputs.are_untouched(),
               "rw_once_intersect answers otherwise than the judge, or wrote although it failed");
    } else {
        OutputArray output(input, batch.rays().size(), 1, OutputKind::flags);
        output.complain(arguments);
        if (!arguments.must_fail()) {
            for (std::size_t i = 0; i < batch.rays().size(); ++i)
                output.expect_flag(i, !judge.all(batch.rays()[i], batch.skips(i)).empty());
        }
        answered = check_batch("once_occluded", arguments, query,
                               rw_once_occluded(first, mesh_count, batch.get(), &output.output(), options.get()));
        demand(answered                      ? output.is_answered()
               : query.loop.has_misbehaved() ? output.is_partly_answered()
                                             : output.is_untouched(),
               "rw_once_occluded answers otherwise than the judge, or wrote although it failed");
    }
    query.check(answered, batch.nan_count());
    demand(batch.is_unchanged() && options.is_unchanged(), "a one-shot call wrote to its input");
    for (const auto& mesh : meshes) demand(mesh->is_unchanged(), "a one-shot call wrote to its meshes");
}

void ask_too_early(Input& input, const rw_scene* scene) {
    const rw_ray ray = make_ray(input, {});
    rw_hit hit;
    std::memset(&hit, blank, sizeof hit);
    const rw_hit untouched = hit;
    std::int32_t occluded = 77;
    std::uint64_t needed = 77;
    const auto refuse = [](const char* call, std::int32_t status) {
        Outcome(call).fails_if(true, RW_ERROR_NOT_COMMITTED).check(status);
    };
    refuse("intersect", rw_scene_intersect(scene, &ray, nullptr, &hit));
    refuse("occluded", rw_scene_occluded(scene, &ray, nullptr, &occluded));
    refuse("intersect_all", rw_scene_intersect_all(scene, &ray, nullptr, &hit, 1, &needed));
    demand(same_bits(hit, untouched) && occluded == 77 && needed == 77,
           "a scene that is not committed wrote an answer");
    double bounds[6] = {7, 7, 7, 7, 7, 7};
    refuse("bounds", rw_scene_bounds(scene, bounds, bounds + 3));
    demand(std::all_of(bounds, bounds + 6, [](double x) { return x == 7; }),
           "a scene that is not committed wrote bounds");
    std::uint32_t count = 77;
    refuse("candidate_count", rw_scene_candidate_count(scene, &count));
    refuse("explain", rw_scene_explain(scene, RW_FORMAT_TEXT, nullptr, 0, &needed));
    demand(count == 77 && needed == 77, "a scene that is not committed wrote facts");
}

} // namespace raywise::fuzz
