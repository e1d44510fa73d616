#include "scene/sample_rays.h"

#include "scene/testing.h"

#include "ray/cell_ray.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace raywise {
namespace {

bool meets(const Ray& ray, const Box& box) {
    const CellRay cell_ray(ExactRay(ray), box, max_component(box.size()));
    double near = cell_ray.first;
    double far = cell_ray.last;
    for (int axis = 0; axis < 3; ++axis) {
        const Interval slab = cell_ray.slab(axis, box.lower[axis], box.upper[axis]);
        near = std::max(near, slab.near);
        far = std::min(far, slab.far);
    }
    return near <= far;
}

using namespace testing;

TEST(SampleRays, AreTraceableRepeatableAndMeetTheScene) {
    const Soup soup = make_soup(5000);
    const auto mesh = std::make_shared<const TriangleMesh>(soup.arrays(), true, false);
    const Primitives primitives({mesh});
    const ViewFrame sun{ViewFrame::Kind::direction, {0, 0, 0}, {1, 1, 1}, 0.0};
    const ViewFrame eye{ViewFrame::Kind::point, {4, 4, 4}, {-1, -1, -1}, 0.5};
    for (const std::optional<ViewFrame>& view : {std::optional<ViewFrame>{}, std::optional(sun), std::optional(eye)}) {
        for (const RayKind kind : {RayKind::any, RayKind::random, RayKind::camera, RayKind::shadow, RayKind::diffuse}) {
            const std::vector<Ray> rays = make_sample_rays(primitives, kind, view);
            const std::vector<Ray> again = make_sample_rays(primitives, kind, view);
            ASSERT_EQ(rays.size(), sample_limit);
            int meets_bounds = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                ASSERT_TRUE(rays[i].is_traceable());
                EXPECT_EQ(rays[i].origin, again[i].origin);
                EXPECT_EQ(rays[i].direction, again[i].direction);
                meets_bounds += meets(rays[i], primitives.bounds()) ? 1 : 0;
            }
            EXPECT_GT(meets_bounds, 500);
        }
    }
}

TEST(SampleRays, OfAnEmptySceneAreNone) {
    EXPECT_TRUE(make_sample_rays(Primitives({}), RayKind::diffuse, std::nullopt).empty());
}

} // namespace
} // namespace raywise
