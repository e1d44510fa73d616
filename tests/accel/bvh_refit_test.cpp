#include "accel/bvh_refit.h"

#include "accel/bvh_testing.h"
#include "accel/bvh_tree_testing.h"

#include <cmath>

namespace raywise {
namespace {

using namespace bvh_testing;

void expect_refitted(const BvhTree& built, const Triangles& moved, unsigned seed) {
    Scene scene(moved, 2);
    BvhTree tree = built;
    ASSERT_TRUE(refit(tree, scene.input()));
    EXPECT_EQ(tree.references, built.references);
    std::vector<int> uses(tree.references.size(), 0);
    EXPECT_TRUE(is_well_formed(tree, tree.root, uses));
    Random random(seed);
    for (int i = 0; i < 300; ++i) expect_closest(scene, tree, any_ray(moved, scene.bounds(), random));
}

template <class Move>
Triangles move_all(Triangles triangles, const Move& move) {
    for (Corners& corners : triangles) {
        for (Vec3& corner : corners) corner = move(corner);
    }
    return triangles;
}

TEST(BvhRefit, UnmovedIsTheSame) {
    Scene scene(soup(5000, 0.05, 1));
    const BvhTree built = build_bvh(scene.input());
    BvhTree tree = built;
    ASSERT_TRUE(refit(tree, scene.input()));
    expect_same_tree(built, tree);
}

TEST(BvhRefit, MovedGeometry) {
    const Triangles triangles = soup(3000, 0.05, 2);
    Scene scene(triangles);
    const BvhTree built = build_bvh(scene.input());
    expect_refitted(built, move_all(triangles, [](const Vec3& p) { return 2.0 * p; }), 3);
    expect_refitted(built, move_all(triangles, [](const Vec3& p) { return Vec3(p.y, -p.x, p.z + p.x * p.y); }), 4);
    // So far away that float32 needs a center to see any detail.
    expect_refitted(built, move_all(triangles, [](const Vec3& p) { return p + Vec3(1e9, -1e9, 1e9); }), 5);
}

TEST(BvhRefit, TheCostTellsWhenToRebuild) {
    const Triangles triangles = soup(5000, 0.02, 6);
    Scene scene(triangles);
    const TreeCosts costs(scene.input(), {});
    BvhTree tree = build_bvh(scene.input());
    const double at_build = tree_cost(tree, costs);

    Random random(7);
    Triangles shaken = triangles;
    for (Corners& corners : shaken) {
        const Vec3 by = random.in_cube(0.002);
        for (Vec3& corner : corners) corner += by;
    }
    Scene a_little(shaken);
    ASSERT_TRUE(refit(tree, a_little.input()));
    EXPECT_LT(tree_cost(tree, costs), 1.2 * at_build);

    for (Corners& corners : shaken) {
        const Vec3 by = random.in_cube();
        for (Vec3& corner : corners) corner += by;
    }
    Scene a_lot(shaken);
    ASSERT_TRUE(refit(tree, a_lot.input()));
    const double refitted = tree_cost(tree, costs);
    EXPECT_GT(refitted, refit_limit * at_build);
    EXPECT_GT(refitted, refit_limit * tree_cost(build_bvh(a_lot.input()), costs));
}

TEST(BvhRefit, WhatCannotBeHitAnyMore) {
    Triangles triangles = soup(500, 0.1, 8);
    Scene scene(triangles);
    const BvhTree built = build_bvh(scene.input());
    Random random(9);
    for (Corners& corners : triangles) {
        if (random.integer(0, 2) > 0) corners[2] = corners[0];
    }
    triangles[3][0].x = std::numeric_limits<double>::quiet_NaN(); // invalid
    Scene fewer(triangles);
    BvhTree tree = built;
    ASSERT_TRUE(refit(tree, fewer.input()));
    for (const BvhPair& pair : tree.pairs) {
        for (const BvhNode& node : pair.child) {
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_TRUE(std::isfinite(node.planes[0][axis]) && std::isfinite(node.planes[1][axis]));
            }
        }
    }
    triangles.erase(triangles.begin() + 3); // no corner to aim at
    for (int i = 0; i < 200; ++i) expect_closest(fewer, tree, any_ray(triangles, fewer.bounds(), random));

    for (Corners& corners : triangles) corners[2] = corners[0];
    triangles.push_back(triangles[0]);
    Scene none(triangles);
    ASSERT_TRUE(refit(tree, none.input()));
    EXPECT_TRUE(tree.empty());
}

TEST(BvhRefit, WhatCanBeHitOnlyNowNeedsABuild) {
    Triangles triangles = soup(100, 0.1, 10);
    const Corners seen = triangles[7];
    triangles[7][1] = triangles[7][0];
    Scene scene(triangles);
    BvhTree tree = build_bvh(scene.input());
    const BvhTree built = tree;
    triangles[7] = seen;
    Scene moved(triangles);
    EXPECT_FALSE(refit(tree, moved.input()));
    expect_same_tree(built, tree);
}

TEST(BvhRefit, OneLeaf) {
    const Triangles triangles = soup(1, 0.5, 11);
    Scene scene(triangles);
    expect_refitted(build_bvh(scene.input()), move_all(triangles, [](const Vec3& p) { return p + Vec3(3.0); }), 12);
}

} // namespace
} // namespace raywise
