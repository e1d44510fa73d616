#include "base/parallel.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace raywise {
namespace {

TEST(Parallel, CallsEveryIndexOnce) {
    for (const unsigned threads : {1u, 2u, 0u}) {
        std::vector<std::atomic<int>> calls(1000);
        Parallel(threads).for_each(calls.size(), [&](std::uint64_t i) { ++calls[i]; });
        for (const auto& count : calls) EXPECT_EQ(count.load(), 1);
    }
}

TEST(Parallel, BlocksCoverTheRangeWithoutOverlap) {
    for (const std::uint64_t count : {0ull, 1ull, 7ull, 255ull, 256ull, 257ull, 100001ull}) {
        std::vector<std::atomic<int>> calls(count);
        Parallel(2).for_blocks(count, 64, [&](std::uint64_t begin, std::uint64_t end) {
            for (std::uint64_t i = begin; i < end; ++i) ++calls[i];
        });
        for (const auto& times : calls) ASSERT_EQ(times.load(), 1);
    }
}

TEST(Parallel, ThrowsWhatATaskThrew) {
    for (const unsigned threads : {1u, 2u}) {
        EXPECT_THROW(Parallel(threads).for_each(100,
                                                [](std::uint64_t i) {
                                                    if (i == 42) throw std::runtime_error("42");
                                                }),
                     std::runtime_error);
    }
}

TEST(Parallel, UsesTheHostsLoop) {
    int loops = 0;
    int calls = 0;
    const Parallel parallel(2, [&](std::uint64_t count, const Parallel::Task& task) {
        ++loops;
        for (std::uint64_t i = count; i-- > 0;) task(i);
    });
    parallel.for_each(10, [&](std::uint64_t) { ++calls; });
    EXPECT_EQ(loops, 1);
    EXPECT_EQ(calls, 10);
}

Status status_of_host(const Parallel::Host& host) {
    try {
        Parallel(2, host).for_each(10, [](std::uint64_t) {});
    } catch (const Error& error) {
        return error.status();
    }
    return Status::OK;
}

TEST(Parallel, NoticesAHostLoopThatLeavesOutRepeatsOrOverruns) {
    using Task = Parallel::Task;
    EXPECT_EQ(status_of_host([](std::uint64_t, const Task&) {}), Status::ERROR_HOST_PARALLEL);
    EXPECT_EQ(status_of_host([](std::uint64_t n, const Task& task) {
                  for (std::uint64_t i = 1; i < n; ++i) task(i);
              }),
              Status::ERROR_HOST_PARALLEL);
    EXPECT_EQ(status_of_host([](std::uint64_t n, const Task& task) {
                  for (std::uint64_t i = 0; i < n; ++i) {
                      task(i);
                      task(0);
                  }
              }),
              Status::ERROR_HOST_PARALLEL);
    EXPECT_EQ(status_of_host([](std::uint64_t n, const Task& task) {
                  for (std::uint64_t i = 0; i <= n; ++i) task(i);
              }),
              Status::ERROR_HOST_PARALLEL);
    EXPECT_EQ(status_of_host([](std::uint64_t n, const Task& task) {
                  for (std::uint64_t i = 0; i < n; ++i) task(i);
              }),
              Status::OK);
}

} // namespace
} // namespace raywise
