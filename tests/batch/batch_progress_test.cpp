#include "batch/batch_progress.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace raywise {
namespace {

TEST(BatchProgress, UnwatchedDoesNothing) {
    const BatchWatch watch;
    BatchProgress progress(watch, 10, Parallel(1));
    EXPECT_FALSE(progress.is_watched());
    progress.poll();
    progress.finish();
}

TEST(BatchProgress, ReportsAtTheFirstLookAndAtTheEnd) {
    std::vector<double> fractions;
    BatchWatch watch;
    watch.progress = [&](double fraction, const char*) {
        fractions.push_back(fraction);
        return false;
    };
    BatchProgress progress(watch, 8, Parallel(1));
    progress.poll();
    progress.add(8);
    progress.finish();
    ASSERT_GE(fractions.size(), 2u);
    EXPECT_EQ(fractions.front(), 0.0);
    EXPECT_EQ(fractions.back(), 1.0);
}

TEST(BatchProgress, StopsEveryThreadOnceItWasAskedTo) {
    BatchWatch watch;
    watch.progress = [](double, const char*) { return true; };
    BatchProgress progress(watch, 8, Parallel(2));
    // Only the thread that asks for the batch calls back.
    std::thread([&] { EXPECT_NO_THROW(progress.poll()); }).join();
    EXPECT_THROW(progress.poll(), Error);
    std::thread([&] { EXPECT_THROW(progress.poll(), Error); }).join();
    EXPECT_THROW(progress.finish(), Error);
}

TEST(BatchProgress, CallsBackFromAnyThreadInALoopOfTheHosts) {
    int calls = 0;
    BatchWatch watch;
    watch.progress = [&](double, const char*) {
        ++calls;
        return false;
    };
    const Parallel host(2, [](std::uint64_t count, const Parallel::Task& task) {
        for (std::uint64_t i = 0; i < count; ++i) task(i);
    });
    BatchProgress progress(watch, 8, host);
    std::thread([&] { progress.poll(); }).join();
    EXPECT_EQ(calls, 1);
}

TEST(BatchProgress, StopsAsTheFlagSays) {
    volatile std::int32_t flag = 0;
    BatchWatch watch;
    watch.cancel = &flag;
    BatchProgress progress(watch, 8, Parallel(1));
    EXPECT_TRUE(progress.is_watched());
    progress.poll();
    progress.add(3);
    flag = -5;
    try {
        progress.poll();
        FAIL() << "not stopped";
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), Status::ERROR_CANCELLED);
        EXPECT_STREQ(error.what(), "options.cancel: it asked to stop, after 3 of 8 rays");
    }
    flag = 0;
    EXPECT_THROW(progress.poll(), Error); // what was begun to be stopped stays so
}

TEST(BlockPace, TakesAsManyRaysAsTakeTwoMilliseconds) {
    BlockPace pace;
    std::uint64_t rays = pace.rays(8192);
    EXPECT_EQ(rays, 8u);
    pace.took(rays, 8 * 100.0); // 100 ns each: no more than twice as many at a time
    EXPECT_EQ(pace.rays(8192), 16u);
    for (int i = 0; i < 20; ++i) {
        rays = pace.rays(8192);
        pace.took(rays, static_cast<double>(rays) * 100.0);
    }
    EXPECT_EQ(pace.rays(8192), 8192u); // as many as there may be
    EXPECT_EQ(pace.rays(100), 100u);
    pace.took(8192, 8192 * 1e5); // 0.1 ms each
    EXPECT_EQ(pace.rays(8192), 20u);
    pace.took(20, 20 * 1e9); // a second each: one is the fewest
    EXPECT_EQ(pace.rays(8192), 1u);
    pace.took(1, 0.0); // faster than the clock
    EXPECT_EQ(pace.rays(8192), 2u);
}

} // namespace
} // namespace raywise
