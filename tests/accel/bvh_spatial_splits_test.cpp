#include "accel/bvh/build/spatial_splits.h"

#include "accel/bvh/build/build.h"
#include "accel/bvh/build/reference_cut.h"
#include "accel/bvh_testing.h"
#include "accel/bvh_tree_testing.h"
#include "accel/dense_region.h"
#include "accel/sticks_testing.h"

#include <algorithm>
#include <cmath>

namespace raywise {
namespace {

using namespace bvh_testing;

BvhBuildOptions high_quality(std::uint32_t block_size = 1) {
    BvhBuildOptions options;
    options.max_leaf_size = 8;
    options.block_size = block_size;
    options.quality = BvhQuality::high;
    return options;
}

// Cut primitives, and nothing moved afterwards.
BvhTree build_cut(const BuildInput& input, const BvhBuildOptions& options, double budget = split_budget) {
    BvhTree tree;
    tree.frame = scene_frame(input.primitives);
    const auto report = [&](std::uint64_t /*primitives*/) { input.progress.report(0.0, "bvh"); };
    build_with_spatial_splits(gather_references(input, tree.frame, dense_region(input.primitives).most, report), budget,
                              input, TreeCosts(input, options), report, tree);
    return tree;
}

void expect_sound(const Triangles& triangles, unsigned seed, int rays = 100) {
    Scene one(triangles, 1);
    Scene two(triangles, 2);
    const BvhTree tree = build_cut(one.input(), high_quality());
    expect_same_tree(tree, build_cut(two.input(), high_quality()));

    const TreeShape shape = shape_of(tree);
    EXPECT_LE(shape.depth, bvh_max_depth);
    EXPECT_LE(shape.largest_leaf, 8u);
    EXPECT_EQ(shape.references, tree.references.size());
    std::vector<int> uses(tree.references.size(), 0);
    EXPECT_TRUE(is_well_formed(tree, tree.root, uses));
    EXPECT_TRUE(std::all_of(uses.begin(), uses.end(), [](int n) { return n == 1; }));
    const auto hittable = static_cast<double>(one.primitives().hittable_count());
    EXPECT_LE(static_cast<double>(tree.references.size()), (1.0 + split_budget) * hittable);
    std::vector<bool> held(triangles.size(), false);
    for (const std::uint32_t primitive : tree.references) held[primitive] = true;
    EXPECT_EQ(std::count(held.begin(), held.end(), true), static_cast<std::ptrdiff_t>(hittable));

    const TreeAccel accel(one.input(), tree);
    Random random(seed);
    for (int i = 0; i < rays && !testing::Test::HasFailure(); ++i) {
        expect_same_with_intervals(one, accel, any_ray(triangles, one.bounds(), random));
    }
}

TEST(BvhSpatialSplits, Sticks) {
    expect_sound(sticks(2000, 1), 1, 200);
    expect_sound(sticks(500, 2, 1e-3, Vec3(5e6, -5e6, 5e6)), 2);
    for (const double scale : {1e-38, 1e-30, 1e30, 1e38}) expect_sound(sticks(300, 3, scale), 3);
}

TEST(BvhSpatialSplits, OtherScenes) {
    expect_sound(soup(1, 0.5, 4), 4);
    expect_sound(soup(3000, 0.5, 5), 5);
    expect_sound(grid_of_boxes(5), 6);
    expect_sound(flat(12, 1, -3.0), 7);
    expect_sound(ball(20, 2.0), 8);
    expect_sound(Triangles(3000, {Vec3(0.0), Vec3(1.0, 0.0, 0.5), Vec3(0.0, 1.0, 0.5)}), 9, 10);
    // Each half as large and half as far as the one before.
    Triangles series;
    for (int i = 0; i < 2000; ++i) {
        const double scale = std::ldexp(1e30, -(i % 200));
        series.push_back({scale * Vec3(1.0, 0.0, 0.1), scale * Vec3(1.0, 0.1, 0.0), scale * Vec3(1.1, 0.0, 0.0)});
    }
    expect_sound(series, 10, 30);
}

TEST(BvhSpatialSplits, SticksAreCutAndTheTreeIsBetter) {
    Scene scene(short_sticks(20000, 11), 2);
    for (const std::uint32_t block_size : {1u, 8u}) {
        const BvhBuildOptions options = high_quality(block_size);
        const TreeCosts costs(scene.input(), options);
        const BvhTree cut = build_cut(scene.input(), options);
        const BvhTree whole = build_cut(scene.input(), options, 0.0);
        EXPECT_GT(cut.references.size(), 22000u);
        EXPECT_EQ(whole.references.size(), 20000u);
        EXPECT_LT(tree_cost(cut, costs), 0.985 * tree_cost(whole, costs));
    }
}

TEST(BvhSpatialSplits, Cancels) {
    Scene scene(sticks(20000, 14));
    const Parallel two(2);
    int calls = 0;
    Progress stopping([&](double fraction, const char*) {
        EXPECT_LE(fraction, 1.0);
        return ++calls == 5;
    });
    const BuildInput input{scene.primitives(), {}, {}, two, stopping};
    EXPECT_THROW(build_cut(input, high_quality()), Error);
}

bool holds(const Bounds& box, const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] < static_cast<double>(box.lower[axis]) || p[axis] > static_cast<double>(box.upper[axis]))
            return false;
    }
    return true;
}

// Corners that float32 has to round, and points of the triangle that double arithmetic finds without any rounding: whole
// numbers with few bits times weights that are multiples of 1/16.
TEST(BvhSpatialSplits, CutsLoseNoPoint) {
    Random random(15);
    int in_both = 0;
    int in_one = 0;
    for (int round = 0; round < 3000; ++round) {
        const int spread = round % 3 == 0 ? 1000 : 1 << 28;
        const double offset = round % 2 == 0 ? 0.0 : 123456789.0;
        Corners corners;
        for (Vec3& p : corners) {
            for (int axis = 0; axis < 3; ++axis) p[axis] = offset + random.integer(-spread, spread);
        }
        if (round % 5 == 0) corners[1].x = corners[0].x + 1.0; // an edge nearly along the plane
        Box box;
        for (const Vec3& p : corners) box.extend(p);
        const BoxF rounded = round_outwards(box);
        Bounds part{Lanes{rounded.lower.x, rounded.lower.y, rounded.lower.z, 0.0f},
                    Lanes{rounded.upper.x, rounded.upper.y, rounded.upper.z, 0.0f}};
        const CuttableTriangle triangle(corners);
        // Three cuts, one after the other, each of what is above or below the one before.
        for (int cut = 0; cut < 3; ++cut) {
            const int axis = random.integer(0, 2);
            const double at = random.integer(0, 3) == 0 ? corners[0][axis]
                                                        : random.uniform(static_cast<double>(part.lower[axis]),
                                                                         static_cast<double>(part.upper[axis]));
            const auto plane = static_cast<float>(at);
            if (!(plane > part.lower[axis] && plane < part.upper[axis])) continue;
            const CuttableTriangle::Sides sides = triangle.cut(part, axis, plane);
            for (int i = 0; i <= 16; ++i) {
                for (int j = 0; i + j <= 16; ++j) {
                    const Vec3 p =
                        (corners[0] * double(i) + corners[1] * double(j) + corners[2] * double(16 - i - j)) * 0x1p-4;
                    if (!holds(part, p)) continue;
                    const bool below = holds(sides.below, p);
                    const bool above = holds(sides.above, p);
                    ASSERT_TRUE(below || above) << round;
                    ++(below && above ? in_both : in_one);
                }
            }
            part = random.integer(0, 1) == 0 ? sides.below : sides.above;
        }
    }
    EXPECT_GT(in_one, 10 * in_both) << "the boxes have to be tight";
}

} // namespace
} // namespace raywise
