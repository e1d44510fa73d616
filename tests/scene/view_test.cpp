// Views: scenes of the geometry of another one.
#include "scene/scene.h"
#include "scene/testing.h"

#include <gtest/gtest.h>

namespace raywise {
namespace {

using namespace testing;

std::shared_ptr<const Profile> generic() { return std::make_shared<const Profile>(generic_profile()); }

std::vector<ViewFrame> frames() {
    return {{ViewFrame::Kind::point, {3, 1, 2}, {-3, -1, -2}, 0.6},
            {ViewFrame::Kind::point, {3, 1, 2}, {0, 0, 0}, 0.0},
            {ViewFrame::Kind::point, {0, 0, 0}, {0, 0, 0}, 0.0},
            {ViewFrame::Kind::direction, {0, 0, 0}, {1, 2, -3}, 0.0}};
}

std::vector<Ray> rays_of(const ViewFrame& frame) {
    std::vector<Ray> rays = make_chords(300);
    for (Ray& ray : rays) {
        if (frame.kind == ViewFrame::Kind::direction) {
            ray.direction = frame.direction;
        } else {
            ray.origin = frame.origin;
        }
    }
    return rays;
}

TEST(View, AnswersAsTheSceneWithTheSameBits) {
    const auto scene =
        make_scene(make_soup(2000), generic(), [](Scene& s) { s.set_structure(Structure::linear_scan); });
    for (const ViewFrame& frame : frames()) {
        for (const Structure structure : all_structures()) {
            Progress progress;
            const auto view = Scene::seen(scene, {frame, {1000, RayKind::camera}, structure}, Parallel(1), progress);
            EXPECT_EQ(view->plan().chosen, structure);
            std::vector<Ray> rays = rays_of(frame);
            const std::vector<Ray> others = make_chords(100, 9); // rays that have nothing to do with the view
            rays.insert(rays.end(), others.begin(), others.end());
            for (const Ray& ray : rays) {
                ASSERT_TRUE(same_bits(view->tracer().closest(ray), scene->tracer().closest(ray))) << name_of(structure);
                ASSERT_EQ(view->tracer().any(ray), scene->tracer().any(ray)) << name_of(structure);
            }
        }
    }
}

TEST(View, UsesTheScenesStructureForFewRays) {
    const auto scene = make_scene(make_soup(2000), generic(), [](Scene& s) { s.set_structure(Structure::bvh); });
    Progress progress;
    const auto view = Scene::seen(scene, {frames()[0], {1, RayKind::camera}, std::nullopt}, Parallel(1), progress);
    EXPECT_EQ(view->plan().chosen, Structure::bvh);
    EXPECT_EQ(&view->tracer().accel(), &scene->tracer().accel());
    EXPECT_EQ(view->plan().build_ns, 0.0);
}

TEST(View, KeepsToTheScenesMemoryLimit) {
    const auto scene = make_scene(make_soup(2000), generic(), [](Scene& s) {
        s.set_structure(Structure::linear_scan);
        s.set_memory_limit(4000);
    });
    Progress progress;
    EXPECT_THROW(
        Scene::seen(scene, {frames()[0], {1000, RayKind::camera}, Structure::projected_bvh}, Parallel(1), progress),
        Error);
    const auto view =
        Scene::seen(scene, {frames()[0], {1'000'000'000, RayKind::camera}, std::nullopt}, Parallel(1), progress);
    EXPECT_EQ(view->plan().chosen, Structure::linear_scan);
}

TEST(View, OfAViewIsOneOfTheSceneBehindIt) {
    const auto scene = make_scene(make_soup(2000), generic(), [](Scene& s) { s.set_structure(Structure::bvh); });
    Progress progress;
    const auto projected =
        Scene::seen(scene, {frames()[0], {1000, RayKind::camera}, Structure::projected_bvh}, Parallel(1), progress);
    // The structure that costs nothing is the scene's, not the projected one of the view in between.
    const auto second =
        Scene::seen(projected, {frames()[3], {1, RayKind::shadow}, std::nullopt}, Parallel(1), progress);
    EXPECT_EQ(&second->tracer().accel(), &scene->tracer().accel());
    const auto third =
        Scene::seen(projected, {frames()[3], {1, RayKind::shadow}, Structure::projected_bvh}, Parallel(1), progress);
    for (const Ray& ray : rays_of(frames()[3])) {
        ASSERT_TRUE(same_bits(second->tracer().closest(ray), scene->tracer().closest(ray)));
        ASSERT_TRUE(same_bits(third->tracer().closest(ray), scene->tracer().closest(ray)));
    }
}

TEST(View, OutlivesItsSceneAndCannotBeFilled) {
    auto scene = make_scene(make_soup(500), generic(), {});
    Progress progress;
    const auto view =
        Scene::seen(scene, {frames()[1], {1000, RayKind::camera}, Structure::projected_bvh}, Parallel(1), progress);
    const std::vector<Ray> rays = rays_of(frames()[1]);
    std::vector<Hit> expected;
    for (const Ray& ray : rays) expected.push_back(scene->tracer().closest(ray));
    scene.reset();
    for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_TRUE(same_bits(view->tracer().closest(rays[i]), expected[i]));
    const Soup more = make_soup(3);
    EXPECT_THROW(view->add_triangles(more.arrays(), true, false), Error);
    EXPECT_THROW(view->commit(Parallel(1), progress), Error);
}

TEST(View, RefittedIsTheSameViewOfTheRefittedScene) {
    const Soup before = make_soup(1500, 3);
    const Soup after = make_soup(1500, 4);
    const auto scene = make_scene(before, generic(), [](Scene& s) { s.set_structure(Structure::bvh); });
    const auto moved = make_scene(after, generic(), [](Scene& s) { s.set_structure(Structure::linear_scan); });
    const std::vector<MovedMesh> meshes = {{after.arrays(), true, false, "meshes[0]."}};
    Progress progress;
    for (const Structure structure : {Structure::projected_bvh, Structure::bvh}) {
        const auto view = Scene::seen(scene, {frames()[0], {1000, RayKind::camera}, structure}, Parallel(1), progress);
        const auto refitted = view->refitted(meshes, RefitPolicy::where_it_pays, Parallel(1), progress);
        EXPECT_EQ(refitted->plan().chosen, structure);
        for (const Ray& ray : rays_of(frames()[0]))
            ASSERT_TRUE(same_bits(refitted->tracer().closest(ray), moved->tracer().closest(ray)));
        // And again, since it is a view as the first one was.
        const auto again = refitted->refitted(meshes, RefitPolicy::where_it_pays, Parallel(1), progress);
        EXPECT_EQ(again->plan().chosen, structure);
    }
}

} // namespace
} // namespace raywise
