#include "scene/view.h"

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
            const View view(scene, {frame, {1000, RayKind::camera}, structure}, Parallel(1), progress);
            EXPECT_EQ(view.plan().chosen, structure);
            std::vector<Ray> rays = rays_of(frame);
            const std::vector<Ray> others = make_chords(100, 9); // rays that have nothing to do with the view
            rays.insert(rays.end(), others.begin(), others.end());
            for (const Ray& ray : rays) {
                ASSERT_TRUE(same_bits(view.tracer().closest(ray), scene->tracer().closest(ray))) << name_of(structure);
                ASSERT_EQ(view.tracer().any(ray), scene->tracer().any(ray)) << name_of(structure);
            }
        }
    }
}

TEST(View, UsesTheScenesStructureForFewRays) {
    const auto scene = make_scene(make_soup(2000), generic(), [](Scene& s) { s.set_structure(Structure::bvh); });
    Progress progress;
    const View view(scene, {frames()[0], {1, RayKind::camera}, std::nullopt}, Parallel(1), progress);
    EXPECT_EQ(view.plan().chosen, Structure::bvh);
    EXPECT_EQ(&view.tracer().accel(), &scene->tracer().accel());
    EXPECT_EQ(view.plan().build_ns, 0.0);
}

TEST(View, KeepsToTheScenesMemoryLimit) {
    const auto scene = make_scene(make_soup(2000), generic(), [](Scene& s) {
        s.set_structure(Structure::linear_scan);
        s.set_memory_limit(4000);
    });
    Progress progress;
    EXPECT_THROW(View(scene, {frames()[0], {1000, RayKind::camera}, Structure::projected_bvh}, Parallel(1), progress),
                 Error);
    const View view(scene, {frames()[0], {1'000'000'000, RayKind::camera}, std::nullopt}, Parallel(1), progress);
    EXPECT_EQ(view.plan().chosen, Structure::linear_scan);
}

} // namespace
} // namespace raywise
