// A committed scene whose meshes have moved: the same bits as from any scene with these meshes, whatever moved and how; and what the
// new scene takes over from the old one.
#include "testing.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr uint64_t triangle_count = 400;

rw_triangles describe_vertices(const std::vector<double>& vertices) {
    rw_triangles t{};
    t.struct_size = sizeof t;
    t.vertex_count = vertices.size() / 3;
    t.vertices.data = vertices.data();
    t.vertices.type = RW_FLOAT64;
    return t;
}

// A mesh with shared vertices, a second one of single triangles, as float64.
struct Geometry {
    std::vector<double> sheet; // (side + 1)^2 vertices
    std::vector<uint32_t> sheet_indices;
    std::vector<double> soup; // 3 per triangle

    rw_triangles describe_sheet() const {
        rw_triangles t = describe_vertices(sheet);
        t.triangle_count = sheet_indices.size() / 3;
        t.indices.data = sheet_indices.data();
        return t;
    }
    rw_triangles describe_soup() const {
        rw_triangles t = describe_vertices(soup);
        t.triangle_count = soup.size() / 9;
        return t;
    }
    std::vector<rw_triangles> describe() const { return {describe_sheet(), describe_soup()}; }
};

Geometry make_geometry() {
    Geometry g;
    constexpr uint32_t side = 12;
    for (uint32_t y = 0; y <= side; ++y) {
        for (uint32_t x = 0; x <= side; ++x) {
            g.sheet.push_back(-1.0 + x / 6.0);
            g.sheet.push_back(-1.0 + y / 6.0);
            g.sheet.push_back((x * 7 + y * 3) % 5 / 16.0);
        }
    }
    for (uint32_t y = 0; y < side; ++y) {
        for (uint32_t x = 0; x < side; ++x) {
            const uint32_t a = y * (side + 1) + x;
            for (const uint32_t corner : {a, a + 1, a + side + 2, a, a + side + 2, a + side + 1})
                g.sheet_indices.push_back(corner);
        }
    }
    const soup s = make_soup(triangle_count);
    g.soup.assign(s.vertices, s.vertices + 9 * triangle_count);
    soup mutable_soup = s;
    free_soup(&mutable_soup);
    return g;
}

using Move = std::function<void(double* p, uint64_t vertex)>;

Geometry move_all(Geometry g, const Move& move) {
    for (auto* vertices : {&g.sheet, &g.soup}) {
        for (uint64_t i = 0; i < vertices->size() / 3; ++i) move(&(*vertices)[3 * i], i);
    }
    return g;
}

void twist(double* p, uint64_t) {
    const double angle = 0.7 * p[2], x = p[0];
    p[0] = std::cos(angle) * x - std::sin(angle) * p[1];
    p[1] = std::sin(angle) * x + std::cos(angle) * p[1];
}

struct Deformation {
    const char* name;
    Move move;
};

const std::vector<Deformation>& deformations() {
    static const std::vector<Deformation> all = {
        {"nothing", [](double*, uint64_t) {}},
        {"far away",
         [](double* p, uint64_t) {
             p[0] += 1e9;
             p[2] -= 3e8;
         }},
        {"tiny",
         [](double* p, uint64_t) {
             for (int axis = 0; axis < 3; ++axis) p[axis] *= 1e-20;
         }},
        {"twisted", twist},
        {"collapsed to points",
         [](double* p, uint64_t i) {
             if (i / 3 % 4 == 0) p[0] = p[1] = p[2] = 0.5;
         }},
        {"exploded",
         [](double* p, uint64_t i) { // each triangle of the soup as a whole, the sheet in rags
             for (uint64_t axis = 0; axis < 3; ++axis)
                 p[axis] += static_cast<double>((i / 3 * 2654435761u + axis * 40503u) % 1009) / 50.0;
         }},
        {"a pole of no width",
         [](double* p, uint64_t) {
             p[0] *= 1e-12;
             p[1] *= 1e-12;
         }},
    };
    return all;
}

rw_scene* commit(const std::vector<rw_triangles>& meshes, const char* structure, uint64_t expected_rays) {
    rw_scene* scene = nullptr;
    NEED_OK(rw_scene_create(nullptr, &scene));
    for (const rw_triangles& mesh : meshes) NEED_OK(rw_scene_add_triangles(scene, &mesh, nullptr));
    rw_expected_rays expected{};
    expected.struct_size = sizeof expected;
    expected.count = expected_rays;
    NEED_OK(rw_scene_set_expected_rays(scene, &expected));
    NEED_OK(rw_scene_set_structure(scene, structure));
    NEED_OK(rw_scene_commit(scene, nullptr));
    return scene;
}

rw_scene* refit(const rw_scene* scene, const std::vector<rw_triangles>& meshes) {
    rw_scene* refitted = nullptr;
    NEED_OK(rw_scene_refit(scene, meshes.data(), static_cast<uint32_t>(meshes.size()), nullptr, &refitted));
    return refitted;
}

// From a vertex to another one, or past it.
std::vector<rw_ray> make_rays(const Geometry& g, int count) {
    std::vector<rw_ray> rays;
    const auto vertex = [&](int k) {
        const std::vector<double>& from = k % 2 == 0 ? g.sheet : g.soup;
        return &from[3 * (static_cast<uint64_t>(random_number(0.0, 1e9)) % (from.size() / 3))];
    };
    for (int i = 0; i < count; ++i) {
        rw_ray ray{};
        const double *a = vertex(i), *b = vertex(i / 2), *c = vertex(i / 3);
        for (int axis = 0; axis < 3; ++axis) {
            const double target = i % 3 == 0 ? b[axis] : 0.5 * b[axis] + 0.5 * c[axis];
            ray.origin[axis] = a[axis];
            ray.direction[axis] = target - a[axis];
        }
        if (i % 5 == 0) ray.direction[i / 5 % 3] = 0.0;
        ray.tmin = i % 4 == 0 ? -INFINITY : 0.0;
        ray.tmax = INFINITY;
        rays.push_back(ray);
    }
    return rays;
}

bool same_bits(const rw_hit& a, const rw_hit& b) { return memcmp(&a, &b, sizeof a) == 0; }

// Returns how many of the rays hit.
int check_same_answers(const rw_scene* scene, const rw_scene* judge, const std::vector<rw_ray>& rays) {
    int hits = 0;
    for (const rw_ray& ray : rays) {
        rw_hit expected, found;
        CHECK_OK(rw_scene_intersect(judge, &ray, nullptr, &expected));
        CHECK_OK(rw_scene_intersect(scene, &ray, nullptr, &found));
        CHECK(same_bits(expected, found));
        hits += expected.primitive != RW_INVALID_ID ? 1 : 0;
        int32_t occluded = 9;
        CHECK_OK(rw_scene_occluded(scene, &ray, nullptr, &occluded));
        CHECK(occluded == (expected.primitive != RW_INVALID_ID ? 1 : 0));
        std::vector<rw_hit> all(2000), all_found(2000);
        uint64_t count = 0, found_count = 0;
        CHECK_OK(rw_scene_intersect_all(judge, &ray, nullptr, all.data(), all.size(), &count));
        CHECK_OK(rw_scene_intersect_all(scene, &ray, nullptr, all_found.data(), all_found.size(), &found_count));
        CHECK(count == found_count && memcmp(all.data(), all_found.data(), count * sizeof(rw_hit)) == 0);
    }
    rw_rays in{};
    in.struct_size = sizeof in;
    in.count = rays.size();
    in.origin.data = rays[0].origin;
    in.direction.data = rays[0].direction;
    in.tmin.data = &rays[0].tmin;
    in.tmax.data = &rays[0].tmax;
    for (rw_array* array : {&in.origin, &in.direction, &in.tmin, &in.tmax}) {
        array->stride = sizeof(rw_ray);
        array->type = RW_FLOAT64;
    }
    std::vector<double> t(rays.size()), expected_t(rays.size());
    rw_hits out{};
    out.struct_size = sizeof out;
    out.t.type = RW_FLOAT64;
    out.t.data = t.data();
    CHECK_OK(rw_scene_intersect_batch(scene, &in, &out, nullptr));
    out.t.data = expected_t.data();
    CHECK_OK(rw_scene_intersect_batch(judge, &in, &out, nullptr));
    CHECK(memcmp(t.data(), expected_t.data(), t.size() * sizeof t[0]) == 0);
    return hits;
}

rw_scene_statistics statistics_of(const rw_scene* scene) {
    rw_scene_statistics facts{};
    facts.struct_size = sizeof facts;
    NEED_OK(rw_scene_get_statistics(scene, &facts));
    return facts;
}

nlohmann::json explanation_of(const rw_scene* scene) {
    std::string text(65536, '\0');
    NEED_OK(rw_scene_explain(scene, RW_FORMAT_JSON, &text[0], text.size(), nullptr));
    return nlohmann::json::parse(text.c_str());
}

std::string text_of(const rw_scene* scene) {
    std::string text(65536, '\0');
    NEED_OK(rw_scene_explain(scene, RW_FORMAT_TEXT, &text[0], text.size(), nullptr));
    return text.c_str();
}

void same_bits_on_every_structure() {
    const Geometry rest = make_geometry();
    uint32_t structures = 0;
    NEED_OK(rw_structure_count(&structures));
    for (uint32_t i = 0; i < structures; ++i) {
        const char* structure = nullptr;
        NEED_OK(rw_structure_name(i, &structure));
        rw_scene* const scene = commit(rest.describe(), structure, 100);
        rw_scene* before = commit(rest.describe(), structure, 100);
        const std::vector<rw_ray> rest_rays = make_rays(rest, 30);
        for (const Deformation& deformation : deformations()) {
            const Geometry now = move_all(rest, deformation.move);
            rw_scene* const judge = commit(now.describe(), "linear_scan", RW_RAYS_UNKNOWN);
            // From the first place, and from the last one.
            rw_scene* const refitted = refit(scene, now.describe());
            rw_scene* const next = refit(before, now.describe());
            rw_scene_release(before);
            before = next;
            const std::vector<rw_ray> rays = make_rays(now, 60);
            const int faults = failures;
            CHECK(check_same_answers(refitted, judge, rays) > 5);
            check_same_answers(next, judge, rays);
            CHECK(std::string(statistics_of(refitted).structure) == structure);
            if (failures != faults) fprintf(stderr, "    %s, %s\n", structure, deformation.name);
            rw_scene_release(refitted);
            rw_scene_release(judge);
        }
        // The old scene is what it was.
        rw_scene* const judge = commit(rest.describe(), "linear_scan", RW_RAYS_UNKNOWN);
        check_same_answers(scene, judge, rest_rays);
        CHECK(statistics_of(scene).refits == 0);
        rw_scene_release(judge);
        rw_scene_release(before);
        rw_scene_release(scene);
    }
}

// How often, how far from what it was, and why not.
void what_became_of_the_structure() {
    const Geometry rest = make_geometry();
    const Geometry twisted = move_all(rest, twist);
    rw_scene* const scene = commit(rest.describe(), "bvh", 1000);
    rw_scene* const once = refit(scene, twisted.describe());
    rw_scene* const twice = refit(once, twisted.describe());
    CHECK(statistics_of(scene).refits == 0 && statistics_of(once).refits == 1 && statistics_of(twice).refits == 2);
    CHECK(explanation_of(scene)["refit"].is_null());
    CHECK(explanation_of(twice)["refit"]["refits"] == 2 && explanation_of(twice)["refit"]["obstacle"] == "");
    CHECK(explanation_of(twice)["refit"]["cost"].get<double>() > 0.5);
    CHECK(explanation_of(twice)["chosen"] == "bvh" && explanation_of(twice)["forced"] == true);
    CHECK(text_of(scene).find("refit") == std::string::npos);
    CHECK(text_of(twice).find("\nrefitted: 2 times") != std::string::npos);
    CHECK(statistics_of(once).structure_bytes == statistics_of(scene).structure_bytes);
    CHECK(statistics_of(once).build_ns > 0.0);

    // What could not be hit is in no tree.
    const Geometry points = move_all(rest, deformations()[4].move);
    rw_scene* const fewer = refit(scene, points.describe());
    CHECK(statistics_of(fewer).refits == 1 && statistics_of(fewer).degenerate_triangles > 0);
    rw_scene* const back = refit(fewer, rest.describe());
    CHECK(statistics_of(back).refits == 0);
    CHECK(explanation_of(back)["refit"]["obstacle"].get<std::string>().find("could not be hit") != std::string::npos);
    CHECK(text_of(back).find("\nnot refitted but built anew: a triangle that could not be hit") != std::string::npos);

    // A tree in shreds: with many rays to come another one pays, with one it does not.
    const Geometry exploded = move_all(rest, deformations()[5].move);
    for (const uint64_t rays : {uint64_t{1}, uint64_t{1000000000}}) {
        rw_scene* const patient = commit(rest.describe(), "bvh", rays);
        rw_scene* const shreds = refit(patient, exploded.describe());
        CHECK(statistics_of(shreds).refits == (rays == 1 ? 1u : 0u));
        CHECK(explanation_of(shreds)["refit"]["cost"].get<double>() > 1.1);
        rw_scene_release(shreds);
        rw_scene_release(patient);
    }
    rw_scene* const tree = commit(rest.describe(), "kd_tree", 1000);
    rw_scene* const other = refit(tree, twisted.describe());
    CHECK(explanation_of(other)["refit"]["obstacle"].get<std::string>().find("cannot be refitted") !=
          std::string::npos);
    for (rw_scene* each : {scene, once, twice, fewer, back, tree, other}) rw_scene_release(each);
}

// Vertices are what a deforming mesh has anew. Indices can be left out, given again, or be others.
void kept_indices() {
    const Geometry rest = make_geometry();
    Geometry now = move_all(rest, twist);
    rw_scene* const judge = commit(now.describe(), "linear_scan", RW_RAYS_UNKNOWN);
    const std::vector<rw_ray> rays = make_rays(now, 60);
    // 64-bit indices, some of them out of range in both halves.
    std::vector<uint64_t> wide(rest.sheet_indices.begin(), rest.sheet_indices.end());
    std::vector<rw_triangles> described = rest.describe();
    described[0].indices.type = RW_UINT64;
    described[0].indices.data = wide.data();
    wide[4] = (uint64_t{1} << 32) + 1;
    described[0].flags = RW_TRIANGLES_SKIP_INVALID;
    for (const bool shared : {false, true}) {
        if (shared) described[0].flags |= RW_TRIANGLES_SHARED;
        rw_scene* const scene = commit(described, "bvh", 1000);
        CHECK(statistics_of(scene).invalid_triangles == 1);
        std::vector<rw_triangles> moved = now.describe();
        moved[0].indices.data = nullptr;
        moved[0].flags = described[0].flags;
        rw_scene* const refitted = refit(scene, moved);
        CHECK(statistics_of(refitted).refits == 1 && statistics_of(refitted).invalid_triangles == 1);
        moved[0].flags = 0;
        rw_scene* none = nullptr;
        CHECK_ERROR(rw_scene_refit(scene, moved.data(), 2, nullptr, &none), RW_ERROR_INDEX_OUT_OF_RANGE,
                    "meshes[0].triangle 1|out of range");
        CHECK(none == nullptr);
        rw_scene_release(scene);
        rw_scene_release(refitted);
    }

    // The scene of before may go, and with it the indices it read in place.
    std::vector<uint32_t> in_place = rest.sheet_indices;
    described = rest.describe();
    described[0].flags = RW_TRIANGLES_SHARED;
    described[0].indices.data = in_place.data();
    rw_scene* scene = commit(described, "bvh", 1000);
    std::vector<rw_triangles> moved = now.describe();
    moved[0].indices.data = nullptr;
    for (int i = 0; i < 3; ++i) {
        rw_scene* const next = refit(scene, moved);
        rw_scene_release(scene);
        scene = next;
        in_place.assign(in_place.size(), 0); // the new scene has copied them
    }
    check_same_answers(scene, judge, rays);
    CHECK(statistics_of(scene).refits == 3);
    rw_scene_release(scene);

    // Other indices: another surface, and still the right answers.
    Geometry turned = now;
    std::reverse(turned.sheet_indices.begin(), turned.sheet_indices.end());
    scene = commit(rest.describe(), "bvh", 1000);
    rw_scene* const other = refit(scene, turned.describe());
    rw_scene* const other_judge = commit(turned.describe(), "linear_scan", RW_RAYS_UNKNOWN);
    check_same_answers(other, other_judge, make_rays(turned, 60));
    for (rw_scene* each : {scene, other, other_judge, judge}) rw_scene_release(each);
}

// Vertices that are shared with the scene and moved where they are.
void moved_in_place() {
    const Geometry rest = make_geometry();
    Geometry shared = rest;
    std::vector<rw_triangles> described = shared.describe();
    for (rw_triangles& mesh : described) mesh.flags = RW_TRIANGLES_SHARED;
    for (const char* structure : {"bvh", "linear_scan", "uniform_grid"}) {
        rw_scene* scene = commit(described, structure, 1);
        for (int frame = 0; frame < 3; ++frame) {
            for (auto* vertices : {&shared.sheet, &shared.soup}) {
                for (uint64_t i = 0; i < vertices->size() / 3; ++i) twist(&(*vertices)[3 * i], i);
            }
            rw_scene* const next = refit(scene, described);
            rw_scene_release(scene);
            scene = next;
            rw_scene* const judge = commit(shared.describe(), "linear_scan", RW_RAYS_UNKNOWN);
            check_same_answers(scene, judge, make_rays(shared, 40));
            rw_scene_release(judge);
        }
        rw_scene_release(scene);
    }
}

void what_was_said_before_the_commit() {
    const Geometry rest = make_geometry();
    rw_scene* const scene = commit(rest.describe(), nullptr, 123456);
    rw_scene* const refitted = refit(scene, rest.describe());
    const nlohmann::json before = explanation_of(scene), after = explanation_of(refitted);
    for (const char* member : {"expected_rays", "ray_kind", "effort", "rule", "chosen", "forced", "calibration"})
        CHECK(before[member] == after[member]);
    CHECK(before["candidates"].size() == after["candidates"].size());
    rw_scene_release(refitted);
    rw_scene_release(scene);
}

void empty_scenes_and_views() {
    rw_scene* empty = nullptr;
    NEED_OK(rw_scene_create(nullptr, &empty));
    NEED_OK(rw_scene_commit(empty, nullptr));
    rw_scene* refitted = nullptr;
    CHECK_OK(rw_scene_refit(empty, nullptr, 0, nullptr, &refitted));
    const rw_ray ray = random_ray();
    int32_t occluded = 9;
    CHECK_OK(rw_scene_occluded(refitted, &ray, nullptr, &occluded));
    CHECK(occluded == 0);
    rw_scene_release(refitted);
    rw_scene_release(empty);

    // A view of the new scene, which is not the old one's.
    const Geometry rest = make_geometry();
    const Geometry now = move_all(rest, twist);
    rw_scene* const scene = commit(rest.describe(), "bvh", 1000);
    rw_scene* const moved = refit(scene, now.describe());
    rw_view_options options{};
    options.struct_size = sizeof options;
    options.origin[2] = 4.0;
    options.count = 1000;
    rw_scene *old_view = nullptr, *view = nullptr;
    NEED_OK(rw_scene_view(scene, &options, nullptr, &old_view));
    NEED_OK(rw_scene_view(moved, &options, nullptr, &view));
    int differ = 0;
    for (int i = 0; i < 200; ++i) {
        rw_ray aimed = random_ray();
        for (int axis = 0; axis < 3; ++axis) aimed.origin[axis] = options.origin[axis];
        aimed.direction[2] = -3.0;
        rw_hit from_scene, from_view, before;
        CHECK_OK(rw_scene_intersect(moved, &aimed, nullptr, &from_scene));
        CHECK_OK(rw_scene_intersect(view, &aimed, nullptr, &from_view));
        CHECK_OK(rw_scene_intersect(old_view, &aimed, nullptr, &before));
        CHECK(same_bits(from_scene, from_view));
        differ += same_bits(from_view, before) ? 0 : 1;
    }
    CHECK(differ > 0);
    rw_scene_release(view);
    rw_scene_release(old_view);
    rw_scene_release(moved);
    rw_scene_release(scene);
}

void by_several_threads_at_once() {
    const Geometry rest = make_geometry();
    rw_scene* const scene = commit(rest.describe(), "bvh", 1000);
    std::vector<rw_scene*> made(4, nullptr);
    std::vector<Geometry> places;
    for (std::size_t i = 0; i < made.size(); ++i) places.push_back(move_all(rest, deformations()[i].move));
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < made.size(); ++i) {
        threads.emplace_back([&, i] {
            const std::vector<rw_triangles> meshes = places[i].describe();
            if (rw_scene_refit(scene, meshes.data(), 2, nullptr, &made[i]) != RW_OK) made[i] = nullptr;
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (std::size_t i = 0; i < made.size(); ++i) {
        if (!CHECK(made[i] != nullptr)) continue;
        rw_scene* const judge = commit(places[i].describe(), "linear_scan", RW_RAYS_UNKNOWN);
        check_same_answers(made[i], judge, make_rays(places[i], 20));
        rw_scene_release(judge);
        rw_scene_release(made[i]);
    }
    rw_scene_release(scene);
}

} // namespace

int main() {
    use_all_helpers();
    same_bits_on_every_structure();
    what_became_of_the_structure();
    kept_indices();
    moved_in_place();
    what_was_said_before_the_commit();
    empty_scenes_and_views();
    by_several_threads_at_once();
    return finish("refit");
}
