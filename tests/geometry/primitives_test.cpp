// All primitives of a scene under one numbering.
#include "geometry/primitives.h"

#include "oracle/judge.h"
#include "oracle/scenes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <random>
#include <thread>
#include <vector>

namespace raywise {
namespace {

using oracle::Scene;

std::shared_ptr<const TriangleMesh> mesh_of(const Scene& scene) {
    return oracle::primitives_of(scene).meshes().front();
}

TEST(Primitives, NumbersThroughAllMeshes) {
    const Primitives primitives(
        {mesh_of(oracle::cube()), mesh_of(oracle::empty_scene()), mesh_of(oracle::single_triangle())});
    EXPECT_EQ(primitives.count(), 13u);
    EXPECT_EQ(primitives.locate(0).geometry, 0u);
    EXPECT_EQ(primitives.locate(11).geometry, 0u);
    EXPECT_EQ(primitives.locate(11).primitive, 11u);
    EXPECT_EQ(primitives.locate(12).geometry, 2u) << "the mesh without triangles has no numbers";
    EXPECT_EQ(primitives.locate(12).primitive, 0u);
    EXPECT_EQ(primitives.corners(12), mesh_of(oracle::single_triangle())->corners(0));
}

TEST(Primitives, MayBeEmpty) {
    const Primitives none(std::vector<std::shared_ptr<const TriangleMesh>>{});
    EXPECT_EQ(none.count(), 0u);
    EXPECT_TRUE(none.bounds().empty());
    EXPECT_TRUE(Primitives({mesh_of(oracle::empty_scene())}).bounds().empty());
}

TEST(Primitives, CountsTrianglesWithoutAreaExactly) {
    const Primitives primitives = oracle::primitives_of(oracle::all_degenerate());
    EXPECT_EQ(primitives.degenerate_count(), primitives.count());
    EXPECT_EQ(primitives.hittable_count(), 0u);
    EXPECT_TRUE(primitives.bounds().empty()) << "what cannot be hit needs no room";
}

TEST(Primitives, AgreesWithTheJudgeOnWhatHasArea) {
    std::mt19937_64 random(3);
    const auto number = [&random](int low, int high) {
        return std::ldexp(1.0 + static_cast<double>(random() >> 12) * 0x1p-52,
                          low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1)));
    };
    int degenerate = 0;
    for (int i = 0; i < 3000; ++i) {
        const int low = i % 3 == 0 ? -140 : -3;
        const Vec3 a(number(low, 2), number(low, 2), number(low, 2));
        const Vec3 b(number(low, 2), number(low, 2), number(low, 2));
        Vec3 c = i % 2 == 0 ? 0.5 * a + 0.5 * b : a + (b - a) * number(-2, 2); // nearly on the line, sometimes exactly
        if (i % 5 == 0) c[i % 3] = std::nextafter(c[i % 3], 9.0);
        const Primitives primitives = oracle::primitives_of({"one", {a, b, c}, {{0, 1, 2}}});
        const bool no_area = oracle::has_no_area(a, b, c);
        degenerate += no_area ? 1 : 0;
        EXPECT_EQ(primitives.degenerate_count(), no_area ? 1u : 0u) << i;
        EXPECT_EQ(primitives.is_hittable(0), !no_area);
        const Vec3 normal = unit_normal(primitives.corners(0));
        EXPECT_NEAR(std::sqrt(glm::dot(normal, normal)), no_area ? 0.0 : 1.0, 1e-14);
    }
    EXPECT_GT(degenerate, 3);
}

TEST(Primitives, SeesTheAreaOfExtremeNeedles) {
    for (const double thin : {1e-30, 1e-100, 1e-280, 1e-300, 0x1p-1074}) {
        const Scene needle{"needle", {{-1e38, 0, 0}, {1e38, 0, 0}, {0, thin, 0}}, {{0, 1, 2}}};
        const Primitives primitives = oracle::primitives_of(needle);
        EXPECT_EQ(primitives.degenerate_count(), 0u) << thin;
        EXPECT_EQ(unit_normal(primitives.corners(0)), Vec3(0, 0, 1)) << thin;
    }
}

TEST(Primitives, NormalsFollowTheRightHand) {
    const Primitives primitives =
        oracle::primitives_of({"one", {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}}, {{0, 1, 2}, {0, 2, 1}}});
    EXPECT_EQ(unit_normal(primitives.corners(0)), Vec3(0, 0, 1));
    EXPECT_EQ(unit_normal(primitives.corners(1)), Vec3(0, 0, -1));
}

// Structures may keep corners without the signs of zeros, and answer with the same bits all the same.
TEST(Primitives, NormalsDoNotDependOnTheSignsOfZeros) {
    for (unsigned signs = 0; signs < 512; ++signs) {
        Corners corners = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 1)};
        for (unsigned i = 0; i < 9; ++i) {
            double& x = corners[i / 3][static_cast<int>(i % 3)];
            if (x == 0.0 && (signs >> i & 1u) != 0) x = -0.0;
        }
        const Vec3 normal = unit_normal(corners);
        EXPECT_EQ(normal, Vec3(0, -1, 0));
        EXPECT_FALSE(std::signbit(normal.x) || std::signbit(normal.z)) << signs;
    }
}

TEST(Primitives, BoundsHoldEveryBox) {
    for (const Scene& scene : oracle::hard_scenes()) {
        const Primitives primitives = oracle::primitives_of(scene);
        Box together;
        for (std::uint32_t i = 0; i < primitives.count(); ++i) {
            const Box box = primitives.box(i);
            for (const Vec3& p : primitives.corners(i)) EXPECT_EQ(merge(box, {p, p}).size(), box.size());
            if (primitives.is_hittable(i)) together.extend(box);
        }
        EXPECT_EQ(together.lower, primitives.bounds().lower) << scene.name;
        EXPECT_EQ(together.upper, primitives.bounds().upper) << scene.name;
    }
}

TEST(Primitives, TestsWithinTheIntervalOnly) {
    const Primitives primitives = oracle::primitives_of(oracle::stacked_squares(1)); // at z = 2
    PrimitiveHit hit;
    const auto hits = [&](double tmin, double tmax) {
        return primitives.test(ExactRay({{0.5, -0.25, 0}, tmin, {0, 0, 1}, tmax}), 0, hit);
    };
    EXPECT_TRUE(hits(0.0, 2.0)) << "ends belong to the interval";
    EXPECT_TRUE(hits(2.0, 2.0));
    EXPECT_TRUE(hits(2.0, INFINITY));
    EXPECT_FALSE(hits(0.0, std::nextafter(2.0, 0.0)));
    EXPECT_FALSE(hits(std::nextafter(2.0, 3.0), INFINITY));
    EXPECT_TRUE(hits(-INFINITY, INFINITY));
}

TEST(Primitives, NeverHitWhatIsInvalid) {
    const std::vector<double> vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0, std::nan(""), 0, 0};
    const std::vector<std::uint32_t> indices = {0, 1, 3, 0, 1, 2, 0, 1, 9};
    TriangleArrays arrays;
    arrays.vertices = {reinterpret_cast<const std::byte*>(vertices.data()), 24, 8, Scalar::float64};
    arrays.vertex_count = 4;
    arrays.indices = {reinterpret_cast<const std::byte*>(indices.data()), 12, 4, Scalar::uint32};
    arrays.triangle_count = 3;
    const Primitives primitives({std::make_shared<const TriangleMesh>(arrays, true, true)});
    EXPECT_EQ(primitives.invalid_count(), 2u);
    EXPECT_EQ(primitives.hittable_count(), 1u);
    const ExactRay ray({{0.25, 0.25, 1}, 0.0, {0, 0, -1}, INFINITY});
    PrimitiveHit hit;
    EXPECT_FALSE(primitives.test(ray, 0, hit));
    EXPECT_TRUE(primitives.test(ray, 1, hit));
    EXPECT_FALSE(primitives.test(ray, 2, hit));
}

TEST(PrimitiveHit, IsOrderedByDistanceThenByNumber) {
    const PrimitiveHit near{1.0, 0, 0, 7};
    const PrimitiveHit far{2.0, 0, 0, 3};
    const PrimitiveHit low{1.0, 0, 0, 6};
    EXPECT_TRUE(near < far);
    EXPECT_TRUE(low < near);
    EXPECT_FALSE(near < low);
    EXPECT_TRUE(far < PrimitiveHit{}) << "anything comes before no hit";
    EXPECT_FALSE(PrimitiveHit{}.is_hit());
}

// ---- Areas that are settled on demand.

std::unique_ptr<Primitives> on_demand(const Scene& scene) {
    return std::make_unique<Primitives>(oracle::primitives_of(scene).meshes(), Parallel(1),
                                        AreasAre::settled_on_demand);
}

TEST(Primitives, SettleTheSameAreasOnDemand) {
    std::uint64_t degenerate = 0;
    for (const Scene& scene : oracle::hard_scenes()) {
        SCOPED_TRACE(scene.name);
        const Primitives now = oracle::primitives_of(scene);
        const auto later = on_demand(scene);
        ASSERT_TRUE(now.are_areas_settled());
        ASSERT_FALSE(later->are_areas_settled());
        // What is told without them.
        EXPECT_EQ(later->hittable_count(), now.count());
        for (std::uint32_t i = 0; i < now.count(); ++i) ASSERT_EQ(later->is_hittable(i), now.is_hittable(i)) << i;
        const Box outer = later->outer_bounds();
        EXPECT_EQ(merge(outer, now.bounds()).lower, outer.lower);
        EXPECT_EQ(merge(outer, now.bounds()).upper, outer.upper);
        ASSERT_FALSE(later->are_areas_settled());
        // Whichever is asked first settles them.
        EXPECT_EQ(later->degenerate_count(), now.degenerate_count());
        ASSERT_TRUE(later->are_areas_settled());
        EXPECT_EQ(on_demand(scene)->largest_extent(), now.largest_extent());
        EXPECT_EQ(on_demand(scene)->bounds().lower, now.bounds().lower);
        EXPECT_EQ(on_demand(scene)->bounds().upper, now.bounds().upper);
        EXPECT_EQ(later->hittable_count(), now.hittable_count());
        EXPECT_EQ(later->outer_bounds().lower, now.bounds().lower);
        for (std::uint32_t i = 0; i < now.count(); ++i) ASSERT_EQ(later->is_hittable(i), now.is_hittable(i)) << i;
        degenerate += now.degenerate_count();
    }
    EXPECT_GT(degenerate, 10u);
}

TEST(Primitives, SettleAreasAtOnceWhereAVertexCannotBeUsed) {
    const std::vector<double> vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0, std::nan(""), 0, 0};
    TriangleArrays arrays;
    arrays.vertices = {reinterpret_cast<const std::byte*>(vertices.data()), 24, 8, Scalar::float64};
    arrays.vertex_count = 4;
    for (const std::uint32_t last : {2u, 3u, 9u}) { // which no triangle has, which one has, and one out of range
        const std::vector<std::uint32_t> indices = {0, 1, last, 0, 1, 2};
        arrays.indices = {reinterpret_cast<const std::byte*>(indices.data()), 12, 4, Scalar::uint32};
        arrays.triangle_count = 2;
        const Primitives primitives({std::make_shared<const TriangleMesh>(arrays, true, true)}, Parallel(1),
                                    AreasAre::settled_on_demand);
        EXPECT_TRUE(primitives.are_areas_settled()) << last;
        EXPECT_EQ(primitives.hittable_count(), last == 2 ? 2u : 1u);
        EXPECT_EQ(primitives.outer_bounds().upper, Vec3(1, 1, 0));
    }
}

TEST(Primitives, SettleAreasForManyThreadsAtATime) {
    const Scene scene = oracle::duplicates_and_degenerates();
    const Primitives now = oracle::primitives_of(scene);
    for (int repetition = 0; repetition < 50; ++repetition) {
        const auto later = on_demand(scene);
        std::atomic<int> wrong{0};
        std::vector<std::thread> threads;
        for (unsigned k = 0; k < 4; ++k) {
            threads.emplace_back([&, k] {
                for (std::uint32_t i = 0; i < now.count(); ++i) {
                    const std::uint32_t primitive = (i + k * 7) % now.count();
                    wrong += later->is_hittable(primitive) == now.is_hittable(primitive) ? 0 : 1;
                    if (i == k) wrong += later->bounds().lower == now.bounds().lower ? 0 : 1;
                }
                wrong += later->degenerate_count() == now.degenerate_count() ? 0 : 1;
            });
        }
        for (std::thread& thread : threads) thread.join();
        ASSERT_EQ(wrong, 0);
    }
}

} // namespace
} // namespace raywise
