// What a scene tells of itself: statistics, bounds, candidates, explanations, structures, profiles and meshes.
#include "testing.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include <unistd.h>

namespace {

// Asks a text function for its size, then for the text, with buffers of every awkward size.
template <class Call>
std::string text_of(const Call& call) {
    uint64_t needed = 0, again = 0;
    CHECK_OK(call(nullptr, 0, &needed));
    CHECK(needed > 1);
    std::string text(needed, '?');
    CHECK_OK(call(&text[0], needed, &again));
    CHECK(again == needed && text.size() == needed && text.back() == '\0');
    CHECK(strlen(text.c_str()) == needed - 1);
    CHECK_OK(call(&text[0], needed, nullptr));
    for (const uint64_t capacity : {uint64_t{1}, needed / 2, needed - 1}) {
        std::string part(needed + 8, '?');
        again = 0;
        CHECK_ERROR(call(&part[0], capacity, &again), RW_ERROR_CAPACITY, "buffer");
        CHECK(again == needed && part[capacity - 1] == '\0' && part[capacity] == '?');
        CHECK(text.compare(0, capacity - 1, part, 0, capacity - 1) == 0);
    }
    text.pop_back();
    return text;
}

void structures() {
    uint32_t count = 0;
    NEED_OK(rw_structure_count(&count));
    const std::vector<std::string> wanted = {"linear_scan",   "uniform_grid", "kd_tree",   "bvh",
                                             "projected_bvh", "bvh_quality",  "bvh_morton"};
    CHECK(count == wanted.size());
    for (uint32_t i = 0; i < count; ++i) {
        const char* name = nullptr;
        CHECK_OK(rw_structure_name(i, &name));
        CHECK(name == wanted[i]);
    }
}

void statistics_and_bounds() {
    // Two good triangles, one without area, one with an index out of range.
    const double vertices[] = {0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, -3, 5, 5, 5};
    const uint64_t indices[] = {0, 1, 2, 0, 2, 3, 4, 4, 0, 0, 1, 99};
    rw_triangles t{};
    t.struct_size = sizeof t;
    t.flags = RW_TRIANGLES_SKIP_INVALID;
    t.vertex_count = 5;
    t.vertices.data = vertices;
    t.vertices.type = RW_FLOAT64;
    t.triangle_count = 4;
    t.indices.data = indices;
    t.indices.type = RW_UINT64;
    uint32_t structure_count = 0;
    NEED_OK(rw_structure_count(&structure_count));
    for (uint32_t i = 0; i < structure_count; ++i) {
        const char* name = nullptr;
        rw_scene* scene = nullptr;
        uint32_t geometry = 9;
        NEED_OK(rw_structure_name(i, &name));
        NEED_OK(rw_scene_create(nullptr, &scene));
        NEED_OK(rw_scene_add_triangles(scene, &t, &geometry));
        CHECK(geometry == 0);
        NEED_OK(rw_scene_add_triangles(scene, &t, &geometry));
        CHECK(geometry == 1);
        NEED_OK(rw_scene_set_structure(scene, name));
        NEED_OK(rw_scene_commit(scene, nullptr));
        rw_scene_statistics facts{};
        facts.struct_size = sizeof facts;
        CHECK_OK(rw_scene_get_statistics(scene, &facts));
        CHECK(facts.geometry_count == 2 && facts.triangle_count == 8 && facts.degenerate_triangles == 2 &&
              facts.invalid_triangles == 2);
        CHECK(facts.structure != nullptr && std::string(facts.structure) == name);
        CHECK(facts.build_ns >= 0.0 && facts.decide_ns >= 0.0 && facts.structure_bytes > 0 && facts.geometry_bytes > 0);
        CHECK(facts.rays == 0 && facts.invalid_rays == 0);
        double lower[3], upper[3];
        CHECK_OK(rw_scene_bounds(scene, lower, upper));
        CHECK(lower[0] == 0 && lower[1] == 0 && lower[2] == -3 && upper[0] == 1 && upper[1] == 2 && upper[2] == 0);
        const rw_ray ray = {{0.1, 0.1, 1}, 0, {0, 0, -1}, INFINITY};
        rw_hit hit;
        CHECK_OK(rw_scene_intersect(scene, &ray, nullptr, &hit));
        CHECK(hit.t == 1.0 && hit.geometry == 0 && hit.primitive == 0 && hit.instance == RW_INVALID_ID);
        CHECK(hit.u == 0.1 && hit.v == 0.05);
        double normal[3];
        CHECK_OK(rw_scene_normal(scene, &hit, normal));
        CHECK(normal[0] == 0 && normal[1] == 0 && normal[2] == 1);

        rw_grid_statistics grid{};
        grid.struct_size = sizeof grid;
        if (std::string(name) == "uniform_grid") {
            CHECK_OK(rw_scene_get_grid_statistics(scene, &grid));
            CHECK(grid.cells == uint64_t{grid.resolution[0]} * grid.resolution[1] * grid.resolution[2] &&
                  grid.cells > 0);
            CHECK(grid.empty_cells <= grid.cells && grid.references >= 4 && grid.max_references >= 1);
            CHECK(std::fabs(grid.mean - static_cast<double>(grid.references) / static_cast<double>(grid.cells)) <
                  1e-12);
            CHECK(std::fabs(grid.sparseness - static_cast<double>(grid.empty_cells) / static_cast<double>(grid.cells)) <
                  1e-12);
            CHECK(std::fabs(grid.standard_deviation * grid.standard_deviation - grid.variance) < 1e-9);
        } else {
            CHECK_ERROR(rw_scene_get_grid_statistics(scene, &grid), RW_ERROR_WRONG_STRUCTURE, name);
        }
        rw_scene_release(scene);
    }
}

void empty_scenes() {
    for (const char* name : {"linear_scan", "uniform_grid", "kd_tree", "bvh", "projected_bvh", "bvh_quality",
                             "bvh_morton", static_cast<const char*>(nullptr)}) {
        for (const bool with_mesh : {false, true}) {
            rw_scene* scene = nullptr;
            NEED_OK(rw_scene_create(nullptr, &scene));
            rw_triangles none{};
            none.struct_size = sizeof none;
            if (with_mesh) CHECK_OK(rw_scene_add_triangles(scene, &none, nullptr));
            CHECK_OK(rw_scene_set_structure(scene, name));
            CHECK_OK(rw_scene_commit(scene, nullptr));
            double lower[3], upper[3];
            CHECK_OK(rw_scene_bounds(scene, lower, upper));
            for (int axis = 0; axis < 3; ++axis) CHECK(lower[axis] == INFINITY && upper[axis] == -INFINITY);
            const rw_ray ray = random_ray();
            rw_hit hit;
            int32_t any = 7;
            uint64_t needed = 7;
            CHECK_OK(rw_scene_intersect(scene, &ray, nullptr, &hit));
            CHECK(hit.t == INFINITY && hit.primitive == RW_INVALID_ID);
            CHECK_OK(rw_scene_occluded(scene, &ray, nullptr, &any));
            CHECK_OK(rw_scene_intersect_all(scene, &ray, nullptr, nullptr, 0, &needed));
            CHECK(any == 0 && needed == 0);
            CHECK(!text_of([&](char* b, uint64_t c, uint64_t* n) {
                       return rw_scene_explain(scene, RW_FORMAT_TEXT, b, c, n);
                   }).empty());
            rw_view_options options{};
            options.struct_size = sizeof options;
            options.count = 10;
            options.structure = name;
            rw_scene* view = nullptr;
            CHECK_OK(rw_scene_view(scene, &options, nullptr, &view));
            CHECK_OK(rw_scene_intersect(view, &ray, nullptr, &hit));
            CHECK(hit.t == INFINITY);
            rw_scene_release(view);
            rw_scene_release(scene);
        }
    }
    rw_rays rays{};
    rw_hits hits{};
    rays.struct_size = sizeof rays;
    hits.struct_size = sizeof hits;
    CHECK_OK(rw_once_intersect(nullptr, 0, &rays, &hits, nullptr));
}

void candidates_and_explanations() {
    soup s = make_soup(500);
    for (const char* forced : {static_cast<const char*>(nullptr), "kd_tree"}) {
        rw_scene* scene = make_scene(&s, forced);
        uint32_t count = 0, structure_count = 0, chosen = 0;
        CHECK_OK(rw_scene_candidate_count(scene, &count));
        CHECK_OK(rw_structure_count(&structure_count));
        CHECK(count == structure_count);
        rw_scene_statistics facts{};
        facts.struct_size = sizeof facts;
        CHECK_OK(rw_scene_get_statistics(scene, &facts));
        for (uint32_t i = 0; i < count; ++i) {
            rw_candidate c{};
            const char* name = nullptr;
            c.struct_size = sizeof c;
            CHECK_OK(rw_scene_get_candidate(scene, i, &c));
            CHECK_OK(rw_structure_name(i, &name));
            CHECK(std::string(c.structure) == name);
            if ((c.flags & RW_CANDIDATE_NOT_APPLICABLE) == 0)
                CHECK(c.predicted_build_ns >= 0.0 && c.predicted_ray_ns > 0.0);
            if ((c.flags & RW_CANDIDATE_CHOSEN) == 0) continue;
            ++chosen;
            CHECK(std::string(c.structure) == facts.structure);
            CHECK(std::isnan(c.break_even_rays));
            CHECK(((c.flags & RW_CANDIDATE_FORCED) != 0) == (forced != nullptr));
            CHECK(c.actual_bytes == facts.structure_bytes && c.actual_build_ns >= 0.0);
        }
        CHECK(chosen == 1);
        const std::string text =
            text_of([&](char* b, uint64_t c, uint64_t* n) { return rw_scene_explain(scene, RW_FORMAT_TEXT, b, c, n); });
        const std::string json =
            text_of([&](char* b, uint64_t c, uint64_t* n) { return rw_scene_explain(scene, RW_FORMAT_JSON, b, c, n); });
        CHECK(!nlohmann::json::parse(json, nullptr, false).is_discarded());
        for (uint32_t i = 0; i < structure_count; ++i) {
            const char* name = nullptr;
            CHECK_OK(rw_structure_name(i, &name));
            CHECK(text.find(name) != std::string::npos);
            CHECK(json.find(std::string("\"") + name + "\"") != std::string::npos);
        }
        rw_view_options options{};
        options.struct_size = sizeof options;
        options.count = 1000;
        options.origin[0] = 4;
        rw_scene* view = nullptr;
        CHECK_OK(rw_scene_view(scene, &options, nullptr, &view));
        CHECK_OK(rw_scene_candidate_count(view, &count));
        CHECK(count == structure_count);
        for (uint32_t i = 0; i < count; ++i) {
            rw_candidate c{};
            c.struct_size = sizeof c;
            CHECK_OK(rw_scene_get_candidate(view, i, &c));
        }
        const std::string of_view =
            text_of([&](char* b, uint64_t c, uint64_t* n) { return rw_scene_explain(view, RW_FORMAT_JSON, b, c, n); });
        CHECK(!nlohmann::json::parse(of_view, nullptr, false).is_discarded());
        rw_scene_release(view);
        rw_scene_release(scene);
    }
    free_soup(&s);
}

void profiles() {
    rw_profile* profile = nullptr;
    NEED_OK(rw_profile_load(nullptr, &profile));
    const std::string json =
        text_of([&](char* b, uint64_t c, uint64_t* n) { return rw_profile_text(profile, RW_FORMAT_JSON, b, c, n); });
    CHECK(!nlohmann::json::parse(json, nullptr, false).is_discarded());
    text_of([&](char* b, uint64_t c, uint64_t* n) { return rw_profile_text(profile, RW_FORMAT_TEXT, b, c, n); });
    rw_profile_info info{};
    info.struct_size = sizeof info;
    CHECK_OK(rw_profile_inspect(profile, &info));
    CHECK(info.source == RW_PROFILE_SOURCE_GENERIC || info.source >= RW_PROFILE_SOURCE_PATH);
    CHECK(info.epoch > 0);
    // Whatever the profile says, the answers are the same; the scene keeps it.
    soup s = make_soup(50);
    rw_scene* scene = nullptr;
    const rw_triangles t = triangles_of(&s);
    NEED_OK(rw_scene_create(profile, &scene));
    CHECK_OK(rw_profile_retain(profile));
    CHECK_OK(rw_profile_release(profile));
    CHECK_OK(rw_profile_release(profile));
    NEED_OK(rw_scene_add_triangles(scene, &t, nullptr));
    CHECK_OK(rw_scene_commit(scene, nullptr));
    rw_scene_release(scene);
    free_soup(&s);
}

// The mesh of a file with this ending and content, and its arrays.
rw_mesh* mesh_of_file(const std::string& ending, const char* content, rw_triangles& t) {
    std::string path = "/tmp/raywise-facts-XXXXXX" + ending;
    const int descriptor = mkstemps(path.data(), static_cast<int>(ending.size()));
    CHECK(descriptor >= 0 && close(descriptor) == 0);
    std::ofstream(path) << content;
    rw_mesh* mesh = nullptr;
    NEED_OK(rw_mesh_load(path.c_str(), &mesh));
    remove(path.c_str());
    t.struct_size = sizeof t;
    CHECK_OK(rw_mesh_triangles(mesh, &t));
    return mesh;
}

void mesh_files() {
    rw_triangles t{};
    rw_mesh* mesh =
        mesh_of_file(".off", "OFF\n5 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 2\n4 0 1 2 3\n3 0 1 4\n4 1 2 3 4\n", t);
    CHECK(t.struct_size == sizeof t && t.vertex_count == 5 && t.triangle_count == 5 && t.vertices.data != nullptr &&
          t.indices.data != nullptr);
    CHECK(t.vertices.type == RW_FLOAT32 && t.vertices.stride == 0 && t.indices.type == RW_UINT32);
    const uint32_t* faces = nullptr;
    uint64_t face_count = 0;
    CHECK_OK(rw_mesh_faces(mesh, &faces, &face_count));
    CHECK(face_count == 3 && faces[0] == 0 && faces[1] == 0 && faces[2] == 1 && faces[3] == 2 && faces[4] == 2);
    CHECK_OK(rw_mesh_faces(mesh, &faces, nullptr));
    // Shared: the scene reads the mesh's own arrays.
    t.flags = RW_TRIANGLES_SHARED;
    rw_scene* scene = nullptr;
    NEED_OK(rw_scene_create(nullptr, &scene));
    NEED_OK(rw_scene_add_triangles(scene, &t, nullptr));
    CHECK_OK(rw_scene_commit(scene, nullptr));
    const rw_ray ray = {{0.75, 0.25, -1}, 0, {0, 0, 4}, INFINITY};
    rw_hit hit;
    CHECK_OK(rw_scene_intersect(scene, &ray, nullptr, &hit));
    CHECK(hit.t == 0.25 && hit.primitive == 0);
    rw_scene_release(scene);
    CHECK_OK(rw_mesh_retain(mesh));
    CHECK_OK(rw_mesh_release(mesh));
    CHECK_OK(rw_mesh_release(mesh));
}

// Without float64, this triangle would be a line; a ray goes through its middle.
void mesh_files_of_float64() {
    rw_triangles t{};
    rw_mesh* mesh =
        mesh_of_file(".obj", "v 6378137.123456789 0 0\nv 6378137.123456790 8 0\nv 6378137.123456790 0 8\nf 1 2 3\n", t);
    CHECK(t.vertices.type == RW_FLOAT64 && static_cast<const double*>(t.vertices.data)[0] == 6378137.123456789);
    for (const uint32_t flags : {0u, RW_TRIANGLES_SHARED}) {
        t.flags = flags;
        rw_scene* scene = nullptr;
        NEED_OK(rw_scene_create(nullptr, &scene));
        NEED_OK(rw_scene_add_triangles(scene, &t, nullptr));
        CHECK_OK(rw_scene_commit(scene, nullptr));
        const rw_ray ray = {{0, 2, 2}, 0, {1, 0, 0}, INFINITY};
        rw_hit hit;
        CHECK_OK(rw_scene_intersect(scene, &ray, nullptr, &hit));
        CHECK(hit.primitive == 0 && hit.t >= 6378137.123456789 && hit.t <= 6378137.123456790);
        char text[8192];
        CHECK_OK(rw_scene_explain(scene, RW_FORMAT_TEXT, text, sizeof text, nullptr));
        CHECK(strstr(text, "\nvertices: float64\n") != nullptr);
        CHECK_OK(rw_scene_explain(scene, RW_FORMAT_JSON, text, sizeof text, nullptr));
        CHECK(strstr(text, "\"vertices\": \"float64\"") != nullptr ||
              strstr(text, "\"vertices\":\"float64\"") != nullptr);
        rw_scene_release(scene);
    }
    rw_mesh_release(mesh);
}

} // namespace

int main() {
    use_all_helpers();
    structures();
    statistics_and_bounds();
    empty_scenes();
    candidates_and_explanations();
    profiles();
    mesh_files();
    mesh_files_of_float64();
    return finish("facts");
}
