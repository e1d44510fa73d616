#include "contract/sweep_schedule.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace raywise::sweep {
namespace {

TEST(TimeShares, GiveEachPartTheSameTime) {
    TimeShares shares(3);
    const double costs[3] = {1.0, 0.1, 0.01};
    double spent[3] = {};
    std::uint64_t blocks[3] = {};
    for (int i = 0; i < 3000; ++i) {
        const TimeShares::Turn turn = shares.take();
        EXPECT_EQ(turn.block, blocks[turn.part]++);
        spent[turn.part] += costs[turn.part];
        shares.give_back(turn, costs[turn.part]);
    }
    for (const double seconds : spent) EXPECT_NEAR(seconds, spent[0], 1.5);
    EXPECT_GT(blocks[2], 50 * blocks[0]);
}

TEST(TimeShares, GiveEveryPartABlockFirst) {
    TimeShares shares(5);
    std::vector<bool> seen(5, false);
    for (int i = 0; i < 5; ++i) {
        const TimeShares::Turn turn = shares.take();
        seen[turn.part] = true;
    }
    EXPECT_EQ(seen, std::vector<bool>(5, true));
}

TEST(RunPhase, RunsUntilDone) {
    std::atomic<int> blocks{0};
    const std::atomic<bool> stop{false};
    run_phase({"test", 4,
               [&](const TimeShares::Turn&) {
                   ++blocks;
                   return 0.001;
               },
               [&] { return blocks.load() / 100.0; }},
              3, stop, true);
    EXPECT_GE(blocks.load(), 100);
    EXPECT_LE(blocks.load(), 103);
}

TEST(RunPhase, StopsWhenToldTo) {
    std::atomic<int> blocks{0};
    std::atomic<bool> stop{false};
    run_phase({"test", 1,
               [&](const TimeShares::Turn&) {
                   if (++blocks == 5) stop = true;
                   return 0.001;
               },
               [] { return 0.0; }},
              1, stop, true);
    EXPECT_EQ(blocks.load(), 5);
}

TEST(RunPhase, ThrowsWhatABlockThrows) {
    const std::atomic<bool> stop{false};
    EXPECT_THROW(run_phase({"test", 1, [](const TimeShares::Turn&) -> double { throw std::runtime_error("block"); },
                            [] { return 0.0; }},
                           2, stop, true),
                 std::runtime_error);
}

} // namespace
} // namespace raywise::sweep
