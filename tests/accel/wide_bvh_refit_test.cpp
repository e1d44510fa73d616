#include "accel/bvh/refit.h"

#include "accel/bvh/bvh.h"
#include "accel/bvh/bvh_quality.h"
#include "accel/bvh_testing.h"
#include "accel/sticks_testing.h"
#include "accel/wide_bvh_testing.h"

#include <atomic>
#include <functional>

namespace raywise {
namespace {

using namespace bvh_testing;

using Move = std::function<Vec3(const Vec3&)>;

Triangles moved(Triangles triangles, const Move& move) {
    for (Corners& corners : triangles) {
        for (Vec3& corner : corners) corner = move(corner);
    }
    return triangles;
}

// Each triangle by itself.
Triangles shaken(Triangles triangles, double by, unsigned seed) {
    Random random(seed);
    for (Corners& corners : triangles) {
        const Vec3 step = random.in_cube(by);
        for (Vec3& corner : corners) corner += step;
    }
    return triangles;
}

// One triangle in `every` becomes a point.
Triangles collapsed(Triangles triangles, int every, unsigned seed) {
    Random random(seed);
    for (Corners& corners : triangles) {
        if (random.integer(1, every) == 1) corners[1] = corners[2] = corners[0];
    }
    return triangles;
}

Vec3 twist(const Vec3& p) {
    const double angle = 1.5 * p.z;
    return {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y, p.z};
}

std::unique_ptr<const Accel> refitted(const Accel& accel, Scene& scene) {
    Refitted result = accel.refitted(scene.input(), infinity);
    EXPECT_NE(result.accel, nullptr) << result.obstacle;
    return std::move(result.accel);
}

const WideBvh& tree_of(const Accel& accel) { return dynamic_cast<const Bvh&>(accel).tree(); }

void expect_same_answers(Scene& scene, const Triangles& triangles, const Accel& accel, unsigned seed, int rays = 80) {
    Random random(seed);
    int hits = 0;
    for (int i = 0; i < rays && !testing::Test::HasFailure(); ++i)
        hits += expect_same_with_intervals(scene, accel, any_ray(triangles, scene.bounds(), random)) ? 1 : 0;
    EXPECT_GT(hits, rays / 20) << "the rays have to test something";
}

TEST(WideBvhRefit, UnmovedIsTheSame) {
    for (const std::size_t count : {1u, 8u, 100u, 20000u}) {
        for (const Vec3& center : {Vec3(0.0), Vec3(1e6, -3e6, 2e6)}) {
            Scene scene(soup(count, 0.05, 1, 1.0, center), 2);
            const Bvh built(scene.input());
            const Refitted again = built.refitted(scene.input(), infinity);
            ASSERT_NE(again.accel, nullptr);
            EXPECT_NEAR(again.cost, 1.0, 1e-12);
            expect_same_tree(built.tree(), tree_of(*again.accel));
            EXPECT_EQ(built.bytes(), again.accel->bytes());
        }
    }
}

// What happens to meshes, and what hardly ever does; each of the state before it and of the first.
TEST(WideBvhRefit, AnswersAsTheLinearScanWhateverMoves) {
    const std::vector<std::pair<const char*, std::function<Triangles(const Triangles&)>>> deformations = {
        {"far away",
         [](const Triangles& t) { return moved(t, [](const Vec3& p) { return p + Vec3(1e9, -1e9, 3e8); }); }},
        {"tiny", [](const Triangles& t) { return moved(t, [](const Vec3& p) { return 1e-20 * p; }); }},
        {"hardly there", [](const Triangles& t) { return moved(t, [](const Vec3& p) { return 1e-300 * p; }); }},
        {"huge", [](const Triangles& t) { return moved(t, [](const Vec3& p) { return 1e30 * p; }); }},
        {"twisted", [](const Triangles& t) { return moved(t, twist); }},
        {"mirrored", [](const Triangles& t) { return moved(t, [](const Vec3& p) { return Vec3(-p.y, p.x, p.z); }); }},
        {"flattened",
         [](const Triangles& t) { return moved(t, [](const Vec3& p) { return Vec3(p.x, 1e-8 * p.y, p.z); }); }},
        {"partly collapsed", [](const Triangles& t) { return collapsed(t, 3, 5); }},
        {"exploded", [](const Triangles& t) { return shaken(t, 30.0, 6); }},
    };
    for (const Triangles& rest :
         {soup(300, 0.2, 2), ball(8, 1.0), grid_of_boxes(3), moved(soup(40, 0.4, 3), through_float)}) {
        Scene scene(rest);
        const Bvh built(scene.input());
        for (const auto& [name, deform] : deformations) {
            SCOPED_TRACE(name);
            const Triangles now = deform(rest);
            Scene there(now, 2);
            const std::unique_ptr<const Accel> accel = refitted(built, there);
            ASSERT_NE(accel, nullptr);
            expect_sound(tree_of(*accel), there.primitives());
            expect_same_answers(there, now, *accel, 7, 40);

            const Triangles then = moved(now, twist);
            Scene on(then, 2);
            const std::unique_ptr<const Accel> second = refitted(*accel, on);
            if (second == nullptr) continue; // what was too small to be told apart may not be any more
            expect_sound(tree_of(*second), on.primitives());
            expect_same_answers(on, then, *second, 8, 20);
        }
    }
}

TEST(WideBvhRefit, TheSameForAnyNumberOfThreads) {
    const Triangles triangles = soup(60000, 0.02, 9);
    Scene scene(triangles, 2);
    const Bvh built(scene.input());
    ASSERT_GT(built.tree().nodes.size(), 1000u) << "several tasks";
    const Triangles now = moved(triangles, twist);
    Scene one(now, 1);
    Scene three(now, 3);
    const Refitted a = built.refitted(one.input(), infinity);
    const Refitted b = built.refitted(three.input(), infinity);
    EXPECT_EQ(a.cost, b.cost);
    expect_same_tree(tree_of(*a.accel), tree_of(*b.accel));
    expect_sound(tree_of(*a.accel), one.primitives());
}

TEST(WideBvhRefit, TheCostTellsWhenToBuildAnew) {
    const Triangles triangles = soup(5000, 0.02, 10);
    Scene scene(triangles);
    const Bvh built(scene.input());
    EXPECT_EQ(built.tree().built_cost, tree_cost(built.tree(), Parallel(1)));

    Scene a_little(shaken(triangles, 0.01, 11));
    const Refitted little = built.refitted(a_little.input(), 2.0);
    ASSERT_NE(little.accel, nullptr);
    EXPECT_GT(little.cost, 1.0);
    EXPECT_LT(little.cost, 1.3);
    EXPECT_EQ(tree_of(*little.accel).built_cost, built.tree().built_cost);
    EXPECT_EQ(built.refitted(a_little.input(), 1.0).accel, nullptr);

    Scene a_lot(shaken(triangles, 1.0, 12));
    const Refitted lot = little.accel->refitted(a_lot.input(), 2.0);
    EXPECT_EQ(lot.accel, nullptr);
    EXPECT_STRNE(lot.obstacle, "");
    EXPECT_GT(lot.cost, 2.0) << "small steps add up: it is the tree as built that counts";
    const Bvh anew(a_lot.input());
    EXPECT_GT(lot.cost * built.tree().built_cost, 2.0 * anew.tree().built_cost);
}

TEST(WideBvhRefit, ATreeCostsTheAreasOfItsParts) {
    // Two leaves of one block each, side by side: unit cubes in a box of 1 x 1 x 3.
    Triangles triangles;
    for (const double z : {0.0, 2.0}) {
        for (int i = 0; i < 6; ++i) {
            triangles.push_back({Vec3(0.0, 0.0, z), Vec3(1.0, 0.0, z + 1.0), Vec3(0.0, 1.0, z)});
        }
    }
    Scene scene(triangles);
    const Bvh bvh(scene.input());
    EXPECT_NEAR(tree_cost(bvh.tree(), Parallel(1)), 1.0 + 2.0 * 3.0 / 7.0, 1e-6) << "boxes are wider by 2^-26";
    EXPECT_EQ(tree_cost(WideBvh{}, Parallel(1)), 0.0);
}

TEST(WideBvhRefit, WhatCannotBeHitAnyMoreIsLeftOut) {
    const Triangles rest = soup(500, 0.1, 13);
    Scene scene(rest);
    const Bvh built(scene.input());
    Triangles fewer = collapsed(rest, 2, 14);
    for (std::size_t i = 0; i < fewer.size(); ++i) {
        if (fewer[i][0].x < 0.0) fewer[i][2] = fewer[i][0]; // whole leaves and nodes
    }
    fewer[3][0].x = std::numeric_limits<double>::quiet_NaN(); // invalid
    Scene few(fewer);
    const std::unique_ptr<const Accel> accel = refitted(built, few);
    ASSERT_NE(accel, nullptr);
    expect_sound(tree_of(*accel), few.primitives());
    fewer.erase(fewer.begin() + 3); // no corner to aim at
    expect_same_answers(few, fewer, *accel, 15, 200);

    // They can come back to the tree they were in, not to the one that left them out.
    EXPECT_EQ(accel->refitted(scene.input(), infinity).accel, nullptr);
    Scene back(moved(rest, twist));
    EXPECT_NE(built.refitted(back.input(), infinity).accel, nullptr);

    Scene none(collapsed(rest, 1, 16));
    ASSERT_EQ(none.primitives().hittable_count(), 0u);
    const std::unique_ptr<const Accel> nothing = refitted(*accel, none);
    ASSERT_NE(nothing, nullptr);
    EXPECT_TRUE(tree_of(*nothing).nodes.empty());
    const Ray ray{Vec3(-2.0, 0.0, 0.0), 0.0, Vec3(1.0, 0.0, 0.0), infinity};
    EXPECT_FALSE(nothing->any(ray, {}));
    EXPECT_NE(nothing->refitted(none.input(), infinity).accel, nullptr);
    EXPECT_EQ(nothing->refitted(scene.input(), infinity).accel, nullptr);
}

TEST(WideBvhRefit, WhatCanBeHitOnlyNowNeedsABuild) {
    const Triangles seen = soup(100, 0.1, 17);
    Triangles triangles = seen;
    triangles[7][1] = triangles[7][0];
    Scene scene(triangles);
    const Bvh built(scene.input());
    Scene now(seen);
    const Refitted result = built.refitted(now.input(), infinity);
    EXPECT_EQ(result.accel, nullptr);
    EXPECT_STRNE(result.obstacle, "");
    Scene more(soup(101, 0.1, 17));
    EXPECT_EQ(built.refitted(more.input(), infinity).accel, nullptr);
}

TEST(WideBvhRefit, LargeLeaves) {
    const Corners corners = {Vec3(0.0), Vec3(1.0, 0.0, 0.5), Vec3(0.0, 1.0, 0.5)};
    for (const std::size_t count : {1u, 7u, 8u, 9u, 17u, 300u}) {
        const Triangles same(count, corners);
        Scene scene(same);
        const Bvh built(scene.input());
        for (const Triangles& now :
             {moved(same, [](const Vec3& p) { return p + Vec3(3.0); }), collapsed(same, 4, 18)}) {
            Scene there(now);
            if (there.primitives().hittable_count() == 0) continue;
            const std::unique_ptr<const Accel> accel = refitted(built, there);
            ASSERT_NE(accel, nullptr);
            expect_sound(tree_of(*accel), there.primitives());
            expect_same_answers(there, now, *accel, 19, 40);
        }
    }
}

TEST(WideBvhRefit, PrimitivesInSeveralLeaves) {
    const Triangles sticks = short_sticks(20000, 11);
    Scene scene(sticks);
    const BvhHigh cut(scene.input());
    ASSERT_TRUE(cut.tree().repeats) << "some were cut";
    for (const Triangles& now : {sticks, moved(sticks, twist), collapsed(sticks, 2, 21)}) {
        Scene there(now);
        const std::unique_ptr<const Accel> accel = refitted(cut, there);
        ASSERT_NE(accel, nullptr);
        expect_sound(tree_of(*accel), there.primitives());
        expect_same_answers(there, now, *accel, 20, 40);
    }
}

TEST(WideBvhRefit, KeepsTheTypeOfTheNewCoordinates) {
    const Triangles floats = moved(soup(200, 0.2, 22), through_float);
    const Triangles doubles = soup(200, 0.2, 22);
    Scene of_floats(floats);
    Scene of_doubles(doubles);
    const Bvh built(of_floats.input());
    ASSERT_FALSE(built.tree().is_float64);
    const std::unique_ptr<const Accel> float64 = refitted(built, of_doubles);
    EXPECT_TRUE(tree_of(*float64).is_float64);
    const std::unique_ptr<const Accel> float32 = refitted(*float64, of_floats);
    EXPECT_FALSE(tree_of(*float32).is_float64);
    expect_same_tree(built.tree(), tree_of(*float32));
}

TEST(WideBvhRefit, ReportsAndCancels) {
    Scene scene(soup(60000, 0.02, 23));
    const Bvh built(scene.input());
    const Parallel two(2);
    double last = 0.0;
    Progress counting([&](double fraction, const char*) {
        EXPECT_GE(fraction, 0.0);
        EXPECT_LE(fraction, 1.0);
        last = std::max(last, fraction);
        return false;
    });
    ASSERT_NE(built.refitted({scene.primitives(), {}, {}, two, counting}, infinity).accel, nullptr);
    EXPECT_EQ(last, 1.0);
    int calls = 0;
    Progress stopping([&](double, const char*) { return ++calls == 2; });
    EXPECT_THROW(built.refitted({scene.primitives(), {}, {}, two, stopping}, infinity), Error);
    EXPECT_EQ(calls, 2);
}

} // namespace
} // namespace raywise
