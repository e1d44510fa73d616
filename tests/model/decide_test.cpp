#include "model/decide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace raywise {
namespace {

Candidate candidate(Structure structure, double build_ns, double ray_ns, bool eligible = true) {
    Candidate result{structure, {}, eligible};
    result.cost.build_ns = build_ns;
    result.cost.ray_ns = ray_ns;
    return result;
}

// A scene of the usual shape: what builds faster answers slower.
const std::vector<Candidate> usual = {
    candidate(Structure::linear_scan, 1e3, 1e6),
    candidate(Structure::uniform_grid, 1e7, 5e3),
    candidate(Structure::kd_tree, 2e9, 400),
    candidate(Structure::bvh, 1e8, 500),
};

Structure chosen(const std::vector<Candidate>& candidates, std::optional<std::uint64_t> rays) {
    return candidates.at(decide(candidates, rays).value()).structure;
}

TEST(Decide, TakesTheSmallestTotalForEachNumberOfRays) {
    EXPECT_EQ(chosen(usual, 0), Structure::linear_scan);
    EXPECT_EQ(chosen(usual, 1), Structure::linear_scan);
    EXPECT_EQ(chosen(usual, 10), Structure::linear_scan);
    EXPECT_EQ(chosen(usual, 11), Structure::uniform_grid);
    EXPECT_EQ(chosen(usual, 1'000), Structure::uniform_grid);
    EXPECT_EQ(chosen(usual, 19'000), Structure::uniform_grid);
    EXPECT_EQ(chosen(usual, 21'000), Structure::bvh);
    EXPECT_EQ(chosen(usual, 1'000'000), Structure::bvh);
    EXPECT_EQ(chosen(usual, 18'900'000), Structure::bvh);
    EXPECT_EQ(chosen(usual, 19'100'000), Structure::kd_tree);
    EXPECT_EQ(chosen(usual, 1'000'000'000'000'000), Structure::kd_tree);
}

TEST(Decide, SettlesTiesByOrder) {
    const std::vector<Candidate> equals = {candidate(Structure::linear_scan, 5, 5), candidate(Structure::bvh, 1, 1),
                                           candidate(Structure::kd_tree, 1, 1),
                                           candidate(Structure::uniform_grid, 1, 1)};
    EXPECT_EQ(decide(equals, 100), std::optional<std::size_t>(1));
    EXPECT_EQ(decide(equals, std::nullopt), std::optional<std::size_t>(1));
}

TEST(Decide, PassesOverWhatIsNotEligible) {
    std::vector<Candidate> candidates = usual;
    candidates[0].eligible = false;
    EXPECT_EQ(chosen(candidates, 1), Structure::uniform_grid);
    candidates[1].eligible = false;
    EXPECT_EQ(chosen(candidates, 1), Structure::bvh);
    EXPECT_EQ(chosen(candidates, std::nullopt), Structure::bvh);
}

TEST(Decide, HasNoAnswerWhenNoneIsEligible) {
    EXPECT_EQ(decide({}, 1), std::nullopt);
    EXPECT_EQ(decide({}, std::nullopt), std::nullopt);
    std::vector<Candidate> candidates = usual;
    for (Candidate& c : candidates) c.eligible = false;
    EXPECT_EQ(decide(candidates, 1), std::nullopt);
    EXPECT_EQ(decide(candidates, std::nullopt), std::nullopt);
}

TEST(Decide, WithAnUnknownNumberOfRaysTakesTheSmallestWorstRatio) {
    // Worst ratios over 100 ... 10^8 rays: the scan pays 2,000 times too much at 10^8 and the grid 12 times, at 100 rays the BVH 9.5 times and
    // the kd-tree 190 times.
    EXPECT_EQ(chosen(usual, std::nullopt), Structure::bvh);
}

TEST(Decide, AnUnknownNumberIsWeighedFromAHundredOn) {
    // For one ray the second takes 1,000 times as long, from 100 rays on never more than ten times, and the first comes to 10,000.
    const std::vector<Candidate> two = {candidate(Structure::linear_scan, 0, 1e4), candidate(Structure::bvh, 1e7, 1.0)};
    EXPECT_EQ(chosen(two, std::nullopt), Structure::bvh);
    EXPECT_EQ(chosen(two, 1), Structure::linear_scan);
}

TEST(Decide, AnUnknownNumberIsWeighedNoFurtherThanAHundredMillionRays) {
    // From 10^9 rays on the second would win by far, but that is not imagined.
    const std::vector<Candidate> two = {candidate(Structure::uniform_grid, 1, 2.0),
                                        candidate(Structure::bvh, 1e9, 1.0)};
    EXPECT_EQ(chosen(two, std::nullopt), Structure::uniform_grid);
    EXPECT_EQ(chosen(two, 2'000'000'000), Structure::bvh);
}

TEST(Decide, BearsCostsOfNothingAndOfEverything) {
    const double infinity = std::numeric_limits<double>::infinity();
    const std::vector<Candidate> odd = {candidate(Structure::linear_scan, infinity, 1), candidate(Structure::bvh, 0, 0),
                                        candidate(Structure::kd_tree, 0, 1e300)};
    EXPECT_EQ(chosen(odd, 5), Structure::bvh);
    EXPECT_EQ(chosen(odd, std::nullopt), Structure::bvh);
}

double break_even(double chosen_build, double chosen_ray, double other_build, double other_ray) {
    return break_even_rays(candidate(Structure::bvh, chosen_build, chosen_ray).cost,
                           candidate(Structure::kd_tree, other_build, other_ray).cost);
}

TEST(BreakEven, IsWhereTheTotalsMeet) {
    EXPECT_DOUBLE_EQ(break_even(100, 10, 1100, 5), 200);
    EXPECT_DOUBLE_EQ(break_even(1e7, 5e3, 1e8, 500), 20'000);
}

TEST(BreakEven, IsInfiniteWhenTheOtherNeverGetsAhead) {
    EXPECT_TRUE(std::isinf(break_even(100, 10, 1100, 10)));
    EXPECT_TRUE(std::isinf(break_even(100, 10, 1100, 11)));
    EXPECT_TRUE(std::isinf(break_even(100, 10, 100, 10)));
    // Ahead for few rays only is not ahead from some number on.
    EXPECT_TRUE(std::isinf(break_even(100, 10, 50, 11)));
}

TEST(BreakEven, IsZeroWhenTheOtherIsAlwaysAhead) {
    EXPECT_EQ(break_even(100, 10, 100, 5), 0);
    EXPECT_EQ(break_even(100, 10, 50, 5), 0);
    EXPECT_EQ(break_even(100, 10, 50, 10), 0);
}

} // namespace
} // namespace raywise
