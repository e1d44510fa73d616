#include "fuzz/facts.h"

#include "fuzz/caller_struct.h"
#include "fuzz/failure.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace raywise::fuzz {

std::string check_text(Input& input, const char* call, std::int32_t format, const TextFunction& text) {
    std::uint64_t needed = 77;
    Outcome(call).check(text(format, nullptr, 0, &needed));
    std::vector<char> whole(needed, 'x');
    Outcome(call).check(text(format, whole.data(), whole.size(), nullptr));
    demand(needed > 1 && whole.back() == '\0' && std::strlen(whole.data()) + 1 == needed,
           "a text is not as long as it says");

    const std::uint64_t capacity = 1 + input.below(static_cast<std::size_t>(needed));
    std::vector<char> part(capacity, 'x');
    std::uint64_t needed_again = 77;
    Outcome(call)
        .fails_if(capacity < needed, RW_ERROR_CAPACITY)
        .check(text(format, part.data(), capacity, &needed_again));
    demand(needed_again == needed, "a text says two lengths");
    demand(part.back() == '\0' && std::strlen(part.data()) + 1 == capacity &&
               std::equal(part.begin(), part.end() - 1, whole.begin()),
           "a text cut off is not its beginning");
    return whole.data();
}

void check_texts(Input& input, const char* call, const TextFunction& text) {
    check_text(input, call, RW_FORMAT_TEXT, text);
    const std::string json = check_text(input, call, RW_FORMAT_JSON, text);
    if (!nlohmann::json::accept(json)) fail("%s: this is no JSON: %s", call, json.c_str());
    std::uint64_t needed = 77;
    Outcome(call).fails_if(true, RW_ERROR_INVALID_ARGUMENT).check(text(input.pick({2, -1, 77}), nullptr, 0, &needed));
    Outcome(call).fails_if(true, RW_ERROR_INVALID_ARGUMENT).check(text(RW_FORMAT_TEXT, nullptr, 1, &needed));
    demand(needed == 77, "a length was written although the call was refused");
}

void check_candidates(Input& input, const Asked& asked, const std::string& forced) {
    std::uint32_t count = 0;
    Outcome("candidate_count").check(asked.candidate_count(&count));
    demand(count == structure_names().size(), "not one candidate for each structure");
    std::string chosen;
    for (std::uint32_t i = 0; i < count; ++i) {
        CallerStruct<rw_candidate> candidate(input, {});
        Outcome outcome("get_candidate");
        outcome.fails_if(candidate.is_wrong(), RW_ERROR_INVALID_ARGUMENT);
        if (!outcome.check(asked.candidate(i, candidate.get()))) {
            demand(candidate.is_unchanged(), "a candidate was written although the call was refused");
            return;
        }
        const rw_candidate facts = candidate.result();
        demand(structure_names()[i] == facts.structure, "the candidates are not in the order of the structures");
        if ((facts.flags & RW_CANDIDATE_CHOSEN) != 0) {
            demand(chosen.empty(), "two candidates were chosen");
            chosen = facts.structure;
            demand(((facts.flags & RW_CANDIDATE_FORCED) != 0) == !forced.empty(), "forced and not forced at once");
        }
        demand(!(facts.predicted_build_ns < 0.0) && !(facts.predicted_ray_ns < 0.0) && !(facts.actual_build_ns < 0.0),
               "a negative time");
    }
    demand(!chosen.empty(), "no candidate was chosen");
    if (!forced.empty() && chosen != forced) fail("%s was forced, %s was built", forced.c_str(), chosen.c_str());
    CallerStruct<rw_candidate> none{rw_candidate{}};
    Outcome("get_candidate")
        .fails_if(true, RW_ERROR_INVALID_ARGUMENT)
        .check(asked.candidate(count + input.between<std::uint32_t>(0, 2), none.get()));
    demand(none.is_unchanged(), "a candidate that is not there was written");
    check_texts(input, "explain", [&](auto... arguments) { return asked.explain(arguments...); });
}

void check_scene_facts(Input& input, const SceneState& scene) {
    const rw_scene* handle = scene.held.handle;
    double lower[3];
    double upper[3];
    double judge_lower[3];
    double judge_upper[3];
    Outcome("bounds").check(rw_scene_bounds(handle, lower, upper));
    Outcome("bounds").check(rw_scene_bounds(scene.reference->judge(), judge_lower, judge_upper));
    demand(std::memcmp(lower, judge_lower, sizeof lower) == 0 && std::memcmp(upper, judge_upper, sizeof upper) == 0,
           "a scene's bounds differ from the judge's");

    CallerStruct<rw_scene_statistics> statistics(input, {});
    Outcome outcome("statistics");
    outcome.fails_if(statistics.is_wrong(), RW_ERROR_INVALID_ARGUMENT);
    if (!outcome.check(rw_scene_get_statistics(handle, statistics.get()))) {
        demand(statistics.is_unchanged(), "statistics were written although the call was refused");
        return;
    }
    const rw_scene_statistics facts = statistics.result();
    std::uint64_t triangles = 0;
    std::uint64_t invalid = 0;
    for (const auto& mesh : scene.meshes) {
        triangles += mesh->triangle_count();
        invalid += mesh->invalid_count();
    }
    demand(facts.geometry_count == scene.meshes.size(), "a scene miscounts its meshes");
    demand(facts.triangle_count == triangles && facts.invalid_triangles == invalid, "a scene miscounts its triangles");
    const bool is_empty = facts.degenerate_triangles + invalid == triangles;
    demand(facts.degenerate_triangles + invalid <= triangles, "more degenerate triangles than there are");
    for (int axis = 0; axis < 3; ++axis) {
        demand(is_empty ? lower[axis] == INFINITY && upper[axis] == -INFINITY
                        : std::isfinite(lower[axis]) && std::isfinite(upper[axis]) && lower[axis] <= upper[axis],
               "the bounds are those of another scene");
    }
    demand(scene.forced.empty() || scene.forced == facts.structure, "another structure than the one forced");
    demand(scene.memory_limit == 0 || facts.structure_bytes <= scene.memory_limit,
           "the structure is over its memory limit");
    if (scene.usage->is_known &&
        (facts.rays != scene.usage->batch_rays || facts.invalid_rays != scene.usage->nan_rays)) {
        fail("%llu rays in batches and %llu with a NaN were asked, the scene says %llu and %llu",
             static_cast<unsigned long long>(scene.usage->batch_rays),
             static_cast<unsigned long long>(scene.usage->nan_rays), static_cast<unsigned long long>(facts.rays),
             static_cast<unsigned long long>(facts.invalid_rays));
    }

    CallerStruct<rw_grid_statistics> grid(input, {});
    Outcome grid_outcome("grid statistics");
    grid_outcome.fails_if(grid.is_wrong(), RW_ERROR_INVALID_ARGUMENT)
        .fails_if(std::strcmp(facts.structure, "uniform_grid") != 0, RW_ERROR_WRONG_STRUCTURE);
    if (grid_outcome.check(rw_scene_get_grid_statistics(handle, grid.get()))) {
        const rw_grid_statistics g = grid.result();
        demand(
            g.cells == std::uint64_t{g.resolution[0]} * g.resolution[1] * g.resolution[2] && g.empty_cells <= g.cells,
            "a grid miscounts its cells");
        demand(g.max_references <= g.references && g.variance >= 0.0 && g.sparseness >= 0.0 && g.sparseness <= 1.0,
               "a grid's statistics contradict each other");
    } else {
        demand(grid.is_unchanged(), "grid statistics were written although the call was refused");
    }
}

} // namespace raywise::fuzz
