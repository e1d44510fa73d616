#include "measure/timing.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace raywise::calibration {
namespace {

Elapsed took(double ns) { return {ns, ns}; }

TEST(Quantile, IsLinearBetweenNeighbours) {
    EXPECT_EQ(quantile({}, 0.5), 0.0);
    EXPECT_EQ(quantile({7}, 0.25), 7.0);
    EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2.0);
    EXPECT_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
    EXPECT_EQ(quantile({4, 1, 3, 2}, 0.0), 1.0);
    EXPECT_EQ(quantile({4, 1, 3, 2}, 1.0), 4.0);
    EXPECT_EQ(quantile({0, 10, 20, 30, 40}, 0.25), 10.0);
}

TEST(TimeInTurns, GrowsTheCallsToTheLeastTime) {
    std::vector<std::uint64_t> calls;
    const Timed candidate = [&](std::uint64_t n) {
        calls.push_back(n);
        return took(10.0 * static_cast<double>(n));
    };
    const std::vector<Timing> timings = time_in_turns({candidate}, {1000.0, 3, 1e9});
    EXPECT_DOUBLE_EQ(timings[0].ns, 10.0);
    EXPECT_EQ(timings[0].spread, 0.0);
    EXPECT_EQ(timings[0].repetitions, 3u);
    EXPECT_EQ(calls.front(), 1u);
    EXPECT_GE(calls.back(), 100u);
    EXPECT_LE(calls.back(), 1000u);
    EXPECT_EQ(std::count(calls.begin(), calls.end(), calls.back()), 3);
}

TEST(TimeInTurns, BearsACandidateThatTakesNoTime) {
    std::uint64_t spent = 0;
    const Timed nothing = [&](std::uint64_t calls) {
        spent += calls;
        return Elapsed{0.0, static_cast<double>(calls)};
    };
    const Timing timing = time_in_turns({nothing}, {100.0, 3, 1000.0})[0];
    EXPECT_EQ(timing.ns, 0.0);
    EXPECT_EQ(timing.spread, 0.0);
    EXPECT_LT(spent, 1000u);
}

// A build that takes a microsecond may need a millisecond's preparation, which has to end some day.
TEST(TimeInTurns, LimitsLookAtAllThatIsSpent) {
    std::uint64_t calls = 0;
    const Timed prepared = [&](std::uint64_t n) {
        calls += n;
        return Elapsed{1.0 * static_cast<double>(n), 1000.0 * static_cast<double>(n)};
    };
    const Timing timing = time_in_turns({prepared}, {1000.0, 5, 1e9})[0];
    EXPECT_EQ(timing.ns, 1.0);
    EXPECT_EQ(calls, 5u);
}

TEST(TimeInTurns, CandidatesTakeTurns) {
    std::vector<int> order;
    const auto candidate = [&](int name) {
        return [&order, name](std::uint64_t) {
            order.push_back(name);
            return took(100.0);
        };
    };
    time_in_turns({candidate(0), candidate(1), candidate(2)}, {100.0, 4, 1e9});
    EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 1, 2, 0, 2, 0, 1, 0, 1, 2}));
}

TEST(TimeInTurns, TakesTheMedianAndIgnoresAnInterruption) {
    int call = 0;
    const Timed interrupted = [&](std::uint64_t) { return took(++call == 3 ? 1e6 : 100.0); };
    const Timing timing = time_in_turns({interrupted}, {100.0, 5, 1e9})[0];
    EXPECT_EQ(timing.ns, 100.0);
    EXPECT_EQ(timing.spread, 0.0);
}

TEST(TimeInTurns, TellsTheSpread) {
    int call = 0;
    const Timed uneven = [&](std::uint64_t) { return took(100.0 + 10.0 * (call++ % 5)); };
    const Timing timing = time_in_turns({uneven}, {50.0, 5, 1e9})[0];
    EXPECT_EQ(timing.ns, 120.0);
    EXPECT_NEAR(timing.spread, 20.0 / 120.0, 1e-12);
}

TEST(TimeInTurns, DoesNotRepeatWhatHasTakenTooLong) {
    int dear = 0, cheap = 0;
    const std::vector<Timing> timings = time_in_turns({[&](std::uint64_t) {
                                                           ++dear;
                                                           return took(1000.0);
                                                       },
                                                       [&](std::uint64_t) {
                                                           ++cheap;
                                                           return took(200.0);
                                                       }},
                                                      {100.0, 4, 900.0});
    EXPECT_EQ(dear, 1);
    EXPECT_EQ(cheap, 4);
    EXPECT_EQ(timings[0].repetitions, 1u);
    EXPECT_EQ(timings[0].ns, 1000.0);
}

TEST(WithClock, CountsCallsAndTime) {
    int calls = 0;
    const Timed timed = with_clock([&] { ++calls; });
    EXPECT_GE(timed(5).counted, 0.0);
    EXPECT_EQ(calls, 5);
}

TEST(Clocks, NeverGoBackAndDoGoOn) {
    for (const Clock clock : {Clock{now_ns}, Clock{processor_ns}}) {
        const double start = clock();
        double latest = start;
        for (int i = 0; i < 1000 || latest == start; ++i) {
            const double now = clock();
            ASSERT_GE(now, latest);
            latest = now;
        }
        EXPECT_GT(latest, start);
    }
}

} // namespace
} // namespace raywise::calibration
