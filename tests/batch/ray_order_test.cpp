#include "batch/ray_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace raywise {
namespace {

const Box unit_box{Vec3(-1.0), Vec3(1.0)};

std::vector<Ray> random_rays(std::size_t count, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto vector = [&] { return Vec3(uniform(engine), uniform(engine), uniform(engine)); };
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        ray.origin = 2.0 * vector();
        ray.direction = vector();
    }
    return rays;
}

const std::vector<std::uint32_t>& sort(RayOrder& order, const std::vector<Ray>& rays) {
    return order.sort(rays.data(), rays.size());
}

void expect_permutation(std::vector<std::uint32_t> order, std::size_t count) {
    std::sort(order.begin(), order.end());
    ASSERT_EQ(order.size(), count);
    for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(order[i], i);
}

TEST(RayOrder, EveryRayOnce) {
    RayOrder order(unit_box);
    for (const std::size_t count : {0u, 1u, 2u, 100u, 5000u, 3u})
        expect_permutation(sort(order, random_rays(count, 1)), count);
}

TEST(RayOrder, RaysOfAnOctantFollowEachOther) {
    RayOrder order(unit_box);
    const std::vector<Ray> rays = random_rays(5000, 2);
    const auto octant = [&](std::uint32_t i) {
        const Vec3& d = rays[i].direction;
        return (d.x < 0.0 ? 1 : 0) + (d.y < 0.0 ? 2 : 0) + (d.z < 0.0 ? 4 : 0);
    };
    const std::vector<std::uint32_t>& sorted = sort(order, rays);
    int changes = 0;
    for (std::size_t i = 1; i < sorted.size(); ++i) changes += octant(sorted[i]) != octant(sorted[i - 1]) ? 1 : 0;
    EXPECT_EQ(changes, 7);
}

TEST(RayOrder, NeighboursStartNearEachOther) {
    RayOrder order(unit_box);
    std::vector<Ray> rays = random_rays(20000, 3);
    for (Ray& ray : rays) ray.origin *= 0.5;
    const auto mean_distance = [&](const auto& number_of) {
        double sum = 0.0;
        for (std::size_t i = 1; i < rays.size(); ++i)
            sum += glm::length(rays[number_of(i)].origin - rays[number_of(i - 1)].origin);
        return sum / static_cast<double>(rays.size() - 1);
    };
    const std::vector<std::uint32_t> sorted = sort(order, rays);
    EXPECT_LT(mean_distance([&](std::size_t i) { return sorted[i]; }),
              0.3 * mean_distance([](std::size_t i) { return i; }));
}

TEST(RayOrder, RaysOfACameraStayInTheirOrder) {
    RayOrder order(unit_box);
    std::vector<Ray> rays;
    for (int y = 0; y < 100; ++y) {
        for (int x = 0; x < 400; ++x) {
            Ray ray;
            ray.origin = Vec3(0.0, 0.0, -5.0);
            ray.direction = Vec3(0.001 * x - 0.2, 0.001 * y - 0.05, 1.0);
            rays.push_back(ray);
        }
    }
    const std::vector<std::uint32_t>& sorted = sort(order, rays);
    EXPECT_TRUE(std::is_sorted(sorted.begin(), sorted.end()));
}

TEST(RayOrder, AnyNumbersWillDo) {
    const double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double values[] = {0.0, -0.0, 1.0, -1.0, 1e-320, 1e308, -1e308, infinity, -infinity, nan};
    std::mt19937 engine(4);
    std::uniform_int_distribution<std::size_t> pick(0, std::size(values) - 1);
    std::vector<Ray> rays(4000);
    for (Ray& ray : rays) {
        for (int axis = 0; axis < 3; ++axis) {
            ray.origin[axis] = values[pick(engine)];
            ray.direction[axis] = values[pick(engine)];
        }
        ray.tmin = values[pick(engine)];
        ray.tmax = values[pick(engine)];
    }
    const Box boxes[] = {
        unit_box, Box{}, {Vec3(0.0), Vec3(0.0)}, {Vec3(-1e308), Vec3(1e308)}, {Vec3(0.0), Vec3(1e-320)}};
    for (const Box& box : boxes) {
        RayOrder order(box);
        expect_permutation(sort(order, rays), rays.size());
    }
}

} // namespace
} // namespace raywise
