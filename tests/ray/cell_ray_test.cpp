// What a ray in float64 is known to by structures that divide space: where it starts, and what its distances may be off by.
#include "ray/cell_ray.h"

#include "random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace raywise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

CellRay cell_ray(const Ray& ray, const Box& box, double largest_extent) {
    return CellRay(ExactRay(ray), box, largest_extent);
}

bool meets(const CellRay& ray, const Box& box) {
    double near = ray.first;
    double far = ray.last;
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0.0) {
            if (ray.start[axis] < box.lower[axis] || ray.start[axis] > box.upper[axis]) return false;
            continue;
        }
        const Interval slab = ray.slab(axis, box.lower[axis], box.upper[axis]);
        near = larger(near, slab.near);
        far = smaller(far, slab.far);
    }
    return near <= far;
}

TEST(CellRay, MeetsEveryBoxThatItsLinePassesThrough) {
    Random random(2);
    for (int i = 0; i < 20000; ++i) {
        const double scale = std::ldexp(1.0, static_cast<int>(random.integer() % 80) - 40);
        Box box;
        for (int p = 0; p < 2; ++p)
            box.extend(scale * Vec3(random.number(), random.number(), i % 3 == 0 ? 0.0 : random.number()));
        const Vec3 inside = box.lower + 0.5 * box.size();
        const double away = i % 7 == 0 ? 1e11 : i % 7 == 1 ? 1e3 : 4.0;
        Vec3 origin = away * scale * random.point();
        if (i % 5 == 0) origin[i % 3] = inside[i % 3];
        if (origin == inside) continue;
        const Ray ray{origin, -infinity, inside - origin, infinity};
        // The direction is rounded, and so the line passes the point by some units in the last place of the origin.
        const double passes = 0x1p-51 * max_component(magnitudes(origin));
        const Box wider{box.lower - Vec3(passes), box.upper + Vec3(passes)};
        EXPECT_TRUE(meets(cell_ray(ray, box, max_component(box.size())), wider)) << i;
    }
}

TEST(CellRay, LeavesOutWhatIsFarOff) {
    const Box box{{0, 0, 0}, {1, 1, 1}};
    const auto hits = [&](const Ray& ray) { return meets(cell_ray(ray, box, 1.0), box); };
    EXPECT_FALSE(hits({{2, 2, 2}, 0.0, {1, 0, 0}, infinity}));
    EXPECT_FALSE(hits({{-2, 0.5, 0.5}, 0.0, {-1, 0, 0}, infinity})) << "behind the origin";
    EXPECT_FALSE(hits({{-2, 0.5, 0.5}, 0.0, {1, 0, 0}, 1.5})) << "beyond tmax";
    for (const double zero : {0.0, -0.0}) {
        EXPECT_FALSE(hits({{-2, 1.5, 0.5}, 0.0, {1, zero, zero}, infinity})) << "along an axis, beside the box";
        EXPECT_FALSE(hits({{0.5, 0.5, 7}, 0.0, {1, zero, zero}, infinity}));
        EXPECT_TRUE(hits({{-2, 1.0, 0.5}, 0.0, {1, zero, zero}, infinity})) << "in the plane of a face";
        EXPECT_TRUE(hits({{-2, 0.0, 0.0}, 0.0, {1, zero, zero}, infinity})) << "along an edge";
        EXPECT_TRUE(hits({{0.5, 0.5, 0.5}, 0.0, {zero, zero, 1}, infinity})) << "from within";
    }
}

// From 1e11 times the size of the scene: the start lies within it, and what is known of the line is as good as near by.
TEST(CellRay, FromFarAwayStartsNearTheScene) {
    Random random(2);
    const Box box{Vec3(-1.0), Vec3(1.0)};
    for (int i = 0; i < 1000; ++i) {
        const Vec3 target = 0.5 * random.point();
        const Vec3 origin = 1.5e11 * random.point() + Vec3(1e10);
        const CellRay ray = cell_ray({origin, 0.0, target - origin, infinity}, box, 0.01);
        EXPECT_LE(max_component(magnitudes(ray.start)), 2.0);
        EXPECT_LT(ray.margin(1.0), 1e-2) << "a distance of 1.5e11 is told to 3e-5 at best";
        // t = 1 of the caller's is the target.
        EXPECT_GE(ray.upper_end(1.0),
                  glm::dot(target - ray.start, ray.direction) / glm::dot(ray.direction, ray.direction));
        EXPECT_LE(ray.lower_end(1.0),
                  glm::dot(target - ray.start, ray.direction) / glm::dot(ray.direction, ray.direction));
    }
}

// The slack does not grow with the scene.
TEST(CellRay, KnowsNothingOfTheFarEndOfTheScene) {
    const Ray ray{{0, 0, 3}, 0.0, {0.1, 0.2, -1}, infinity};
    const CellRay small = cell_ray(ray, {Vec3(-1.0), Vec3(1.0)}, 0.01);
    const CellRay large = cell_ray(ray, {Vec3(-1e30), Vec3(1e30)}, 0.01);
    EXPECT_EQ(small.margin(3.0), large.margin(3.0));
}

} // namespace
} // namespace raywise
