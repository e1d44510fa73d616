// Rays in float32: what they cull must not hold a hit, and how much they visit must not depend on what lies far off.
#include "ray/traversal_ray.h"

#include "random.h"
#include "ray/set_ups.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace raywise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The slab test as traversals make it, on a box in the scene's coordinates.
bool meets(const TraversalRay& ray, const SceneFrame& frame, const Vec3& lower, const Vec3& upper) {
    const double slack = 0x1p-26 * max_component(upper - lower) * frame.scale() + 0x1p-112;
    float entry = ray.first;
    float exit = ray.last;
    for (int axis = 0; axis < 3; ++axis) {
        const float planes[2] = {round_down(frame.to_frame(lower)[axis] - slack),
                                 round_up(frame.to_frame(upper)[axis] + slack)};
        const std::size_t backwards = ray.octant >> axis & 1u;
        entry = std::fmax(entry, planes[backwards] * ray.inverse[axis] - ray.entry_offset[axis]);
        exit = std::fmin(exit, planes[1 - backwards] * ray.inverse[axis] - ray.exit_offset[axis]);
    }
    return entry <= exit + TraversalRay::box_slack * std::fabs(exit);
}

struct Traced {
    TraversalRay ray;
    RayTime time;
    RaySetup status;

    Traced(const Ray& asked, const SceneFrame& frame) { status = set_up_rare_ray(asked, frame, ray, time); }
};

TEST(TraversalRay, MeetsTheBoxOfEveryHit) {
    Random random(5);
    const Vec3 centers[] = {Vec3(0.0), Vec3(5e5, 5.1e6, 100.0)};
    for (const Vec3& center : centers) {
        for (const double far : {1.0, 1e5, 1e30}) {
            const SceneFrame frame(center, 1.0, {center - Vec3(far), center + Vec3(far)});
            for (int i = 0; i < 4000; ++i) {
                const Vec3 target = center + (i % 8 == 0 ? far : 1.0) * random.point();
                const double away = i % 5 == 0 ? 1e9 : i % 5 == 1 ? 100.0 : 3.0;
                Vec3 direction = random.point();
                if (i % 7 == 0) direction[i % 3] = 0.0;
                if (i % 11 == 0) direction[i % 3] = 1e-18;
                const double t = away * (1.0 + random.number());
                // An origin from which the line passes the target exactly enough: within rounding of the origin's coordinates.
                const Ray ray{target - t * direction, -infinity, direction, infinity};
                const double passes =
                    0x1p-51 * (max_component(magnitudes(ray.origin)) + max_component(magnitudes(target)));
                const Traced setup(ray, frame);
                ASSERT_EQ(setup.status, RaySetup::ready);
                EXPECT_TRUE(meets(setup.ray, frame, target - Vec3(passes), target + Vec3(passes)))
                    << "center " << center.x << ", far " << far << ", ray " << i;
                EXPECT_GE(setup.time.last(t), setup.time.first(t));
            }
        }
    }
}

// Directions of any length, whose components are of very different sizes: their inverses need not be numbers of float32.
TEST(TraversalRay, MeetsTheBoxOfEveryHitWhateverTheDirectionsLength) {
    Random random(6);
    const SceneFrame frame(Vec3(0.0), 1.0, {Vec3(-1.0), Vec3(1.0)});
    for (int length = -160; length <= 160; ++length) {
        for (int i = 0; i < 400; ++i) {
            // Near the center on some axes, where the slack that is relative to the start is small.
            Vec3f target;
            for (int axis = 0; axis < 3; ++axis)
                target[axis] =
                    static_cast<float>(std::ldexp(random.number(), -static_cast<int>(random.integer() % 80)));
            const auto long_axis = static_cast<glm::length_t>(random.integer() % 3);
            Vec3f direction(0.0f);
            for (int axis = 0; axis < 3; ++axis) {
                const int less = axis == long_axis ? 0 : static_cast<int>(random.integer() % 80);
                direction[axis] = static_cast<float>(std::ldexp(random.number(), length - less));
            }
            if (direction[long_axis] == 0.0f || !is_finite(direction)) continue;
            // On a line through the target, but for what rounding of the origin passes it by.
            const double t = 4.0 / std::fabs(static_cast<double>(direction[long_axis]));
            const RayF ray{Vec3f(Vec3(target) - t * Vec3(direction)), 0.0f, direction,
                           std::numeric_limits<float>::infinity()};
            if (max_component(magnitudes(Vec3(ray.origin))) > 1e3) continue;
            const Vec3 reached = Vec3(ray.origin) + t * Vec3(direction);
            const Vec3 passes = 0x1p-50 * (magnitudes(Vec3(ray.origin)) + magnitudes(reached));
            for (const bool narrow : {false, true}) {
                TraversalRay traversal;
                RayTime time;
                const RaySetup status = narrow ? set_up_in_vectors(ray, frame, traversal, time)
                                               : set_up_in_vectors(widened(ray), frame, traversal, time);
                ASSERT_EQ(status, RaySetup::ready);
                EXPECT_TRUE(meets(traversal, frame, reached - passes, reached + passes))
                    << "length 2^" << length << ", ray " << i << ", float32 " << narrow;
            }
        }
    }
}

// Small boxes beside the line are left out: from near, from 1e11 times the scene's size, and where one triangle lies 1e30 away.
TEST(TraversalRay, MeetsNoMoreFromFarAwayOrBecauseOfIt) {
    for (const double far : {1.0, 1e5, 1e30}) {
        const SceneFrame frame(Vec3(0.0), 1.0, {Vec3(-far), Vec3(far)});
        Random near_random(5);
        Random far_random(5);
        int near_boxes = 0;
        int far_boxes = 0;
        const auto count = [&](double away, Random& random) {
            int boxes = 0;
            for (int i = 0; i < 2000; ++i) {
                const Vec3 target = random.point();
                const Vec3 direction = random.point();
                const Traced setup({target - away * direction, 0.0, direction, infinity}, frame);
                const Vec3 middle = target + 0.05 * random.point();
                boxes += meets(setup.ray, frame, middle - Vec3(0.01), middle + Vec3(0.01)) ? 1 : 0;
            }
            return boxes;
        };
        near_boxes = count(3.0, near_random);
        far_boxes = count(1e11, far_random);
        EXPECT_LT(near_boxes, 500) << far;
        EXPECT_LE(far_boxes, near_boxes + near_boxes / 10 + 5) << far;
    }
}

TEST(TraversalRay, MissesTheSceneFromFarAway) {
    const SceneFrame frame(Vec3(0.0), 1.0, {Vec3(-1.0), Vec3(1.0)});
    EXPECT_EQ((Traced(Ray{{1e6, 0, 5}, 0.0, {-1, 0, 0}, infinity}, frame).status), RaySetup::misses);
    EXPECT_EQ((Traced(Ray{{1e6, 0, 0.5}, 0.0, {-1, 0, 0}, infinity}, frame).status), RaySetup::ready);
}

TEST(TraversalRay, TellsWhatCannotBeTraced) {
    const SceneFrame frame(Vec3(0.0), 1.0, {Vec3(-1.0), Vec3(1.0)});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Ray& ray : {Ray{{nan, 0, 0}, 0.0, {0, 0, 1}, infinity}, Ray{{0, 0, 0}, 0.0, {0, 0, 0}, infinity},
                           Ray{{0, 0, 0}, 2.0, {0, 0, 1}, 1.0}, Ray{{0, 0, infinity}, 0.0, {0, 0, 1}, 1.0}})
        EXPECT_EQ(Traced(ray, frame).status, RaySetup::untraceable);
}

} // namespace
} // namespace raywise
