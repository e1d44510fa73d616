#include "accel/projected/projection.h"

#include "accel/bvh_testing.h"

#include <cmath>

namespace raywise {
namespace {

using namespace bvh_testing;

const SceneExtent unit_scene{{Vec3(-1.0), Vec3(1.0)}, 2.0, {}};

ExactRay exact(const Vec3& origin, const Vec3& direction, double tmin = 0.0, double tmax = infinity) {
    return ExactRay({origin, tmin, direction, tmax});
}

bool overlap(const ProjectedRay& ray, const Footprint& footprint) {
    return footprint.lower.x <= ray.upper.x && footprint.lower.y <= ray.upper.y && ray.lower.x <= footprint.upper.x &&
           ray.lower.y <= footprint.upper.y;
}

TEST(FloatRounding, OutwardsAndClose) {
    Random random(1);
    for (int i = 0; i < 100000; ++i) {
        const double x = std::ldexp(random.uniform(-1.0, 1.0), random.integer(-170, 127));
        const double above = static_cast<double>(float_above(x));
        const double below = static_cast<double>(float_below(x));
        ASSERT_LE(below, x);
        ASSERT_GE(above, x);
        ASSERT_LE(above - below, 0x1p-20 * std::fabs(x) + 0x1p-146);
    }
    const double most = std::numeric_limits<float>::max();
    EXPECT_EQ(float_above(infinity), infinity);
    EXPECT_EQ(float_above(-infinity), -infinity);
    EXPECT_EQ(float_below(infinity), infinity);
    EXPECT_EQ(float_below(-infinity), -infinity);
    EXPECT_EQ(float_above(2.0 * most), infinity);
    EXPECT_EQ(float_below(2.0 * most), most);
    EXPECT_EQ(float_above(-2.0 * most), -most);
    EXPECT_GE(float_above(most), most);
    EXPECT_LE(float_above(0.0), 1e-40f);
    // Monotone: what is rounded out on both sides still overlaps.
    for (int i = 0; i < 1000; ++i) {
        const double x = random.uniform(-1.0, 1.0);
        EXPECT_LE(float_below(x), float_above(std::nextafter(x, -2.0)));
    }
}

TEST(ViewPlanes, AsManyAsTheViewNeeds) {
    const Vec3 eye(0.5, 0.5, 3.0);
    EXPECT_EQ(ViewPlanes({ViewFrame::Kind::point, eye, Vec3(0.0), 0.0}, unit_scene).planes().size(), 6u);
    EXPECT_EQ(ViewPlanes({ViewFrame::Kind::point, eye, Vec3(0.0, 0.0, -1.0), 0.4}, unit_scene).planes().size(), 1u);
    EXPECT_EQ(ViewPlanes({ViewFrame::Kind::direction, eye, Vec3(1.0, 0.0, 0.0), 0.0}, unit_scene).planes().size(), 1u);
    EXPECT_EQ(ViewPlanes({ViewFrame::Kind::direction, eye, Vec3(0.0), 0.0}, unit_scene).planes().size(), 0u);
    EXPECT_EQ(ViewPlanes({ViewFrame::Kind::point, Vec3(infinity), Vec3(0.0), 0.0}, unit_scene).planes().size(), 0u);
    EXPECT_EQ(ViewPlanes({ViewFrame::Kind::point, eye, Vec3(0.0), 0.0}, SceneExtent{}).planes().size(), 0u);
}

TEST(ViewPlanes, ChoosesThePlaneTheRayPierces) {
    const Vec3 eye(0.1, 0.2, 0.3);
    const ViewPlanes view({ViewFrame::Kind::point, eye, Vec3(0.0), 0.0}, unit_scene);
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 d = random.direction();
        const ExactRay away = exact(eye, d);
        const int plane = view.choose(away);
        EXPECT_EQ(plane, 2 * away.major_axis + (d[away.major_axis] > 0.0 ? 0 : 1));
        EXPECT_EQ(view.choose(exact(eye + d, -d)), plane);
        for (int other = 0; other < 6; ++other) {
            ProjectedRay projected;
            const bool takes = view.planes()[static_cast<std::size_t>(other)].project(away, projected);
            if (other == plane) {
                EXPECT_TRUE(takes);
                EXPECT_LT(projected.upper.x - projected.lower.x, 1e-12);
            }
        }
    }
}

// Points of a triangle that a ray from the point looks at lie in the footprint, wherever the triangle is: in front,
// behind, across the view's plane, under the eye.
TEST(Footprint, HoldsWhatRaysFromThePointMeet) {
    Random random(3);
    for (int round = 0; round < 200; ++round) {
        const Vec3 eye = random.in_cube();
        const bool cube = round % 2 == 0;
        const ViewPlanes view(
            {ViewFrame::Kind::point, eye, cube ? Vec3(0.0) : random.direction(), random.uniform(0.1, 1.5)}, unit_scene);
        for (int i = 0; i < 100; ++i) {
            const double size = std::ldexp(1.0, -random.integer(0, 20));
            const Vec3 middle = random.in_cube(0.5);
            Corners corners;
            for (Vec3& corner : corners) corner = middle + random.in_cube(0.5 * size);
            if (i % 10 == 0) corners[0] = eye;
            if (i % 10 == 1) corners[0] = corners[1] + 1.5 * (eye - corners[1]);
            const double a = random.uniform(0.0, 1.0);
            const double b = random.uniform(0.0, 1.0 - a);
            const Vec3 p = corners[0] + a * (corners[1] - corners[0]) + b * (corners[2] - corners[0]);
            if (p == eye) continue;
            const ExactRay ray = exact(eye, p - eye);
            const int choice = view.choose(ray);
            ASSERT_GE(choice, 0);
            const ProjectionPlane& plane = view.planes()[static_cast<std::size_t>(choice)];
            ProjectedRay projected;
            if (!plane.project(ray, projected)) {
                EXPECT_FALSE(cube);
                continue;
            }
            const Footprint footprint = plane.footprint(corners);
            ASSERT_FALSE(footprint.empty());
            // p is rounded: allow for it relative to its distance.
            const Vec3 distance = p - eye;
            const double slack = 1e-15 / std::sqrt(glm::dot(distance, distance));
            projected.lower -= Vec2(slack);
            projected.upper += Vec2(slack);
            EXPECT_TRUE(overlap(projected, footprint)) << round << " " << i;
            const double depth = projected.depth + ray.scale.from_caller(1.0) * projected.depth_rate;
            EXPECT_LE(footprint.near, depth + projected.depth_error);
            EXPECT_GE(footprint.far, depth - projected.depth_error);
        }
    }
}

TEST(Footprint, IsTheTrianglesOwnNotItsBoxs) {
    // Seen from the diagonal; the box's projection would be a hexagon three times as wide as this sliver.
    const ViewPlanes view({ViewFrame::Kind::point, Vec3(3.0), Vec3(-1.0), 0.5}, unit_scene);
    const Footprint footprint = view.planes()[0].footprint({Vec3(-1.0), Vec3(1.0), Vec3(1.0, 1.0, 0.99)});
    EXPECT_LT(footprint.upper.x - footprint.lower.x, 0.01);
    EXPECT_LT(footprint.upper.y - footprint.lower.y, 0.01);
    EXPECT_NEAR(footprint.near, 2.0 * std::sqrt(3.0), 0.02);
    EXPECT_NEAR(footprint.far, 4.0 * std::sqrt(3.0), 0.02);
}

TEST(Footprint, TrianglesBehindOrBesideThePyramidAreLeftOut) {
    const ViewPlanes view({ViewFrame::Kind::point, Vec3(0.0), Vec3(0.0), 0.0}, unit_scene);
    const auto planes_of = [&](const Corners& corners) {
        std::string planes;
        for (const ProjectionPlane& plane : view.planes()) planes += plane.footprint(corners).empty() ? '-' : 'x';
        return planes;
    };
    EXPECT_EQ(planes_of({Vec3(0.9, 0.0, 0.0), Vec3(0.9, 0.1, 0.0), Vec3(0.9, 0.0, 0.1)}), "x-----");
    EXPECT_EQ(planes_of({Vec3(0.0, -0.9, 0.0), Vec3(0.1, -0.9, 0.0), Vec3(0.0, -0.9, 0.1)}), "---x--");
    // Across the plane x = 0, but nowhere near the pyramids along x.
    EXPECT_EQ(planes_of({Vec3(-0.1, 0.9, 0.0), Vec3(0.1, 0.9, 0.0), Vec3(0.0, 0.9, 0.1)}), "--x---");
    EXPECT_EQ(planes_of({Vec3(0.9, 0.9, 0.0), Vec3(0.9, 0.8, 0.0), Vec3(0.8, 0.9, 0.1)}), "x-x---");
    // Around the point: everywhere.
    EXPECT_EQ(planes_of({Vec3(-0.9, 0.0, 0.0), Vec3(0.9, 0.5, 0.0), Vec3(0.9, -0.5, 0.0)}), "xxxxxx");
}

TEST(Footprint, AFloorUnderThePointHasAHorizon) {
    const ViewPlanes view({ViewFrame::Kind::point, Vec3(0.0), Vec3(0.0), 0.0}, unit_scene);
    const Corners floor = {Vec3(-1.0, -0.5, -1.0), Vec3(1.0, -0.5, -1.0), Vec3(0.0, -0.5, 1.0)};
    // Through the plane +x the floor ends below the horizon and begins where the pyramid meets it.
    const Footprint footprint = view.planes()[0].footprint(floor);
    ASSERT_FALSE(footprint.empty());
    EXPECT_GE(footprint.near, 0.4);
    int finite = 0;
    for (int i = 0; i < 2; ++i)
        finite += (std::isfinite(footprint.lower[i]) ? 1 : 0) + (std::isfinite(footprint.upper[i]) ? 1 : 0);
    EXPECT_EQ(finite, 1);
}

TEST(Footprint, AlongADirection) {
    Random random(4);
    for (int round = 0; round < 200; ++round) {
        const Vec3 direction = std::ldexp(1.0, random.integer(-60, 60)) * random.direction();
        const ViewPlanes view({ViewFrame::Kind::direction, Vec3(0.0), direction, 0.0}, unit_scene);
        for (int i = 0; i < 50; ++i) {
            const Corners corners = {random.in_cube(), random.in_cube(), random.in_cube()};
            const double a = random.uniform(0.0, 1.0);
            const double b = random.uniform(0.0, 1.0 - a);
            const Vec3 p = corners[0] + a * (corners[1] - corners[0]) + b * (corners[2] - corners[0]);
            const ExactRay ray = exact(p, i % 2 == 0 ? direction : -direction);
            ProjectedRay projected;
            ASSERT_EQ(view.choose(ray), 0);
            ASSERT_TRUE(view.planes()[0].project(ray, projected));
            const Footprint footprint = view.planes()[0].footprint(corners);
            EXPECT_TRUE(overlap(projected, footprint));
            EXPECT_LT(projected.upper.x - projected.lower.x, 1e-10);
            EXPECT_LE(footprint.near, projected.depth + projected.depth_error);
            EXPECT_GE(footprint.far, projected.depth - projected.depth_error);
            EXPECT_EQ(projected.depth_rate > 0.0, i % 2 == 0);
        }
    }
}

// A ray that aims at the point with rounding, from float32 numbers: its points beyond the cut project into its
// rectangle.
TEST(ProjectedRay, HoldsTheRayBeyondTheCut) {
    Random random(5);
    int taken = 0;
    for (int i = 0; i < 5000; ++i) {
        const Vec3 light = through_float(3.0 * random.in_cube());
        const ViewPlanes view({ViewFrame::Kind::point, light, Vec3(0.0), 0.0}, unit_scene);
        const Vec3 p = through_float(random.in_cube());
        const Vec3 d = through_float(light - p);
        const ExactRay ray = exact(p, d, 0.0, 1.0);
        const ProjectionPlane& plane = view.planes()[static_cast<std::size_t>(view.choose(ray))];
        ProjectedRay projected;
        if (!plane.project(ray, projected)) continue;
        ++taken;
        for (int k = 0; k < 20; ++k) {
            const double t = random.uniform(0.0, 1.0);
            const double depth = projected.depth + ray.scale.from_caller(t) * projected.depth_rate;
            if (depth < projected.cut || depth < 1e-3) continue;
            // The footprint of the point itself.
            const Vec3 q = p + t * d;
            const Footprint footprint = plane.footprint({q, q, q});
            ASSERT_FALSE(footprint.empty());
            EXPECT_TRUE(overlap(projected, footprint));
        }
    }
    EXPECT_GT(taken, 4900);
}

TEST(ProjectedRay, OnlyRaysOfTheView) {
    const Vec3 eye(0.0, 0.0, 4.0);
    const ViewPlanes view({ViewFrame::Kind::point, eye, Vec3(0.0, 0.0, -1.0), 0.5}, unit_scene);
    const auto takes = [&](const ExactRay& ray) {
        ProjectedRay projected;
        return view.planes()[0].project(ray, projected);
    };
    const Vec3 ahead(0.1, 0.1, -1.0);
    EXPECT_TRUE(takes(exact(eye, ahead)));
    EXPECT_TRUE(takes(exact(eye, ahead, 0.5, 7.0)));
    EXPECT_TRUE(takes(exact(eye + 5.0 * ahead, -ahead, 0.0, 5.0)));
    EXPECT_FALSE(takes(exact(eye, -ahead)));               // away
    EXPECT_FALSE(takes(exact(eye, Vec3(1.0, 0.0, -1.0)))); // past the plane
    EXPECT_FALSE(takes(exact(eye, Vec3(1.0, 0.0, 0.0))));  // along it
    EXPECT_FALSE(takes(exact(eye, ahead, -1.0)));          // from behind the eye
    EXPECT_FALSE(takes(exact(eye, ahead, -infinity)));
    EXPECT_FALSE(takes(exact(eye + 5.0 * ahead, -ahead)));         // beyond the eye
    EXPECT_FALSE(takes(exact(eye + Vec3(0.01, 0.0, 0.0), ahead))); // beside it
    const ViewPlanes sun({ViewFrame::Kind::direction, Vec3(0.0), Vec3(0.0, 0.0, -1.0), 0.0}, unit_scene);
    ProjectedRay projected;
    EXPECT_TRUE(sun.planes()[0].project(exact(eye, Vec3(0.0, 0.0, 1.0), -infinity), projected));
    EXPECT_TRUE(sun.planes()[0].project(exact(eye, Vec3(1e-9, 0.0, 1.0)), projected));
    EXPECT_FALSE(sun.planes()[0].project(exact(eye, Vec3(0.1, 0.0, 1.0)), projected));
    EXPECT_FALSE(sun.planes()[0].project(exact(Vec3(1e300), Vec3(0.0, 0.0, 1.0)), projected));
}

} // namespace
} // namespace raywise
