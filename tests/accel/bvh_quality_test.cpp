#include "accel/bvh/bvh_quality.h"

#include "accel/bvh/node.h"
#include "accel/bvh_testing.h"
#include "accel/sticks_testing.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace raywise {
namespace {

using namespace bvh_testing;

std::size_t references(const Bvh& bvh) { return bvh.tree().triangle_count(); }

void check(const Triangles& triangles, unsigned seed, int rays = 200) {
    Scene scene(triangles, 2);
    const BvhHigh bvh(scene.input());
    Random random(seed);
    for (int i = 0; i < rays && !testing::Test::HasFailure(); ++i)
        expect_same_with_intervals(scene, bvh, any_ray(triangles, scene.bounds(), random));
}

TEST(BvhQuality, SameAnswers) {
    check(sticks(2000, 1), 1);
    check(sticks(500, 2, 1e-3, Vec3(5e6, -5e6, 5e6)), 2);
    for (const double scale : {1e-38, 1e-30, 1e30, 1e38}) check(sticks(300, 3, scale), 3, 50);
    check(soup(1, 0.5, 4), 4);
    check(soup(2000, 0.5, 5), 5);
    check(grid_of_boxes(5), 6);
    check(flat(12, 1, -3.0), 7);
    check(ball(20, 2.0), 8);
}

TEST(BvhQuality, NothingToHit) {
    for (const Triangles& triangles : {Triangles{}, Triangles(5, {Vec3(1.0), Vec3(1.0), Vec3(2.0)})})
        expect_nothing_to_hit<BvhHigh>(triangles);
}

// A primitive in several leaves is hit once, and hits that were there before stay.
TEST(BvhQuality, AllHitsOfPrimitivesThatWereCut) {
    const Triangles triangles = short_sticks(20000, 9);
    Scene scene(triangles, 2);
    const BvhHigh bvh(scene.input());
    ASSERT_GT(references(bvh), 22000u);
    Random random(10);
    std::size_t hits = 0;
    for (int i = 0; i < 300; ++i) {
        const Corners& c = triangles[static_cast<std::size_t>(random.integer(0, 19999))];
        const Vec3 target = 0.4 * c[0] + 0.4 * c[1] + 0.2 * c[2];
        const Ray ray{target + random.direction(), -infinity, target - random.in_cube(), infinity};
        std::vector<PrimitiveHit> all(1);
        std::vector<PrimitiveHit> expected(1);
        bvh.all(ray, {}, all);
        oracle::PlainScan(scene.input()).all(ray, {}, expected);
        std::sort(all.begin() + 1, all.end());
        ASSERT_EQ(all.size(), expected.size());
        for (std::size_t k = 0; k < all.size(); ++k) EXPECT_TRUE(same_hit(all[k], expected[k]));
        hits += all.size() - 1;
    }
    EXPECT_GT(hits, 0u);
}

// What does not overlap much is not cut: that would take memory and gain nothing.
TEST(BvhQuality, CutsOnlyWhatOverlaps) {
    Scene surface(ball(40, 2.0));
    EXPECT_EQ(references(BvhHigh(surface.input())), surface.primitives().hittable_count());
    Scene crossing(short_sticks(20000, 11), 2);
    const std::size_t cut = references(BvhHigh(crossing.input()));
    EXPECT_GT(cut, 22000u);
    EXPECT_LE(cut, 24000u);
}

TEST(BvhQuality, ScenesThatBreakBuilders) {
    // Copies; one centroid; one huge and many tiny; slivers next to each other, and across each other, on a line.
    const std::size_t count = 30000;
    Triangles copies(count, {Vec3(0.0), Vec3(1.0, 0.0, 0.5), Vec3(0.0, 1.0, 0.5)});
    Triangles centroid;
    Triangles slivers;
    Triangles crossing;
    Triangles huge = soup(count, 0.002, 21, 1e-4, Vec3(3.0, 2.0, 1.0));
    huge[count / 2] = {Vec3(-1e6, -1e6, 0.5), Vec3(1e6, -1e6, 0.5), Vec3(0.0, 1e6, 0.5)};
    Random random(22);
    for (std::size_t i = 1; i <= count; ++i) {
        const auto r = static_cast<double>(i);
        centroid.push_back({Vec3(-r, -r, -r), Vec3(r, -r, r), Vec3(-r, r, 0.0)});
        slivers.push_back({Vec3(r, 0.0, 0.0), Vec3(r + 1.0, 0.0, 1e-3), Vec3(r + 0.5, 1e-3, 0.0)});
        crossing.push_back({Vec3(random.uniform(-1, 1), 0.0, 0.0), Vec3(random.uniform(-1, 1), 0.0, 1e-6),
                            Vec3(random.uniform(-1, 1), 1e-6, 0.0)});
    }
    for (const Triangles* const triangles : {&copies, &centroid, &huge, &slivers, &crossing}) {
        Scene one(*triangles, 1);
        Scene two(*triangles, 2);
        const BvhHigh bvh(one.input());
        const BvhHigh same(two.input());
        ASSERT_EQ(bvh.tree().nodes.bytes(), same.tree().nodes.bytes());
        EXPECT_EQ(std::memcmp(bvh.tree().nodes.data(), same.tree().nodes.data(), bvh.tree().nodes.bytes()), 0);
        EXPECT_LE(bvh.bytes(), (bvh.tree().is_float64 ? 105 : 65) * count);
        for (int i = 0; i < 3; ++i) expect_same(one, bvh, any_ray(*triangles, one.bounds(), random));
    }
}

TEST(BvhQuality, ProgressRisesAndCancels) {
    Scene scene(short_sticks(20000, 12));
    const Parallel two(2);
    double last = 0.0;
    int calls = 0;
    Progress progress([&](double fraction, const char*) {
        EXPECT_GE(fraction, last);
        EXPECT_LE(fraction, 1.0);
        last = fraction;
        ++calls;
        return false;
    });
    const BvhHigh bvh({scene.primitives(), {}, {}, two, progress});
    EXPECT_GT(last, 0.95);
    for (const int stop_at : {1, calls / 2, calls - 1}) {
        int so_far = 0;
        Progress stopping([&](double, const char*) { return ++so_far == stop_at; });
        const BuildInput input{scene.primitives(), {}, {}, two, stopping};
        EXPECT_THROW(BvhHigh{input}, Error);
    }
}

} // namespace
} // namespace raywise
