#include "model/policy.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace raywise {
namespace {

// What lies around the thresholds and far beyond them.
std::vector<std::uint64_t> counts() {
    std::vector<std::uint64_t> result = {1, 2, 3};
    for (std::uint64_t power = 4; power <= std::uint64_t{1} << 32; power *= 2)
        result.insert(result.end(), {power - 1, power, power + 1});
    return result;
}

TEST(Policy, GathersFromEightRaysOnAndWhenTheirNumberIsNotKnown) {
    EXPECT_FALSE(worth_gathering({1, RayKind::any}));
    EXPECT_FALSE(worth_gathering({7, RayKind::any}));
    EXPECT_TRUE(worth_gathering({8, RayKind::any}));
    EXPECT_TRUE(worth_gathering({std::nullopt, RayKind::any}));
}

TEST(Policy, LooksAtAPartOfTheTrianglesAndAtNoneForFewRays) {
    EXPECT_EQ(triangles_to_look_at(1'000'000, {31, RayKind::any}), 0u);
    EXPECT_EQ(triangles_to_look_at(1'000'000, {32, RayKind::any}), 2048u);
    EXPECT_EQ(triangles_to_look_at(100'000, {std::nullopt, RayKind::any}), 781u);
    EXPECT_EQ(triangles_to_look_at(1000, {1000, RayKind::any}), 128u);
    EXPECT_EQ(triangles_to_look_at(12, {1000, RayKind::any}), 12u);
    EXPECT_EQ(triangles_to_look_at(0, {1000, RayKind::any}), 0u);
}

TEST(Policy, LetsAreasWaitWhereFewRaysAreSureToCome) {
    EXPECT_TRUE(areas_can_wait({1, RayKind::any}));
    EXPECT_TRUE(areas_can_wait({255, RayKind::any}));
    EXPECT_FALSE(areas_can_wait({256, RayKind::any}));
    EXPECT_FALSE(areas_can_wait({std::nullopt, RayKind::any}));
}

TEST(Policy, BuildsSmallScenesOnTheCallersThread) {
    EXPECT_FALSE(worth_build_threads(0));
    EXPECT_FALSE(worth_build_threads(1023));
    EXPECT_TRUE(worth_build_threads(1024));
}

TEST(Policy, KeepsAChoiceForTwiceOrHalfThePrimitives) {
    EXPECT_TRUE(choice_holds(0, 0));
    EXPECT_FALSE(choice_holds(0, 1));
    EXPECT_FALSE(choice_holds(1, 0));
    for (const std::uint64_t n : counts()) {
        EXPECT_TRUE(choice_holds(n, 2 * n));
        EXPECT_TRUE(choice_holds(2 * n, n));
        EXPECT_FALSE(choice_holds(n, 2 * n + 1));
        EXPECT_FALSE(choice_holds(2 * n + 1, n));
    }
}

TEST(Policy, RefitsAsLongAsWhatRaysLoseIsLessThanABuild) {
    Cost predicted;
    predicted.build_ns = 1e6;
    predicted.ray_ns = 100;
    EXPECT_EQ(refit_limit(predicted, std::nullopt), 2.0);
    EXPECT_EQ(refit_limit(predicted, 10'000), 2.0);
    EXPECT_EQ(refit_limit(predicted, 40'000), 1.25);
    double before = std::numeric_limits<double>::infinity();
    for (const std::uint64_t rays : counts()) {
        const double limit = refit_limit(predicted, rays);
        EXPECT_GT(limit, 1.0);
        EXPECT_LE(limit, before);
        before = limit;
    }
}

TEST(Policy, WakesAThreadForEach256Rays) {
    EXPECT_EQ(batch_threads(1, 8), 1u);
    EXPECT_EQ(batch_threads(511, 8), 1u);
    EXPECT_EQ(batch_threads(512, 8), 2u);
    EXPECT_EQ(batch_threads(1'000'000, 8), 8u);
    EXPECT_EQ(batch_threads(1'000'000, 1), 1u);
}

TEST(Policy, WakesAThreadForFewerRaysThatTakeLong) {
    EXPECT_EQ(batch_threads(31, 8, 16), 1u);
    EXPECT_EQ(batch_threads(32, 8, 16), 2u);
    EXPECT_EQ(batch_threads(50, 8, 16), 3u);
    EXPECT_EQ(batch_threads(1000, 8, 16), 8u);
    EXPECT_EQ(batch_block(50, 8, 64, 16), 16u);
    EXPECT_EQ(batch_block(1000, 2, 64, 16), 62u);
    EXPECT_EQ(batch_block(10'000, 2, 64, 16), 64u);
    EXPECT_EQ(batch_block(50, 1, 64, 16), 64u) << "nobody to share with";
    for (const unsigned threads : {1u, 2u, 5u, 128u}) {
        for (const std::uint64_t rays : counts())
            EXPECT_GE((rays - 1) / batch_block(rays, threads, 64, 16) + 1, batch_threads(rays, threads, 16)) << rays;
    }
}

TEST(Policy, CutsABatchIntoABlockForEachThreadOrMore) {
    EXPECT_EQ(batch_block(1'000'000, 2, 1), 2048u);
    EXPECT_EQ(batch_block(1'000'000, 2, 2048), 2048u);
    EXPECT_EQ(batch_block(1'000'000, 2, 64), 64u);
    EXPECT_EQ(batch_block(16'000, 2, 2048), 1000u);
    EXPECT_EQ(batch_block(100, 2, 2048), 256u);
    for (const unsigned threads : {1u, 2u, 5u, 128u}) {
        for (const std::size_t at_a_time : {1u, 64u, 2048u}) {
            std::uint64_t before = 0;
            for (const std::uint64_t rays : counts()) {
                const std::uint64_t block = batch_block(rays, threads, at_a_time);
                EXPECT_GE(block, before);
                EXPECT_GE((rays + block - 1) / block, batch_threads(rays, threads)) << rays << " " << threads;
                before = block;
            }
        }
    }
}

TEST(Policy, MayOrderManyRaysWhereTheStructureIsLargerThanTheFirstCache) {
    EXPECT_FALSE(may_pay_to_order(4095, 1'000'000, 48'000));
    EXPECT_TRUE(may_pay_to_order(4096, 1'000'000, 48'000));
    EXPECT_FALSE(may_pay_to_order(4096, 48'000, 48'000));
    EXPECT_TRUE(may_pay_to_order(4096, 48'001, 48'000));
    EXPECT_TRUE(may_pay_to_order(4096, 1, 0)); // of a cache that nobody knows
}

TEST(Policy, TriesASixteenthOfTheRaysBeforeOrderingTheOthers) {
    EXPECT_EQ(ordering_trial(4096), 256u);
    EXPECT_EQ(ordering_trial(65'536), 4096u);
    EXPECT_EQ(ordering_trial(ordering_window), 4096u);
    std::uint64_t before = 0;
    for (const std::uint64_t rays : counts()) {
        const std::uint64_t trial = ordering_trial(rays);
        EXPECT_GE(trial, before);
        EXPECT_LT(trial, rays);
        before = trial;
    }
    EXPECT_TRUE(is_worth_timing(ordering_trial(4096)));
    EXPECT_FALSE(is_worth_timing(64));
}

TEST(Policy, OrdersSlowRaysThatComeInNoOrder) {
    EXPECT_FALSE(worth_ordering(74.9));
    EXPECT_TRUE(worth_ordering(75.0));
    EXPECT_TRUE(is_coherent(0, 100));
    EXPECT_TRUE(is_coherent(24, 100));
    EXPECT_FALSE(is_coherent(25, 100));
    EXPECT_FALSE(is_coherent(100, 100));
}

TEST(Policy, SortsOnAThreadForEach16384Rays) {
    EXPECT_EQ(ordering_threads(1, 8), 1u);
    EXPECT_EQ(ordering_threads(32'767, 8), 1u);
    EXPECT_EQ(ordering_threads(32'768, 8), 2u);
    EXPECT_EQ(ordering_threads(ordering_window, 8), 8u);
}

} // namespace
} // namespace raywise
