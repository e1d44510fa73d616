#include "batch/ray_key.h"

#include "../geometry/every_target.h"
#include "rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace raywise {
namespace {

using namespace testing;

template <class AnyRay>
std::vector<std::uint32_t> keys_of(const RayKeys& keys, const std::vector<AnyRay>& rays) {
    std::vector<std::uint32_t> result;
    for (std::size_t begin = 0; begin < rays.size(); begin += RayKeys::most) {
        const std::size_t n = std::min(RayKeys::most, rays.size() - begin);
        AnyRay block[RayKeys::most];
        std::uint32_t of_block[RayKeys::most];
        std::copy_n(rays.begin() + static_cast<std::ptrdiff_t>(begin), n, block);
        keys.of(block, n, of_block);
        result.insert(result.end(), of_block, of_block + n);
    }
    return result;
}

int octant(const Ray& ray) {
    const Vec3& d = ray.direction;
    return (d.x < 0.0 ? 1 : 0) + (d.y < 0.0 ? 2 : 0) + (d.z < 0.0 ? 4 : 0);
}

TEST(RayKeys, HaveTheOctantOnTop) {
    on_every_target([] {
        const std::vector<Ray> rays = random_rays(1000, 2);
        const std::vector<std::uint32_t> keys = keys_of(RayKeys(unit_box), rays);
        const std::vector<std::uint32_t> keys_f32 = keys_of(RayKeys(unit_box), narrowed(rays));
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ASSERT_EQ(keys[i] >> (RayKeys::bits - 3), static_cast<std::uint32_t>(octant(rays[i])));
            ASSERT_EQ(keys_f32[i] >> (RayKeys::bits - 3), static_cast<std::uint32_t>(octant(rays[i])));
        }
    });
}

TEST(RayKeys, AreNearWhereRaysEnterNearEachOther) {
    on_every_target([] {
        std::vector<Ray> rays = random_rays(20000, 3);
        for (Ray& ray : rays) ray.origin *= 0.5;
        const std::vector<std::uint32_t> keys = keys_of(RayKeys(unit_box), rays);
        std::vector<std::size_t> order(rays.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        const auto mean_distance = [&] {
            double sum = 0.0;
            for (std::size_t i = 1; i < order.size(); ++i)
                sum += glm::length(rays[order[i]].origin - rays[order[i - 1]].origin);
            return sum / static_cast<double>(order.size() - 1);
        };
        const double before = mean_distance();
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
        EXPECT_LT(mean_distance(), 0.3 * before);
    });
}

TEST(RayKeys, RaysFromAfarGoByWhereTheyEnter) {
    on_every_target([] {
        std::vector<Ray> rays(2);
        rays[0].origin = Vec3(-0.999, 0.3, 0.3);
        rays[1].origin = Vec3(-100.0, 0.3, 0.3);
        for (Ray& ray : rays) ray.direction = Vec3(2.0, 1e-9, 1e-9);
        const std::vector<std::uint32_t> keys = keys_of(RayKeys(unit_box), rays);
        EXPECT_TRUE(RayKeys::is_near(keys[0], keys[1]));
        rays[1].tmin = 50.5; // beyond the middle of the scene
        EXPECT_FALSE(RayKeys::is_near(keys[0], keys_of(RayKeys(unit_box), rays)[1]));
    });
}

TEST(RayKeys, OfFloat32AreThoseOfFloat64ButForRounding) {
    on_every_target([] {
        const std::vector<RayF> rays = narrowed(random_rays(5000, 7));
        std::vector<Ray> wide;
        for (const RayF& ray : rays) wide.push_back(widened(ray));
        const RayKeys scene(Box{Vec3(-0.7, -1.1, -0.3), Vec3(0.9, 1.2, 1.7)});
        const std::vector<std::uint32_t> keys = keys_of(scene, wide);
        const std::vector<std::uint32_t> keys_f32 = keys_of(scene, rays);
        std::size_t same = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) same += keys[i] == keys_f32[i] ? 1 : 0;
        EXPECT_GT(same, rays.size() * 99 / 100);
    });
}

TEST(RayKeys, TakeAnyNumbers) {
    on_every_target([] {
        const std::vector<Ray> rays = rays_of_any_numbers(4000);
        for (const Box& box : {unit_box, Box{}, Box{Vec3(0.0), Vec3(0.0)}, Box{Vec3(-1e308), Vec3(1e308)},
                               Box{Vec3(0.0), Vec3(1e-320)}}) {
            for (const std::uint32_t key : keys_of(RayKeys(box), rays)) ASSERT_LT(key, 1u << RayKeys::bits);
            for (const std::uint32_t key : keys_of(RayKeys(box), narrowed(rays))) ASSERT_LT(key, 1u << RayKeys::bits);
        }
    });
}

} // namespace
} // namespace raywise
