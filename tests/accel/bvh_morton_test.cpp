#include "accel/bvh/bvh_morton.h"

#include "accel/bvh_testing.h"
#include "accel/hard_builds_testing.h"
#include "accel/wide_bvh_testing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace raywise {
namespace {

using namespace bvh_testing;

int depth_of(const WideBvh& tree) {
    std::vector<int> depths(tree.nodes.size(), 0);
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
        for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
            const NodeRef child = tree.nodes[n].child[i];
            if (!is_empty_child(tree.nodes[n], i) && !child.is_leaf()) depths[child.index()] = depths[n] + 1;
        }
    }
    return depths.empty() ? 0 : *std::max_element(depths.begin(), depths.end());
}

double largest_leaf(const WideBvh& tree) {
    std::uint32_t largest = 0;
    for (const WideNode& node : tree.nodes) {
        for (std::uint32_t i = 0; i < wide_bvh_width; ++i)
            if (!is_empty_child(node, i)) largest = std::max(largest, node.child[i].triangles());
    }
    return largest;
}

// Builds with one thread and with two, checks the tree, what becomes of it by refitting to the same, and a few answers.
void expect_sound_build(const Triangles& triangles, unsigned seed, int rays = 5) {
    Scene scene(triangles, 1);
    Scene twice(triangles, 2);
    const BvhMorton bvh(scene.input());
    expect_same_tree(bvh.tree(), BvhMorton(twice.input()).tree());
    expect_sound(bvh.tree(), scene.primitives());
    EXPECT_EQ(bvh.tree().triangle_count(), scene.primitives().hittable_count());
    EXPECT_FALSE(bvh.tree().repeats);
    EXPECT_LE(depth_of(bvh.tree()), bvh_max_depth);
    EXPECT_LE(largest_leaf(bvh.tree()), 16u);
    const Refitted again = bvh.refitted(twice.input(), infinity);
    ASSERT_NE(again.accel, nullptr);
    EXPECT_NEAR(again.cost, 1.0, 1e-12);
    expect_same_tree(bvh.tree(), dynamic_cast<const Bvh&>(*again.accel).tree());
    Random random(seed);
    for (int i = 0; i < rays && !testing::Test::HasFailure(); ++i)
        expect_same_with_intervals(scene, bvh, any_ray(triangles, scene.bounds(), random));
}

TEST(BvhMorton, NothingToHit) {
    for (const Triangles& triangles : {Triangles{}, Triangles(5, {Vec3(1.0), Vec3(1.0), Vec3(2.0)})})
        expect_nothing_to_hit<BvhMorton>(triangles);
}

TEST(BvhMorton, SoupsOfAllSizes) {
    for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u, 16u, 17u, 100u, 2047u, 2048u, 2049u, 30000u})
        expect_sound_build(soup(count, 0.02, static_cast<unsigned>(count)), static_cast<unsigned>(count), 40);
}

TEST(BvhMorton, MeshesAndBoxes) {
    expect_sound_build(grid_of_boxes(5), 1, 100);
    expect_sound_build(ball(60, 2.0), 2, 100);
    for (int axis = 0; axis < 3; ++axis) expect_sound_build(flat(30, axis, -1e6), 3, 60);
}

TEST(BvhMorton, AllScalesAndFarAway) {
    for (const double scale : {1e-300, 1e-38, 1e-20, 1e20, 1e38}) expect_sound_build(soup(2000, 0.1, 5, scale), 6, 20);
    expect_sound_build(soup(3000, 0.05, 7, 1e-3, Vec3(5e6, -5e6, 5e6)), 8, 30);
    expect_sound_build(soup(3000, 0.05, 9, 1.0, Vec3(0.0, 5e6, 0.0)), 10, 30);
}

TEST(BvhMorton, ScenesThatBreakBuilders) {
    for (const std::size_t count : {9u, 17u, 100u, 2048u, 40000u}) {
        expect_sound_build(copies(count), 11, 2);
        expect_sound_build(one_centroid(count), 12, 2);
        expect_sound_build(one_huge_many_tiny(count), 13, 2);
        expect_sound_build(collinear_slivers(count), 14, 2);
    }
    expect_sound_build(geometric_series(5000), 15);
}

// Each digit of the codes tells one triangle from the others: by codes alone the tree would be hundreds of levels deep.
TEST(BvhMorton, IsNotDeepWhereEachDigitTellsOneTriangle) {
    Triangles triangles;
    for (int i = 0; i < 240; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 place(0.0);
            for (int other = 0; other < 3; ++other) place[other] = std::ldexp(1.0, -i - (other == axis ? 0 : 1));
            const double size = std::ldexp(1e-3, -i);
            triangles.push_back({place, place + Vec3(size, 0.0, 0.0), place + Vec3(0.0, size, size)});
        }
    }
    const Corners smallest = triangles.back();
    triangles.insert(triangles.end(), 3000, smallest);
    expect_sound_build(triangles, 16);
}

// Most of the curve's cells are where most triangles are.
TEST(BvhMorton, AStrayCornerCostsTheOthersNothing) {
    const Vec3 corner(528980.0, 5183526.0, 112.0);
    Triangles triangles = hills(150, corner);
    const auto cost = [](const Triangles& all, double limit) {
        Scene scene(all);
        const BvhMorton bvh(scene.input());
        const double scale = bvh.tree().frame.scale();
        double sum = 0.0;
        for (const WideNode& node : bvh.tree().nodes) {
            for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
                if (is_empty_child(node, i)) continue;
                Vec3 size;
                for (int axis = 0; axis < 3; ++axis)
                    size[axis] = static_cast<double>(node.planes[axis][1][i] - node.planes[axis][0][i]) / scale;
                const double area = size.x * size.y + size.y * size.z + size.z * size.x;
                if (area < limit) sum += area;
            }
        }
        return sum;
    };
    const double before = cost(triangles, 400.0);
    triangles.push_back({corner, corner + Vec3(1.0, 0.0, 0.0), Vec3(0.0)});
    const double after = cost(triangles, 400.0);
    EXPECT_LT(after, 1.2 * before);
    EXPECT_GT(after, 0.8 * before);
}

// They are in leaves and nodes of their own: the boxes around the small ones stay as small as they are.
TEST(BvhMorton, LargeTrianglesAreApartFromSmallOnes) {
    Triangles triangles = ball(60, 1.0);
    const std::size_t small = triangles.size();
    for (int i = 0; i < 5; ++i) triangles.push_back({Vec3(-20.0, -20.0, i), Vec3(20.0, -20.0, i), Vec3(0.0, 20.0, i)});
    Scene scene(triangles);
    const BvhMorton bvh(scene.input());
    for (const WideNode& node : bvh.tree().nodes) {
        for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
            if (is_empty_child(node, i) || !node.child[i].is_leaf()) continue;
            std::size_t large = 0;
            for_each_block<double>(bvh.tree(), node.child[i], [&](const TriangleBlock<double>& block) {
                for (std::uint32_t k = 0; k < block.n; ++k) large += block.id(k) >= small ? 1 : 0;
            });
            EXPECT_TRUE(large == 0 || large == node.child[i].triangles());
        }
    }
    expect_sound_build(triangles, 23, 60);
}

// Two heaps of triangles, each within one cell of the grid over both, and each too large for one thread.
TEST(BvhMorton, WhatOneCellHoldsIsToldApartOnFinerGrids) {
    const auto heaps = [](double apart) {
        Triangles triangles = soup(60000, 0.02, 17, 1e-3);
        for (std::size_t i = 0; i < triangles.size(); i += 2) {
            for (Vec3& corner : triangles[i]) corner += Vec3(apart, 0.0, 0.0);
        }
        return triangles;
    };
    expect_sound_build(heaps(1.0), 18);
    expect_sound_build(heaps(1e3), 19);
    const auto nodes = [&](double apart) {
        Scene scene(heaps(apart));
        return BvhMorton(scene.input()).tree().nodes.size();
    };
    EXPECT_LT(static_cast<double>(nodes(1e3)), 1.2 * static_cast<double>(nodes(2e-3)));
}

TEST(BvhMorton, WhatCannotBeHitIsLeftOut) {
    Triangles triangles = soup(40000, 0.02, 20);
    for (std::size_t i = 0; i < triangles.size(); i += 3)
        triangles[i][2] = i % 2 == 0 ? triangles[i][0] : 0.5 * triangles[i][0] + 0.5 * triangles[i][1];
    for (std::size_t i = 16380; i < 33000; ++i) triangles[i][1] = triangles[i][0];
    triangles[7][1].x = std::numeric_limits<double>::quiet_NaN(); // skipped: invalid
    triangles.back()[0].z = infinity;
    Scene scene(triangles, 2);
    const BvhMorton bvh(scene.input());
    expect_sound(bvh.tree(), scene.primitives());
    EXPECT_EQ(bvh.tree().triangle_count(), scene.primitives().hittable_count());
}

// Of both types, of which the tree takes the wider, with and without indices, in rows and with coordinates apart.
TEST(BvhMorton, MeshesOfAllLayouts) {
    const Triangles triangles = soup(900, 0.1, 21);
    std::vector<float> rows;
    std::vector<float> apart(9 * triangles.size());
    std::vector<double> doubles;
    std::vector<std::uint32_t> backwards;
    for (std::size_t i = 0; i < 3 * triangles.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const double number = triangles[i / 3][i % 3][axis];
            rows.push_back(static_cast<float>(number));
            doubles.push_back(number + 3.0);
            apart[static_cast<std::size_t>(axis) * 3 * triangles.size() + i] = static_cast<float>(number - 3.0);
        }
        backwards.push_back(static_cast<std::uint32_t>(3 * triangles.size() - 1 - i));
    }
    const auto bytes = [](const auto& values) { return reinterpret_cast<const std::byte*>(values.data()); };
    const auto mesh = [&](const StridedArray& vertices, bool indexed) {
        TriangleArrays arrays;
        arrays.vertices = vertices;
        arrays.vertex_count = 3 * triangles.size();
        arrays.triangle_count = triangles.size();
        if (indexed) arrays.indices = {bytes(backwards), 12, 4, Scalar::uint32};
        return std::make_shared<const TriangleMesh>(arrays, false, false);
    };
    const StridedArray in_rows{bytes(rows), 12, 4, Scalar::float32};
    const StridedArray columns{bytes(apart), 4, static_cast<std::ptrdiff_t>(12 * triangles.size()), Scalar::float32};
    const StridedArray wide{bytes(doubles), 24, 8, Scalar::float64};
    const std::vector<std::vector<std::shared_ptr<const TriangleMesh>>> scenes = {
        {mesh(in_rows, false)},
        {mesh(in_rows, true), mesh(columns, false)},
        {mesh(columns, true), mesh(in_rows, false), mesh(in_rows, true)},
        {mesh(wide, true)},
        {mesh(in_rows, true), mesh(wide, false), mesh(columns, true)}};
    const Parallel parallel(2);
    Progress progress;
    for (const auto& meshes : scenes) {
        const Primitives primitives(meshes);
        const BvhMorton bvh({primitives, {}, {}, parallel, progress});
        expect_sound(bvh.tree(), primitives);
        const bool has_float64 =
            std::any_of(meshes.begin(), meshes.end(), [](const auto& each) { return !each->is_float32(); });
        EXPECT_EQ(bvh.tree().is_float64, has_float64);
    }
}

TEST(BvhMorton, ProgressRisesAndCancels) {
    Scene scene(soup(200000, 0.02, 22));
    const Parallel two(2);
    double last = 0.0;
    int calls = 0;
    Progress progress([&](double fraction, const char*) {
        EXPECT_GE(fraction, 0.0);
        EXPECT_LE(fraction, 1.0);
        last = std::max(last, fraction);
        ++calls;
        return false;
    });
    const BvhMorton bvh({scene.primitives(), {}, {}, two, progress});
    EXPECT_EQ(last, 1.0);
    EXPECT_GE(calls, 4) << "at least every 100,000 primitives";
    for (const int stop_at : {1, calls / 2, calls - 1}) {
        int so_far = 0;
        Progress stopping([&](double, const char*) { return ++so_far == stop_at; });
        const BuildInput input{scene.primitives(), {}, {}, two, stopping};
        EXPECT_THROW(BvhMorton{input}, Error);
    }
}

} // namespace
} // namespace raywise
