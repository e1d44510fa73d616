#include "contract/exact_hits.h"

#include "contract/case_file.h"
#include "contract/expand.h"
#include "oracle/rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace raywise::contract {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Mesh mesh_of(const oracle::Scene& scene) { return {scene.name, scene.vertices, scene.triangles}; }

TEST(ExactHits, OfABoxAreItsWalls) {
    const ExactScene exact({mesh_of(oracle::cube())});
    const ExactAnswers answers = exact.answers({{0.5, 0.25, 5}, 0, {0, 0, -2}, infinity});
    ASSERT_EQ(answers.touched.size(), 2u);
    EXPECT_EQ(answers.touched[0].t, 2);
    EXPECT_EQ(answers.touched[1].t, 3);
    EXPECT_EQ(answers.touched[0].id, (PrimitiveId{0, 2}));
    EXPECT_EQ(answers.count(), 2u);
    EXPECT_TRUE(answers.count_certain);
}

TEST(ExactHits, IntervalsAreClosed) {
    const ExactScene exact({mesh_of(oracle::cube())});
    const auto count = [&](double tmin, double tmax) {
        return exact.answers({{0.5, 0.25, 5}, tmin, {0, 0, -1}, tmax}).touched.size();
    };
    EXPECT_EQ(count(0, 4), 1u);
    EXPECT_EQ(count(0, std::nextafter(4.0, 0.0)), 0u);
    EXPECT_EQ(count(4, 6), 2u);
    EXPECT_EQ(count(std::nextafter(4.0, 5.0), 6), 1u);
    EXPECT_EQ(count(-infinity, infinity), 2u);
    EXPECT_EQ(count(infinity, infinity), 0u);
    EXPECT_EQ(count(-infinity, -infinity), 0u);
    EXPECT_EQ(count(6, 4), 0u);
    EXPECT_EQ(count(nan, 4), 0u);
}

TEST(ExactHits, BadRaysHaveNone) {
    const ExactScene exact({mesh_of(oracle::cube())});
    for (const double bad : {nan, infinity, -infinity}) {
        for (int axis = 0; axis < 3; ++axis) {
            Ray ray{{0.5, 0.25, 5}, 0, {0, 0, -1}, infinity};
            ray.origin[axis] = bad;
            EXPECT_TRUE(exact.answers(ray).touched.empty());
            ray = {{0.5, 0.25, 5}, 0, {0, 0, -1}, infinity};
            ray.direction[axis] = bad;
            EXPECT_TRUE(exact.answers(ray).touched.empty());
        }
    }
    EXPECT_TRUE(exact.answers({{0.5, 0.25, 1}, 0, {0, 0, 0}, infinity}).touched.empty());
}

TEST(ExactHits, ACornerIsTouchedByManyAndCountedOnce) {
    const ExactScene exact({mesh_of(oracle::cube())});
    const ExactAnswers inside = exact.answers({{0, 0, 0}, 0, {1, 1, 1}, infinity});
    EXPECT_GE(inside.touched.size(), 3u);
    EXPECT_EQ(inside.count(), 1u);
    EXPECT_TRUE(inside.touched[0].counted);
    const ExactAnswers across = exact.answers({{3, 3, 3}, 0, {-1, -1, -1}, infinity});
    EXPECT_EQ(across.count(), 2u);
}

// Two loose triangles, one above the other: the ray passes through the upper one, and through an edge or a corner of the lower
// one. Moved one way it meets the lower one too, moved another way it does not.
TEST(ExactHits, SaysWhenTheCountDependsOnTheSide) {
    Mesh mesh;
    mesh.vertices = {{-1, -1, 0}, {1, -1, 0}, {0, 2, 0}, {0, 0, -1}, {1, 1, -1}, {-1, 3, -1}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    for (const Vec3& origin : {Vec3(0, 0, 5), Vec3(0.25, 0.25, 5)}) {
        const ExactAnswers answers = ExactScene({mesh}).answers({origin, 0, {0, 0, -1}, infinity});
        ASSERT_EQ(answers.touched.size(), 2u);
        EXPECT_FALSE(answers.count_certain);
        EXPECT_TRUE(answers.touched[0].counted);
    }
    const ExactAnswers beside = ExactScene({mesh}).answers({{0, 0.25, 5}, 0, {0, 0, -1}, infinity});
    EXPECT_EQ(beside.count(), 2u);
    EXPECT_TRUE(beside.count_certain);
}

TEST(ExactHits, NumbersGeometriesAndLeavesOutBadTriangles) {
    Mesh bad = mesh_of(oracle::cube());
    bad.vertices[0].x = nan;
    bad.triangles.push_back({0, 1, 99});
    const ExactScene exact({bad, {}, mesh_of(oracle::cube())});
    const ExactAnswers answers = exact.answers({{-0.5, -0.25, -5}, 0, {0, 0, 1}, infinity});
    ASSERT_FALSE(answers.touched.empty());
    EXPECT_EQ(answers.touched[0].id.geometry, 2u) << "both triangles of that wall of the first box use the bad vertex";
}

// The reach is a distance, in units of the direction, and does not overflow on the way.
TEST(ExactHits, ReachIsInUnitsOfTheDirection) {
    const ExactScene exact({mesh_of(oracle::cube())});
    EXPECT_DOUBLE_EQ(exact.reach({{1, 1, 5}, 0, {0, 0, -2}, infinity}), std::sqrt(4.0 + 4.0 + 36.0) / 2.0);
    EXPECT_DOUBLE_EQ(exact.reach({{1e300, 0, 0}, 0, {1e300, 0, 0}, infinity}), 1.0);
}

// Sifting triangles before the judge sees them has to change nothing, and counting has to be that of the judge's own rule.
TEST(ExactHits, AreThoseOfTheJudge) {
    std::size_t compared = 0;
    for (const oracle::Scene& scene : {oracle::cube(), oracle::icosphere(1), oracle::terrain(4), oracle::soup(40, 1),
                                       oracle::transformed(oracle::icosphere(1), 1.0, {1e6, 1e6, -1e6}, false)}) {
        const ExactScene exact({mesh_of(scene)});
        const oracle::Judge judge(scene);
        for (Ray ray : oracle::hard_rays(scene, 12, 5)) {
            ray.tmin = -infinity;
            ray.tmax = infinity;
            const ExactAnswers answers = exact.answers(ray);
            const std::vector<oracle::ExactHit> hits = judge.line_hits(ray);
            ASSERT_EQ(answers.touched.size(), hits.size());
            std::size_t crossings = 0;
            for (std::size_t i = 0; i < hits.size(); ++i) {
                EXPECT_EQ(answers.touched[i].t, hits[i].t);
                EXPECT_EQ(answers.touched[i].id.primitive, hits[i].primitive);
                crossings += oracle::meets_when_nudged(scene, ray, hits[0].primitive, hits[i].primitive) ? 1 : 0;
            }
            EXPECT_EQ(answers.count(), crossings);
            ++compared;
        }
    }
    EXPECT_GT(compared, 500u);
}

} // namespace
} // namespace raywise::contract
