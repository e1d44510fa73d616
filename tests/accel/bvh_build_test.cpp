// Scenes that break builders, and what a tree has to be whatever the scene.
#include "accel/bvh/build/build.h"

#include "accel/bvh/build/morton.h"
#include "accel/bvh/build/nearest.h"
#include "accel/bvh/bvh.h"
#include "accel/bvh_testing.h"
#include "accel/bvh_tree_testing.h"
#include "accel/hard_builds_testing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace raywise {
namespace {

using namespace bvh_testing;

const BvhBuildOptions wide_leaves{8, 8, BuildCosts{1.0, 1.0}};

// Builds with one thread and with two, checks the tree, and a few answers.
void expect_sound(const Triangles& triangles, const BvhBuildOptions& options, unsigned seed) {
    Scene scene(triangles, 1);
    Scene twice(triangles, 2);
    const BvhTree tree = build_bvh(scene.input(), 1.0, options);
    const BvhTree other = build_bvh(twice.input(), 1.0, options);
    expect_same_tree(tree, other);
    expect_valid_tree(tree, scene.primitives(), options.max_leaf_size);
    Random random(seed);
    for (int i = 0; i < 5; ++i) expect_closest(scene, tree, any_ray(triangles, scene.bounds(), random));
}

TEST(BvhBuild, ScenesThatBreakBuilders) {
    for (const BvhBuildOptions& options : {BvhBuildOptions{}, wide_leaves}) {
        expect_sound(copies(100000), options, 1);
        expect_sound(one_centroid(100000), options, 2);
        expect_sound(one_huge_many_tiny(100000), options, 3);
        expect_sound(collinear_slivers(100000), options, 4);
        expect_sound(geometric_series(5000), options, 5);
    }
}

TEST(BvhBuild, AMillionOfTheSame) {
    expect_sound(copies(1000000), wide_leaves, 6);
    expect_sound(collinear_slivers(1000000), wide_leaves, 7);
}

TEST(BvhBuild, SoupsOfAllSizes) {
    for (const std::size_t count : {1u, 2u, 3u, 7u, 8u, 9u, 100u, 2047u, 2048u, 2049u, 30000u}) {
        for (const BvhBuildOptions& options : {BvhBuildOptions{}, wide_leaves}) {
            expect_sound(soup(count, 0.02, static_cast<unsigned>(count)), options, static_cast<unsigned>(count));
        }
    }
}

double area_of_boxes_below(double limit, const BvhTree& tree) {
    double sum = 0.0;
    for (const BvhPair& pair : tree.pairs) {
        for (const BvhNode& node : pair.child) {
            const double area = bounds_of(node).half_area();
            if (area < limit) sum += area;
        }
    }
    return sum;
}

TEST(BvhBuild, AStrayCornerCostsTheOthersNothing) {
    const Vec3 corner(528980.0, 5183526.0, 112.0);
    Triangles triangles = hills(200, corner);
    Scene alone(triangles, 1);
    triangles.push_back({corner, corner + Vec3(1.0, 0.0, 0.0), Vec3(0.0)});
    Scene with_stray(triangles, 1);
    const double before = area_of_boxes_below(400.0, build_bvh(alone.input(), 1.0, wide_leaves));
    const double after = area_of_boxes_below(400.0, build_bvh(with_stray.input(), 1.0, wide_leaves));
    EXPECT_LT(after, 1.2 * before);
    EXPECT_GT(after, 0.8 * before);
}

TEST(BvhBuild, LeavesAreWhatTheCostsSay) {
    Scene scene(soup(20000, 0.01, 31));
    // A test is next to nothing: no leaf is split that may stay whole.
    const BvhTree cheap = build_bvh(scene.input(), 1.0, {8, 8, BuildCosts{1e-3, 1.0}});
    // A node is next to nothing: all primitives are alone.
    const BvhTree dear = build_bvh(scene.input(), 1.0, {8, 1, BuildCosts{1.0, 1e-9}});
    const TreeShape few = shape_of(cheap);
    const TreeShape many = shape_of(dear);
    EXPECT_GT(few.fill(), 5.0);
    EXPECT_LT(many.fill(), 1.05);
    EXPECT_LE(few.largest_leaf, 8u);
}

TEST(BvhBuild, MortonOrderTellsCloseThingsApart) {
    // A cluster of a millionth of the scene's size has an order as good as that of a scene of its own.
    const std::uint32_t count = 5000;
    auto items = PageArray<BuildItem>(count);
    Random random(41);
    for (std::uint32_t i = 0; i < count; ++i) {
        const float scale = i < 10 ? 1.0f : 1e-6f;
        for (int axis = 0; axis < 3; ++axis) {
            items[i].lower[axis] = items[i].upper[axis] = scale * static_cast<float>(random.uniform(0.0, 1.0));
        }
        items[i].id = i;
        items[i].count = 1;
    }
    const MortonGrid grid({Lanes{0, 0, 0, 0}, Lanes{1, 1, 1, 0}});
    auto keys = PageArray<MortonKey>(count);
    for (std::uint32_t i = 0; i < count; ++i) keys[i] = {grid.code(Bounds::of(items[i]).centroid()), i};
    const auto order = morton_order(items.data(), std::move(keys), count, Parallel(2));

    std::vector<bool> seen(count, false);
    double length = 0.0; // from one item of the small cluster to the next
    for (std::uint32_t i = 0; i < count; ++i) {
        ASSERT_FALSE(seen[order[i].index]);
        seen[order[i].index] = true;
        if (i == 0 || order[i].index < 10 || order[i - 1].index < 10) continue;
        const BuildItem& a = items[order[i - 1].index];
        const BuildItem& b = items[order[i].index];
        for (int axis = 0; axis < 3; ++axis) length += std::fabs(static_cast<double>(a.lower[axis] - b.lower[axis]));
    }
    // In no order the sum is 1e-6 per step, along the curve less than a tenth of it.
    EXPECT_LT(length, 0.2 * count * 1e-6);
}

TEST(BvhBuild, NearestBoxes) {
    Random random(51);
    const std::size_t count = 300;
    struct Box6 {
        float plane[6];
    };
    std::vector<Box6> boxes(count);
    for (Box6& box : boxes) {
        for (int axis = 0; axis < 3; ++axis) {
            const double lower = random.integer(0, 20);
            box.plane[axis] = static_cast<float>(-lower);
            box.plane[3 + axis] = static_cast<float>(lower + random.integer(0, 3));
        }
    }
    NearestBoxes nearest(count);
    for (std::size_t i = 0; i < count; ++i) {
        for (int p = 0; p < 6; ++p) nearest.plane(p)[i] = boxes[i].plane[p];
    }
    nearest.search(count);
    const auto area = [&](std::size_t i, std::size_t j) {
        double e[3];
        for (int axis = 0; axis < 3; ++axis) {
            e[axis] = static_cast<double>(std::max(boxes[i].plane[axis], boxes[j].plane[axis])) +
                      static_cast<double>(std::max(boxes[i].plane[3 + axis], boxes[j].plane[3 + axis]));
        }
        return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
    };
    for (std::size_t i = 0; i < count; ++i) {
        double best = infinity;
        for (std::ptrdiff_t step = -nearest_radius; step <= nearest_radius; ++step) {
            const std::ptrdiff_t j = static_cast<std::ptrdiff_t>(i) + step;
            if (step == 0 || j < 0 || j >= static_cast<std::ptrdiff_t>(count)) continue;
            best = std::min(best, area(i, static_cast<std::size_t>(j)));
        }
        ASSERT_NE(nearest.offset(i), 0);
        const auto found = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + nearest.offset(i));
        ASSERT_LT(found, count);
        EXPECT_EQ(area(i, found), best) << i;
    }
}

TEST(BvhBuild, IdenticalBoxesPairUp) {
    NearestBoxes nearest(64);
    for (std::size_t i = 0; i < 64; ++i) {
        for (int p = 0; p < 6; ++p) nearest.plane(p)[i] = p < 3 ? 0.0f : 1.0f;
    }
    nearest.search(64);
    for (std::size_t i = 0; i < 64; ++i) EXPECT_EQ(nearest.offset(i), i % 2 == 0 ? 1 : -1);
}

} // namespace
} // namespace raywise
