// The linear scan against the judge: what is hit, where, and in which order.
#include "oracle/compare.h"
#include "oracle/judge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace raywise::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void report(const Comparison& comparison) {
    ::testing::Test::RecordProperty("rays", std::to_string(comparison.rays));
    ::testing::Test::RecordProperty("tests", std::to_string(comparison.tests));
    ::testing::Test::RecordProperty("hits", std::to_string(comparison.hits));
    ::testing::Test::RecordProperty("worst_t_in_bounds", std::to_string(comparison.worst_t));
    ::testing::Test::RecordProperty("worst_uv", std::to_string(comparison.worst_uv));
    EXPECT_TRUE(comparison.faults.empty()) << comparison.text();
    EXPECT_GT(comparison.rays, 0u);
}

TEST(LinearScan, AgreesWithTheJudgeOnRandomRays) {
    Comparison all;
    for (const Scene& scene : hard_scenes()) all.add(compare_with_judge(scene, random_rays(scene, 40, 11)));
    report(all);
    EXPECT_GT(all.hits, 500u);
}

TEST(LinearScan, AgreesWithTheJudgeOnHardRays) {
    Comparison all;
    for (const Scene& scene : hard_scenes()) all.add(compare_with_judge(scene, hard_rays(scene, 12, 12)));
    report(all);
    EXPECT_GT(all.hits, 5000u);
}

TEST(LinearScan, AgreesWithTheJudgeOnFarScenes) {
    Comparison all;
    for (const Scene& scene : far_scenes()) {
        all.add(compare_with_judge(scene, random_rays(scene, 10, 16)));
        all.add(compare_with_judge(scene, hard_rays(scene, 3, 17)));
        all.add(compare_with_judge(scene, rays_from_close_by(scene, 10, 18)));
        for (const double times : {1e3, 7.5e10, 1e30})
            all.add(compare_with_judge(scene, rays_from_afar(scene, times, 1, 19)));
    }
    report(all);
    EXPECT_GT(all.hits, 2000u);
}

TEST(LinearScan, AgreesWithTheJudgeOnRealMeshes) {
    Comparison all;
    for (const Scene& scene : real_meshes(100000)) {
        const bool large = scene.triangles.size() > 20000;
        all.add(compare_with_judge(scene, random_rays(scene, large ? 6 : 20, 13)));
        all.add(compare_with_judge(scene, hard_rays(scene, 1, 14)));
    }
    EXPECT_TRUE(all.faults.empty()) << all.text();
}

TEST(LinearScan, LetsNoRayLeakOutOfAClosedMesh) {
    for (Scene scene :
         {tetrahedron(), cube(), icosphere(2), transformed(icosphere(2), 1e-20, Vec3(0.0), true),
          transformed(icosphere(2), 1e20, Vec3(0.0), true), transformed(icosphere(2), 1.0, Vec3(1e6, 0, 0), false)}) {
        const Primitives primitives = primitives_of(scene);
        const Parallel parallel(1);
        Progress progress;
        const auto scan = build(Structure::linear_scan, BuildInput{primitives, {}, std::nullopt, parallel, progress});
        for (const Ray& ray : leak_rays(scene, 200, 15)) {
            EXPECT_TRUE(scan->any(ray, {})) << scene.name << ": " << describe(ray);
        }
    }
}

TEST(LinearScan, GivesTiesToTheLowestNumber) {
    const Scene scene = stacked_squares(5);
    const Primitives primitives = primitives_of(scene);
    const Parallel parallel(1);
    Progress progress;
    const auto scan = build(Structure::linear_scan, BuildInput{primitives, {}, std::nullopt, parallel, progress});
    const Ray through_first{{0.5, -0.25, 0}, 0.0, {0, 0, 1}, infinity};
    const Ray through_second{{-0.5, 0.25, 0}, 0.0, {0, 0, 1}, infinity};
    const Ray through_both{{0.25, 0.25, 0}, 0.0, {0, 0, 1}, infinity};
    EXPECT_EQ(scan->closest(through_first, {}).primitive, 0u);
    EXPECT_EQ(scan->closest(through_second, {}).primitive, 1u);
    EXPECT_EQ(scan->closest(through_both, {}).primitive, 0u);
}

// The exact judge itself, where the answer is known by hand.
TEST(Judge, KnowsSimpleAnswers) {
    const Judge judge(single_triangle());
    const auto hits = judge.line_hits({{0.25, 0.5, -4}, 0.0, {0, 0, 2}, infinity});
    ASSERT_EQ(hits.size(), 1u);
    EXPECT_EQ(hits[0].u, Fraction(1, 4));
    EXPECT_EQ(hits[0].v, Fraction(1, 2));
    EXPECT_EQ(hits[0].t, (Fraction(1, 16) + Fraction(1, 4) + 4) / 2);
    EXPECT_EQ(judge.line_hits({{0, 0, 5}, 0.0, {0, 0, 1}, infinity}).size(), 1u) << "a corner belongs to the triangle";
    EXPECT_EQ(judge.line_hits({{0.5, 0, 5}, 0.0, {0, 0, 1}, infinity}).size(), 1u) << "an edge belongs to the triangle";
    EXPECT_EQ(judge.line_hits({{0.5, -0x1p-1074, 5}, 0.0, {0, 0, 1}, infinity}).size(), 0u);
    EXPECT_EQ(judge.line_hits({{0, 0, 0}, 0.0, {1, 0, 0.25}, infinity}).size(), 0u) << "in the plane";
}

TEST(Judge, SeesDegenerateTrianglesExactly) {
    EXPECT_TRUE(has_no_area({0, 0, 0}, {1, 1, 1}, {3, 3, 3}));
    EXPECT_FALSE(has_no_area({0, 0, 0}, {1, 1, 1}, {3, 3, 3 + 0x1p-50}));
    EXPECT_TRUE(has_no_area({1e300, 0, 1e-300}, {1e300, 0, 1e-300}, {0, 0, 0}));
    EXPECT_EQ(exact(0x1p-1074) * exact(0x1p1000), Fraction(1, Integer(1) << 74));
}

// Numbers whose products leave the range of float64.
struct Extreme {
    const char* name;
    Scene scene;
    Ray ray;
};

std::vector<Extreme> extremes() {
    const Scene square{"square", {{0, -1, -1}, {0, 1, -1}, {0, 0, 1}}, {{0, 1, 2}}};
    const auto sized = [&square](double factor) { return transformed(square, factor, Vec3(0.0), false); };
    std::vector<Extreme> all = {
        {"origin at 1e300", square, {{0x1p1000, 0.25, 0}, 0.0, {-1, 0, 0}, infinity}},
        {"origin at 1e200", square, {{0x1p660, 0.25, 0}, 0.0, {-1, 0, 0}, infinity}},
        {"triangle of 1e-150 seen from 1", sized(0x1p-500), {{1, 0, 0}, 0.0, {-1, 0, 0}, infinity}},
        {"triangle of 1e-200 seen from 1", sized(0x1p-660), {{1, 0, 0}, 0.0, {-1, 0, 0}, infinity}},
        {"triangle of 1e-300", sized(0x1p-1000), {{0x1p-1000, 0, 0}, 0.0, {-1, 0, 0}, infinity}},
        {"needle of 1e38 by 1e-300",
         {"needle", {{-1e38, 0, 0}, {1e38, 0, 0}, {0, 1e-300, 0}}, {{0, 1, 2}}},
         {{0, 0, 1}, 0.0, {0, 0, -1}, infinity}},
        {"direction component 2^-450, along an edge's plane",
         {"edge", {{0, 0, -1}, {0, 0, 1}, {0, 1, 0}}, {{0, 1, 2}}},
         {{1, 0, 0}, 0.0, {-1, -0x1p-450, 0}, infinity}},
    };
    return all;
}

TEST(LinearScan, CountsVanishingDirectionComponentsAsZero) {
    const Scene edge{"edge", {{0, 0, -1}, {0, 0, 1}, {0, 1, 0}}, {{0, 1, 2}}};
    for (const double vanishing : {-0x1p-501, 0x1p-501, -0x1p-1074, 0x1p-1074, 0.0, -0.0}) {
        const Comparison comparison = compare_with_judge(edge, {{{1, 0, 0}, 0.0, {-1, 0, 0}, infinity}});
        EXPECT_TRUE(comparison.faults.empty()) << comparison.text();
        const ExactRay ray({{1, 0, 0}, 0.0, {-1, vanishing, 0}, infinity});
        EXPECT_EQ(ray.direction.y, 0.0);
    }
}

TEST(LinearScan, AgreesWithTheJudgeWhereProductsLeaveTheRange) {
    for (const Extreme& extreme : extremes()) {
        const Comparison comparison = compare_with_judge(extreme.scene, {extreme.ray});
        EXPECT_TRUE(comparison.faults.empty()) << extreme.name << ": " << comparison.text();
    }
}

// A triangle so small and far away that float64 barely tells the signs: its weights have to be right as well.
TEST(LinearScan, KeepsWeightsOfSpecksFarAway) {
    Comparison all;
    for (int exponent = 30; exponent < 60; ++exponent) {
        const double size = std::ldexp(1.0 / 3.0, -exponent);
        const Scene speck{
            "speck", {{0.1 * size, 0.2 * size, 0}, {size, 0.3 * size, 0}, {0.4 * size, 0.9 * size, 0}}, {{0, 1, 2}}};
        std::vector<Ray> rays;
        for (int i = 0; i < 16; ++i) {
            const Vec3 target =
                speck.vertices[0] * 0.5 + speck.vertices[1] * (0.5 - i / 32.0) + speck.vertices[2] * (i / 32.0);
            const Vec3 origin(0.3 + 0.01 * i, 0.2, 1.0);
            rays.push_back({origin, 0.0, target - origin, infinity});
        }
        all.add(compare_with_judge(speck, rays));
    }
    report(all);
}

// A step of one unit in the last place beyond the surface, or on it, or before it.
TEST(LinearScan, TellsExactlyOnWhichSideARayStarts) {
    Comparison all;
    for (const Scene& scene : {icosphere(2), soup(150, 22), terrain(8), flat_square(5, 1),
                               transformed(icosphere(2), 1.0, Vec3(5e6, 3e5, 100.0), false),
                               transformed(soup(150, 22), 1e-30, Vec3(0.0), false)}) {
        std::vector<Ray> rays;
        for (Ray ray : random_rays(scene, 150, 23)) {
            const auto& [a, b, c] = scene.triangles[rays.size() % scene.triangles.size()];
            const Vec3 on = 0.25 * scene.vertices[a] + 0.25 * scene.vertices[b] + 0.5 * scene.vertices[c];
            for (const double beside : {0.0, -2000.0, 2000.0}) {
                ray.origin = on;
                ray.origin[static_cast<int>(rays.size() % 3)] =
                    beside == 0.0 ? on[static_cast<int>(rays.size() % 3)]
                                  : std::nextafter(on[static_cast<int>(rays.size() % 3)], beside * 1e300);
                rays.push_back(ray);
            }
        }
        all.add(compare_with_judge(scene, rays));
    }
    report(all);
    EXPECT_GT(all.hits, 1000u);
}

TEST(LinearScan, CountsAHitAtTheOriginOfARay) {
    // The origin lies exactly on the triangle, so t is exactly 0 and tmin = 0 includes it.
    const Scene scene = soup(200, 21);
    const Judge judge(scene);
    const Primitives primitives = primitives_of(scene);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        for (const std::uint32_t v : scene.triangles[i]) {
            const Ray ray{scene.vertices[v], 0.0, {0.3, 0.4, 0.5}, 0.0};
            PrimitiveHit hit;
            ASSERT_TRUE(primitives.test(ExactRay(ray), static_cast<std::uint32_t>(i), hit))
                << "triangle " << i << ": " << describe(ray);
            EXPECT_EQ(hit.t, 0.0);
        }
    }
}

} // namespace
} // namespace raywise::oracle
