#include "fuzz/world.h"

#include "fuzz/callbacks.h"
#include "fuzz/caller_struct.h"
#include "fuzz/facts.h"
#include "fuzz/failure.h"
#include "fuzz/questions.h"
#include "fuzz/rays.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace raywise::fuzz {
namespace {

constexpr std::size_t most_handles = 3;

// A name of a structure, NULL for none, or a name that none has.
struct StructureChoice {
    explicit StructureChoice(Input& input) {
        if (input.one_in(24)) {
            name = input.text(100);
            const auto& known = structure_names();
            is_unknown = std::find(known.begin(), known.end(), name) == known.end();
            is_given = true;
        } else if (!input.one_in(4)) {
            name = structure_names()[input.below(structure_names().size())];
            is_given = true;
        }
        name = name.c_str(); // up to a zero in the middle, as the library reads it
        if (is_unknown)
            is_unknown = std::find(structure_names().begin(), structure_names().end(), name) == structure_names().end();
    }
    const char* get() const { return is_given ? name.c_str() : nullptr; }

    std::string name;
    bool is_given = false;
    bool is_unknown = false;
};

std::uint64_t ray_count(Input& input) {
    static constexpr std::uint64_t counts[] = {1,
                                               1,
                                               100,
                                               10000,
                                               1000000000,
                                               RW_RAYS_LIMIT,
                                               RW_RAYS_UNKNOWN,
                                               RW_RAYS_UNKNOWN,
                                               0,
                                               RW_RAYS_LIMIT + 1,
                                               RW_RAYS_UNKNOWN - 1};
    return input.pick(counts);
}

bool is_absurd(std::uint64_t count) { return count == 0 || (count > RW_RAYS_LIMIT && count != RW_RAYS_UNKNOWN); }

// The options of a build, with the callbacks they name.
struct Build {
    explicit Build(Input& input)
        : loop(input), progress(input), is_given(!input.one_in(3)), options(input, describe(input)) {}

    const rw_commit_options* get() const { return is_given ? options.get() : nullptr; }
    bool is_anew() const { return is_given && !options.is_of_an_older_program() && refit == RW_REFIT_NEVER; }
    Outcome outcome() const {
        Outcome outcome("options");
        if (!is_given) return outcome;
        return outcome.fails_if(options.is_wrong(), RW_ERROR_INVALID_ARGUMENT)
            .fails_if(progress.has_cancelled(), RW_ERROR_CANCELLED)
            .fails_if(loop.has_misbehaved(), RW_ERROR_HOST_PARALLEL);
    }
    void check(bool built) const {
        demand(options.is_unchanged(), "commit options were written to");
        if (built && is_given && progress.function() != nullptr)
            demand(progress.calls() > 0, "progress was never called");
    }

    HostLoop loop;
    ProgressLog progress;
    bool is_given;
    std::int32_t refit = RW_REFIT_WHERE_IT_PAYS;
    CallerStruct<rw_commit_options> options;

private:
    rw_commit_options describe(Input& input) {
        rw_commit_options o{};
        o.threads = input.pick({0u, 1u, 2u, 5u, 0xFFFFFFFFu});
        o.progress = progress.function();
        o.progress_user = progress.user();
        o.parallel_for = loop.function();
        o.parallel_user = loop.user();
        o.refit = refit = input.pick({RW_REFIT_WHERE_IT_PAYS, RW_REFIT_WHERE_POSSIBLE, RW_REFIT_NEVER});
        return o;
    }
};

} // namespace

World::~World() {
    while (!views_.empty()) release_view(views_.size() - 1);
    while (!scenes_.empty()) release_scene(0); // the other order
    for (const auto& profile : profiles_) {
        for (int i = 0; i < profile.references; ++i) rw_profile_release(profile.handle);
    }
}

void World::release_scene(std::size_t index) {
    for (const auto& mesh : scenes_[index].meshes) demand(mesh->is_unchanged(), "a scene wrote to its meshes");
    for (int i = 0; i < scenes_[index].held.references; ++i) rw_scene_release(scenes_[index].held.handle);
    scenes_.erase(scenes_.begin() + static_cast<std::ptrdiff_t>(index));
}

void World::release_view(std::size_t index) {
    for (int i = 0; i < views_[index].held.references; ++i) rw_scene_release(views_[index].held.handle);
    views_.erase(views_.begin() + static_cast<std::ptrdiff_t>(index));
}

void World::describe() const {
    for (const SceneState& scene : scenes_) {
        std::fprintf(stderr, "scene of %zu meshes, %s, structure %s\n", scene.meshes.size(),
                     scene.is_committed() ? "committed" : "not committed",
                     scene.forced.empty() ? "free" : scene.forced.c_str());
        for (const auto& mesh : scene.meshes) mesh->describe();
    }
    for (const ViewState& view : views_) {
        std::fprintf(stderr, "view, structure %s\n", view.forced.empty() ? "free" : view.forced.c_str());
        if (scenes_.empty()) {
            for (const auto& mesh : view.reference->meshes()) mesh->describe();
        }
    }
}

void World::run() {
    static constexpr Step steps[] = {&World::add_mesh,
                                     &World::add_mesh,
                                     &World::add_mesh,
                                     &World::set_expected_rays,
                                     &World::set_options,
                                     &World::set_options,
                                     &World::commit,
                                     &World::commit,
                                     &World::ask,
                                     &World::ask,
                                     &World::ask,
                                     &World::ask,
                                     &World::ask,
                                     &World::look_at_facts,
                                     &World::make_view,
                                     &World::make_view,
                                     &World::once,
                                     &World::make_scene,
                                     &World::keep_and_give_back,
                                     &World::use_profile,
                                     &World::refit};
    make_scene();
    for (int i = 0; i < 64 && !input_.is_empty(); ++i) (this->*input_.pick(steps))();

    // Whatever was begun is finished: what failed before must have left the scenes as they were.
    for (SceneState& scene : scenes_) {
        if (scene.is_committed()) continue;
        ask_too_early(input_, scene.held.handle);
        Outcome outcome("commit");
        outcome.may_fail_if(scene.memory_limit != 0, RW_ERROR_MEMORY_LIMIT);
        if (!outcome.check(rw_scene_commit(scene.held.handle, nullptr))) continue;
        scene.reference = std::make_shared<Reference>(scene.meshes, true);
        ask_single(input_, *scene.reference, everybody(scene.reference));
    }
}

SceneState* World::any_scene() { return scenes_.empty() ? nullptr : &scenes_[input_.below(scenes_.size())]; }

SceneState* World::any_committed() {
    SceneState* scene = any_scene();
    return scene != nullptr && scene->is_committed() ? scene : nullptr;
}

std::vector<Asked> World::everybody(const std::shared_ptr<const Reference>& reference) {
    std::vector<Asked> asked = reference->scenes();
    for (const SceneState& scene : scenes_) {
        if (scene.reference == reference) {
            asked.emplace_back(scene.held.handle,
                               "a scene on " + (scene.forced.empty() ? "its own choice" : scene.forced),
                               scene.usage.get());
        }
    }
    for (const ViewState& view : views_) {
        if (view.reference == reference) {
            asked.emplace_back(view.held.handle, "a view on " + (view.forced.empty() ? "its own choice" : view.forced));
        }
    }
    return asked;
}

Outcome World::refused_when_committed(const char* call, const SceneState& scene) const {
    Outcome outcome(call);
    return outcome.fails_if(scene.is_committed(), RW_ERROR_ALREADY_COMMITTED);
}

void World::make_scene() {
    if (scenes_.size() >= most_handles) return;
    const rw_profile* profile = profiles_.empty() ? nullptr : profiles_[input_.below(profiles_.size())].handle;
    SceneState scene;
    scene.held.references = 1;
    Outcome("scene_create").check(rw_scene_create(profile, &scene.held.handle));
    demand(scene.held.handle != nullptr, "rw_scene_create gave no scene");
    scenes_.push_back(std::move(scene));
}

void World::add_mesh() {
    SceneState* scene = any_scene();
    if (scene == nullptr || scene->meshes.size() >= 4) return;
    auto mesh = std::make_shared<Mesh>(input_);
    const CallerStruct<rw_triangles> triangles(input_, mesh->triangles());
    Outcome outcome = refused_when_committed("add_triangles", *scene);
    outcome.add(mesh->outcome()).fails_if(triangles.is_wrong(), RW_ERROR_INVALID_ARGUMENT);
    std::uint32_t id = 77;
    const bool wants_id = !input_.one_in(8);
    const std::int32_t status = rw_scene_add_triangles(scene->held.handle, triangles.get(), wants_id ? &id : nullptr);
    const bool added = outcome.check(status);
    demand(triangles.is_unchanged() && mesh->is_unchanged(), "adding a mesh wrote to it");
    if (added) {
        demand(!wants_id || id == scene->meshes.size(), "a mesh got an id out of order");
        scene->meshes.push_back(std::move(mesh));
    } else {
        demand(id == 77, "a mesh that was refused got an id");
    }
}

void World::set_expected_rays() {
    SceneState* scene = any_scene();
    if (scene == nullptr) return;
    std::optional<RayBatch> sample;
    if (input_.one_in(3)) sample.emplace(input_, scene->meshes);
    rw_expected_rays e{};
    e.kind = input_.one_in(16) ? input_.pick({-1, 5, 1000}) : input_.between(0, 4);
    e.count = ray_count(input_);
    e.sample = sample ? sample->get() : nullptr;
    const CallerStruct<rw_expected_rays> expected(input_, e);
    Outcome outcome = refused_when_committed("set_expected_rays", *scene);
    outcome.fails_if(e.kind < RW_RAYS_ANY_KIND || e.kind > RW_RAYS_DIFFUSE, RW_ERROR_INVALID_ARGUMENT)
        .fails_if(is_absurd(e.count), RW_ERROR_RAY_COUNT)
        .fails_if(expected.is_wrong(), RW_ERROR_INVALID_ARGUMENT);
    if (sample) outcome.add(sample->outcome());
    outcome.check(rw_scene_set_expected_rays(scene->held.handle, expected.get()));
    demand(expected.is_unchanged() && (!sample || sample->is_unchanged()), "expected rays were written to");
}

void World::set_options() {
    SceneState* scene = any_scene();
    if (scene == nullptr) return;
    const std::size_t which = input_.below(4);
    if (which == 0) {
        const std::uint64_t limit =
            input_.one_in(2) ? 0 : std::uint64_t{1} << input_.between(0, 40) << (input_.one_in(8) ? 23 : 0);
        Outcome outcome = refused_when_committed("set_memory_limit", *scene);
        if (outcome.check(rw_scene_set_memory_limit(scene->held.handle, limit))) scene->memory_limit = limit;
    } else if (which == 1) {
        const int effort = input_.one_in(16) ? input_.pick({-1, 3}) : input_.between(0, 2);
        const int rule = input_.one_in(16) ? input_.pick({-1, 2}) : input_.between(0, 1);
        const double limit = input_.pick({0.0, 0.0, 1e-9, 0.001, 1e300, -1.0, double{NAN}, double{INFINITY}});
        Outcome outcome = refused_when_committed("set_effort", *scene);
        outcome.fails_if(effort < 0 || effort > 2 || rule < 0 || rule > 1 || !(limit >= 0.0),
                         RW_ERROR_INVALID_ARGUMENT);
        outcome.check(rw_scene_set_effort(scene->held.handle, effort, rule, limit));
    } else {
        const StructureChoice choice(input_);
        Outcome outcome = refused_when_committed("set_structure", *scene);
        outcome.fails_if(choice.is_unknown, RW_ERROR_UNKNOWN_STRUCTURE);
        if (outcome.check(rw_scene_set_structure(scene->held.handle, choice.get()))) scene->forced = choice.name;
    }
}

void World::commit() {
    SceneState* scene = any_scene();
    if (scene == nullptr) return;
    Build build(input_);
    const std::int32_t status = rw_scene_commit(scene->held.handle, build.get());
    Outcome outcome = refused_when_committed("commit", *scene);
    outcome.add(build.outcome()).may_fail_if(scene->memory_limit != 0, RW_ERROR_MEMORY_LIMIT);
    const bool committed = outcome.check(status);
    build.check(committed);
    if (committed) {
        scene->reference = std::make_shared<Reference>(scene->meshes, true);
    } else if (!scene->is_committed()) {
        ask_too_early(input_, scene->held.handle);
    }
}

void World::refit() {
    const SceneState* scene = any_scene();
    if (scene == nullptr || scenes_.size() >= most_handles) return;
    SceneState moved;
    Build build(input_);
    Outcome outcome("refit");
    std::vector<rw_triangles> described;
    for (const auto& mesh : scene->meshes) {
        moved.meshes.push_back(std::make_shared<Mesh>(input_, mesh, build.is_anew()));
    }
    if (build.is_anew() && input_.one_in(8)) { // another number of meshes
        if (moved.meshes.empty() || input_.one_in(2)) {
            moved.meshes.push_back(std::make_shared<Mesh>(input_));
        } else {
            moved.meshes.pop_back();
        }
    }
    for (const auto& mesh : moved.meshes) {
        outcome.add(mesh->outcome());
        described.push_back(mesh->moved_triangles());
    }
    if (!build.is_anew() && input_.one_in(32)) {
        if (!described.empty() && input_.one_in(2)) {
            described.pop_back();
        } else {
            described.emplace_back();
            described.back().struct_size = sizeof(rw_triangles);
        }
        outcome.fails_if(true, RW_ERROR_INVALID_ARGUMENT);
    }
    moved.held.references = 1;
    moved.forced = scene->forced;
    moved.memory_limit = scene->memory_limit;
    const std::int32_t status =
        rw_scene_refit(scene->held.handle, described.data(), static_cast<std::uint32_t>(described.size()), build.get(),
                       &moved.held.handle);
    outcome.fails_if(!scene->is_committed(), RW_ERROR_NOT_COMMITTED)
        .add(build.outcome())
        .may_fail_if(scene->memory_limit != 0, RW_ERROR_MEMORY_LIMIT);
    const bool made = outcome.check(status);
    build.check(made);
    for (const auto& mesh : moved.meshes) demand(mesh->is_unchanged(), "refitting wrote to a mesh");
    demand(made == (moved.held.handle != nullptr), "a refitted scene and an error, or neither");
    if (!made) return;
    moved.reference = std::make_shared<Reference>(moved.meshes, true);
    scenes_.push_back(std::move(moved));
}

void World::ask() {
    // A view outlives its scene: ask on behalf of either.
    std::shared_ptr<const Reference> reference;
    if (const SceneState* scene = any_committed(); scene != nullptr) {
        reference = scene->reference;
    } else if (!views_.empty()) {
        reference = views_[input_.below(views_.size())].reference;
    } else {
        return;
    }
    if (input_.one_in(3)) return ask_single(input_, *reference, everybody(reference));
    static constexpr void (*batches[])(Input&, const Reference&, const std::vector<Asked>&, const Workspace&) = {
        ask_intersect_batch, ask_intersect_batch, ask_occluded_batch, ask_all_batch};
    input_.pick(batches)(input_, *reference, everybody(reference), workspace_);
}

void World::look_at_facts() {
    if (const SceneState* scene = any_committed(); scene != nullptr) {
        check_scene_facts(input_, *scene);
        check_candidates(input_, Asked(scene->held.handle, "a scene"), scene->forced);
    }
    if (!views_.empty()) {
        const ViewState& view = views_[input_.below(views_.size())];
        check_candidates(input_, Asked(view.held.handle, "a view"), view.forced);
    }
}

void World::make_view() {
    SceneState* scene = any_scene();
    if (scene == nullptr || views_.size() >= most_handles) return;
    // Of a view as well.
    const ViewState* of_view = !views_.empty() && input_.one_in(4) ? &views_[input_.below(views_.size())] : nullptr;
    const StructureChoice choice(input_);
    rw_view_options o{};
    o.kind = input_.one_in(24) ? input_.pick({-1, 2}) : input_.between(0, 1);
    // Its origin and direction are those that rays will have.
    const rw_ray frame = make_ray(input_, of_view != nullptr ? of_view->reference->meshes() : scene->meshes);
    bool finite = true;
    bool directed = false;
    for (int axis = 0; axis < 3; ++axis) {
        o.origin[axis] = frame.origin[axis];
        if (o.kind == RW_VIEW_DIRECTION || input_.one_in(2)) o.direction[axis] = frame.direction[axis];
        finite = finite && std::isfinite(o.origin[axis]) && std::isfinite(o.direction[axis]);
        directed = directed || o.direction[axis] != 0.0;
    }
    o.half_angle = input_.pick({0.0, 0.0, 0.1, 0.7, 1.5, 1.57, 1e-300, 1.5707963267948966, 2.0, -0.1, double{NAN}});
    o.count = ray_count(input_);
    o.ray_kind = input_.one_in(16) ? input_.pick({-1, 5, RW_RAYS_RANDOM, RW_RAYS_DIFFUSE})
                                   : input_.pick({0, RW_RAYS_CAMERA, RW_RAYS_SHADOW});
    o.structure = choice.get();
    const CallerStruct<rw_view_options> options(input_, o);
    Build build(input_);

    ViewState view;
    view.reference = of_view != nullptr ? of_view->reference : scene->reference;
    view.memory_limit = of_view != nullptr ? of_view->memory_limit : scene->memory_limit;
    view.forced = choice.name;
    view.held.references = 1;
    const rw_scene* seen = of_view != nullptr ? of_view->held.handle : scene->held.handle;
    const std::int32_t status = rw_scene_view(seen, options.get(), build.get(), &view.held.handle);
    Outcome outcome("scene_view");
    const bool wrong_angle = o.kind == RW_VIEW_POINT && !(o.half_angle >= 0.0 && o.half_angle < 1.5707963267948966);
    outcome.fails_if(of_view == nullptr && !scene->is_committed(), RW_ERROR_NOT_COMMITTED)
        .fails_if(options.is_wrong(), RW_ERROR_INVALID_ARGUMENT)
        .fails_if(o.kind != RW_VIEW_POINT && o.kind != RW_VIEW_DIRECTION, RW_ERROR_INVALID_ARGUMENT)
        .fails_if(o.kind == RW_VIEW_DIRECTION && !directed, RW_ERROR_INVALID_ARGUMENT)
        .fails_if(wrong_angle, RW_ERROR_INVALID_ARGUMENT)
        .fails_if(!finite, RW_ERROR_NOT_FINITE)
        .fails_if(is_absurd(o.count), RW_ERROR_RAY_COUNT)
        .fails_if(choice.is_unknown, RW_ERROR_UNKNOWN_STRUCTURE)
        .fails_if(o.ray_kind < 0 || o.ray_kind > RW_RAYS_DIFFUSE, RW_ERROR_INVALID_ARGUMENT)
        .may_fail_if(o.ray_kind == RW_RAYS_RANDOM || o.ray_kind == RW_RAYS_DIFFUSE, RW_ERROR_INVALID_ARGUMENT)
        .may_fail_if(view.memory_limit != 0, RW_ERROR_MEMORY_LIMIT)
        .add(build.outcome());
    const bool made = outcome.check(status);
    build.check(made);
    demand(options.is_unchanged(), "view options were written to");
    demand(made == (view.held.handle != nullptr), "a view and an error, or neither");
    if (made) views_.push_back(std::move(view));
}

void World::once() {
    const SceneState* scene = any_committed();
    if (scene == nullptr) return;
    ask_once(input_, *scene->reference, profiles_.empty() ? nullptr : profiles_[input_.below(profiles_.size())].handle,
             workspace_);
}

void World::keep_and_give_back() {
    switch (input_.below(6)) {
        case 0:
            if (SceneState* scene = any_scene(); scene != nullptr) {
                Outcome("scene_retain").check(rw_scene_retain(scene->held.handle));
                ++scene->held.references;
            }
            break;
        case 1:
            if (!views_.empty()) {
                ViewState& view = views_[input_.below(views_.size())];
                Outcome("view_retain").check(rw_scene_retain(view.held.handle));
                ++view.held.references;
            }
            break;
        case 2: // the scene, while views of it go on
            if (scenes_.size() > 1 || !views_.empty()) {
                if (!scenes_.empty()) release_scene(input_.below(scenes_.size()));
            }
            break;
        case 3:
            if (!views_.empty()) release_view(input_.below(views_.size()));
            break;
        case 4: // one reference of several
            for (SceneState& scene : scenes_) {
                if (scene.held.references < 2) continue;
                Outcome("scene_release").check(rw_scene_release(scene.held.handle));
                --scene.held.references;
            }
            break;
        default:
            Outcome("release nothing").check(rw_scene_release(nullptr));
            Outcome("release nothing").check(rw_profile_release(nullptr));
            Outcome("release nothing").check(rw_mesh_release(nullptr));
            break;
    }
}

void World::use_profile() {
    switch (input_.below(4)) {
        case 0:
            if (profiles_.size() < most_handles) {
                Held<rw_profile> profile{nullptr, 1};
                Outcome("profile_load").check(rw_profile_load(nullptr, &profile.handle));
                profiles_.push_back(profile);
            }
            break;
        case 1:
            if (!profiles_.empty()) { // scenes keep what they need
                Outcome("profile_release").check(rw_profile_release(profiles_.back().handle));
                if (--profiles_.back().references == 0) profiles_.pop_back();
            }
            break;
        case 2:
            if (!profiles_.empty()) {
                Outcome("profile_retain").check(rw_profile_retain(profiles_.back().handle));
                ++profiles_.back().references;
            }
            break;
        default:
            if (!profiles_.empty()) {
                const rw_profile* profile = profiles_.back().handle;
                CallerStruct<rw_profile_info> info(input_, {});
                Outcome outcome("profile_inspect");
                outcome.fails_if(info.is_wrong(), RW_ERROR_INVALID_ARGUMENT);
                if (!outcome.check(rw_profile_inspect(profile, info.get()))) {
                    demand(info.is_unchanged(), "profile facts were written although the call was refused");
                }
                check_texts(input_, "profile_text",
                            [&](auto... arguments) { return rw_profile_text(profile, arguments...); });
            }
            break;
    }
}

} // namespace raywise::fuzz
