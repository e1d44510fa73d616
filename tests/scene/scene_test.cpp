#include "scene/scene.h"

#include "scene/testing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace raywise {
namespace {

using namespace testing;

std::shared_ptr<const Profile> generic() { return std::make_shared<const Profile>(generic_profile()); }

Status status_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.status();
    }
    return Status::OK;
}

TEST(Scene, CannotBeAskedBeforeTheCommitNorChangedAfterIt) {
    const Soup soup = make_soup(10);
    Scene scene(generic());
    EXPECT_EQ(status_of([&] { scene.tracer(); }), Status::ERROR_NOT_COMMITTED);
    EXPECT_EQ(status_of([&] { scene.plan(); }), Status::ERROR_NOT_COMMITTED);
    scene.add_triangles(soup.arrays(), true, false);
    Progress progress;
    scene.commit(Parallel(1), progress);
    EXPECT_TRUE(scene.is_committed());
    EXPECT_EQ(status_of([&] { scene.add_triangles(soup.arrays(), true, false); }), Status::ERROR_ALREADY_COMMITTED);
    EXPECT_EQ(status_of([&] { scene.set_memory_limit(1); }), Status::ERROR_ALREADY_COMMITTED);
    EXPECT_EQ(status_of([&] { scene.commit(Parallel(1), progress); }), Status::ERROR_ALREADY_COMMITTED);
}

TEST(Scene, StaysAsItWasWhenAMeshIsRefused) {
    const Soup soup = make_soup(10);
    Soup bad = make_soup(10);
    bad.vertices[40] = std::numeric_limits<float>::quiet_NaN();
    Scene scene(generic());
    EXPECT_EQ(scene.add_triangles(soup.arrays(), true, false), 0u);
    EXPECT_EQ(status_of([&] { scene.add_triangles(bad.arrays(), true, false); }), Status::ERROR_NOT_FINITE);
    EXPECT_EQ(scene.add_triangles(soup.arrays(), true, false), 1u);
    Progress progress;
    scene.commit(Parallel(1), progress);
    EXPECT_EQ(scene.tracer().primitives().count(), 20u);
}

TEST(Scene, CanBeCommittedAgainAfterACancelledCommit) {
    const Soup soup = make_soup(2000);
    for (const Structure structure : all_structures()) {
        Scene scene(generic());
        scene.add_triangles(soup.arrays(), true, false);
        scene.set_structure(structure);
        Progress stop([](double, const char*) { return true; });
        EXPECT_EQ(status_of([&] { scene.commit(Parallel(2), stop); }), Status::ERROR_CANCELLED) << name_of(structure);
        EXPECT_FALSE(scene.is_committed());
        Progress go;
        scene.commit(Parallel(2), go);
        EXPECT_EQ(scene.plan().chosen, structure);
    }
}

TEST(Scene, ReportsProgressThatNeverGoesBeyondItsEnds) {
    const Soup soup = make_soup(5000);
    for (const Structure structure : all_structures()) {
        double last = -1.0;
        Progress progress(expect_within_ends(last));
        Scene scene(generic());
        scene.add_triangles(soup.arrays(), true, false);
        scene.set_structure(structure);
        scene.commit(Parallel(2), progress);
        EXPECT_EQ(last, 1.0);
    }
}

TEST(Scene, WithoutTrianglesMissesEverything) {
    for (const Structure structure : all_structures()) {
        Scene scene(generic());
        scene.set_structure(structure);
        Progress progress;
        scene.commit(Parallel(1), progress);
        for (const Ray& ray : make_chords(20)) {
            EXPECT_EQ(scene.tracer().closest(ray).primitive, invalid_id);
            EXPECT_FALSE(scene.tracer().any(ray));
        }
        EXPECT_TRUE(scene.tracer().primitives().bounds().empty());
    }
}

TEST(Scene, AnswersManyRaysAsItDoesEach) {
    std::vector<Ray> rays = make_chords(300);
    for (std::size_t i = 0; i < rays.size(); i += 3) rays[i].tmax = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 1; i < rays.size(); i += 30) rays[i].direction = Vec3(0.0);
    for (const Structure structure : all_structures()) {
        SCOPED_TRACE(name_of(structure));
        const auto scene = make_scene(make_soup(500), generic(), [&](Scene& s) { s.set_structure(structure); });
        const Tracer& tracer = scene->tracer();
        std::vector<std::uint32_t> skipped;
        for (const Ray& ray : rays) skipped.push_back(tracer.closest(ray).primitive);
        std::vector<Query> queries;
        for (const std::uint32_t& primitive : skipped)
            queries.push_back({{&primitive, primitive == invalid_id ? &primitive : &primitive + 1}});
        for (const bool skips : {false, true}) {
            const RayPacket packet{rays.data(), skips ? queries.data() : nullptr, rays.size()};
            const std::uint64_t before = tracer.usage().invalid_rays;
            Scratch scratch;
            auto* const closest = scratch.take<PrimitiveHit>(rays.size());
            auto* const any = scratch.take<bool>(rays.size());
            std::vector<PrimitiveHit> all(2); // there are some already
            std::vector<std::size_t> ends(rays.size());
            EXPECT_EQ(tracer.closest_many(packet, closest, scratch), 100u);
            EXPECT_EQ(tracer.any_many(packet, any, scratch), 100u);
            EXPECT_EQ(tracer.all_many(packet, all, ends.data()), 100u);
            EXPECT_EQ(tracer.usage().invalid_rays - before, 300u);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                EXPECT_TRUE(same_bits(tracer.to_caller(closest[i]), tracer.closest(rays[i], packet.query(i)))) << i;
                EXPECT_EQ(any[i], tracer.any(rays[i], packet.query(i))) << i;
                std::vector<Hit> expected;
                tracer.all(rays[i], expected, packet.query(i));
                const std::size_t first = i == 0 ? 2 : ends[i - 1];
                ASSERT_EQ(ends[i] - first, expected.size()) << i;
                for (std::size_t k = 0; k < expected.size(); ++k)
                    EXPECT_TRUE(same_bits(tracer.to_caller(all[first + k]), expected[k])) << i;
            }
        }
    }
}

TEST(Scene, AnswersManyRaysOfFloat32AsItDoesEach) {
    std::vector<RayF> rays;
    for (const Ray& ray : make_chords(300))
        rays.push_back({glm::vec3(ray.origin), static_cast<float>(ray.tmin), glm::vec3(ray.direction), 1e30f});
    for (std::size_t i = 0; i < rays.size(); i += 3) rays[i].direction.y = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = 1; i < rays.size(); i += 30) rays[i].direction = glm::vec3(0.0f);
    for (const Structure structure : all_structures()) {
        SCOPED_TRACE(name_of(structure));
        const auto scene = make_scene(make_soup(500), generic(), [&](Scene& s) { s.set_structure(structure); });
        const Tracer& tracer = scene->tracer();
        const RayPacketF packet{rays.data(), nullptr, rays.size()};
        const std::uint64_t before = tracer.usage().invalid_rays;
        Scratch scratch;
        auto* const closest = scratch.take<PrimitiveHit>(rays.size());
        auto* const any = scratch.take<bool>(rays.size());
        EXPECT_EQ(tracer.closest_many(packet, closest, scratch), 100u);
        EXPECT_EQ(tracer.any_many(packet, any, scratch), 100u);
        EXPECT_EQ(tracer.usage().invalid_rays - before, 200u);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            EXPECT_TRUE(same_bits(tracer.to_caller(closest[i]), tracer.closest(widened(rays[i])))) << i;
            EXPECT_EQ(any[i], tracer.any(widened(rays[i]))) << i;
        }
    }
}

TEST(Scene, CountsRaysWithANan) {
    const auto scene = make_scene(make_soup(10), generic());
    Ray ray;
    ray.direction = {0, 0, 1};
    ray.origin.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(scene->tracer().closest(ray).primitive, invalid_id);
    EXPECT_FALSE(scene->tracer().any(ray));
    std::vector<Hit> hits;
    scene->tracer().all(ray, hits);
    EXPECT_TRUE(hits.empty());
    EXPECT_EQ(scene->tracer().usage().invalid_rays.load(), 3u);
}

TEST(Scene, NamesMeshAndTriangleOfAHit) {
    const Soup soup = make_soup(50, 1);
    const Soup other = make_soup(70, 2);
    Scene scene(generic());
    scene.add_triangles(soup.arrays(), true, false);
    scene.add_triangles(other.arrays(), true, false);
    Progress progress;
    scene.commit(Parallel(1), progress);
    int from_each[2] = {0, 0};
    for (const Ray& ray : make_chords(2000)) {
        const Hit hit = scene.tracer().closest(ray);
        if (hit.primitive == invalid_id) continue;
        ASSERT_LT(hit.geometry, 2u);
        ASSERT_LT(hit.primitive, hit.geometry == 0 ? 50u : 70u);
        ++from_each[hit.geometry];
        const float* v = (hit.geometry == 0 ? soup : other).vertices.data() + 9 * hit.primitive;
        const Vec3 a(v[0], v[1], v[2]), b(v[3], v[4], v[5]), c(v[6], v[7], v[8]);
        const Vec3 on_triangle = (1.0 - hit.u - hit.v) * a + hit.u * b + hit.v * c;
        const Vec3 on_ray = ray.origin + hit.t * ray.direction;
        EXPECT_LT(glm::length(on_triangle - on_ray), 1e-12);
        const Vec3 normal = unit_normal(scene.tracer().primitives().meshes()[hit.geometry]->corners(hit.primitive));
        EXPECT_NEAR(glm::length(normal), 1.0, 1e-14);
        EXPECT_NEAR(glm::dot(normal, b - a), 0.0, 1e-7);
        EXPECT_GT(glm::dot(normal, glm::cross(b - a, c - a)), 0.0);
    }
    EXPECT_GT(from_each[0], 0);
    EXPECT_GT(from_each[1], 0);
}

// ---- Areas are not looked at before somebody needs them.

std::shared_ptr<Scene> scene_for(const Soup& soup, std::optional<std::uint64_t> rays,
                                 std::optional<Structure> structure = Structure::linear_scan) {
    return make_scene(soup, generic(), [&](Scene& scene) {
        scene.set_expected({rays, RayKind::any}, {});
        scene.set_structure(structure);
    });
}

Soup with_some_degenerate() {
    Soup soup = make_soup(900, 3);
    for (std::size_t triangle = 0; triangle < 900; triangle += 4)
        std::copy_n(&soup.vertices[9 * triangle], 3, &soup.vertices[9 * triangle + 3]);
    return soup;
}

bool are_areas_settled(const Scene& scene) { return scene.tracer().primitives().are_areas_settled(); }

TEST(Scene, LeavesAreasAloneForFewRays) {
    const Soup soup = with_some_degenerate();
    EXPECT_TRUE(are_areas_settled(*scene_for(soup, std::nullopt)));
    EXPECT_TRUE(are_areas_settled(*scene_for(soup, 256)));
    for (const Structure structure : all_structures()) {
        if (structure == Structure::linear_scan) continue;
        EXPECT_TRUE(are_areas_settled(*scene_for(soup, 1, structure))) << name_of(structure);
    }
    const auto settled = scene_for(soup, std::nullopt);
    for (const std::uint64_t rays : {1, 10, 255}) {
        const auto scene = scene_for(soup, rays);
        for (const Ray& ray : make_chords(100)) {
            ASSERT_TRUE(same_bits(scene->tracer().closest(ray), settled->tracer().closest(ray)));
            ASSERT_EQ(scene->tracer().any(ray), settled->tracer().any(ray));
            std::vector<Hit> hits;
            std::vector<Hit> expected;
            scene->tracer().all(ray, hits);
            settled->tracer().all(ray, expected);
            ASSERT_TRUE(std::equal(hits.begin(), hits.end(), expected.begin(), expected.end(), same_bits));
        }
        EXPECT_FALSE(are_areas_settled(*scene)) << rays;
        EXPECT_EQ(scene->tracer().primitives().degenerate_count(), 225u);
        EXPECT_TRUE(are_areas_settled(*scene));
    }
}

TEST(Scene, SettlesAreasForViewsAndRefits) {
    const Soup soup = with_some_degenerate();
    Progress progress;
    const auto scene = scene_for(soup, 1, std::nullopt);
    ASSERT_EQ(scene->plan().chosen, Structure::linear_scan);
    ASSERT_FALSE(are_areas_settled(*scene));
    ViewRequest request;
    request.frame.origin = Vec3(0, 0, 5);
    const auto view = Scene::seen(scene, request, Parallel(1), progress);
    EXPECT_TRUE(are_areas_settled(*view));

    const auto other = scene_for(soup, 1, std::nullopt);
    ASSERT_FALSE(are_areas_settled(*other));
    const auto moved =
        other->refitted({{soup.arrays(), true, false, ""}}, RefitPolicy::where_it_pays, Parallel(1), progress);
    EXPECT_EQ(moved->plan().chosen, Structure::linear_scan);
    EXPECT_EQ(moved->tracer().primitives().hittable_count(), 675u);
    // As many can be hit as before, so that what was chosen is kept.
    ASSERT_TRUE(moved->plan().refit.has_value());
    EXPECT_STRNE(moved->plan().refit->obstacle, "the number of triangles that can be hit has changed");
}

} // namespace
} // namespace raywise
