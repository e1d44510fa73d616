#include "base/scheduler.h"

#include "base/thread_sanitizer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace raywise {
namespace {

using Body = void (*)(void* data) noexcept;

// run_on_threads, with what the thread sanitizer is to be told.
void run(unsigned threads, std::uint64_t times, Body body, void* data) {
    struct Loop {
        Body body;
        void* data;
    } loop{body, data};
    hand_over(&loop);
    run_on_threads(
        threads, times,
        [](void* shared) noexcept {
            take_over(shared);
            const Loop& here = *static_cast<const Loop*>(shared);
            here.body(here.data);
            hand_over(shared);
        },
        &loop);
    take_over(&loop);
}

void count(void* calls) noexcept { ++*static_cast<std::atomic<int>*>(calls); }

void run_loops(unsigned threads, int loops) {
    for (int i = 0; i < loops; ++i) {
        std::atomic<int> calls{0};
        run(threads, threads, count, &calls);
        EXPECT_EQ(calls.load(), static_cast<int>(threads));
    }
}

void run_on_hosts(unsigned hosts, const std::function<void()>& body) {
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < hosts; ++i) threads.emplace_back(body);
    for (std::thread& thread : threads) thread.join();
}

TEST(Scheduler, KeepsOneArenaForEachNumberOfThreads) {
    const std::size_t before = kept_arenas();
    run_loops(2, 1000);
    run_loops(3, 1000);
    for (int i = 0; i < 500; ++i) run_loops(2 + static_cast<unsigned>(i) % 2, 1);
    EXPECT_LE(kept_arenas(), before + 2);
    EXPECT_GE(kept_arenas(), 2u);
}

TEST(Scheduler, KeepsAsManyArenasAsHostThreadsWereInLoopsAtOnce) {
    const std::size_t before = kept_arenas();
    for (int round = 0; round < 10; ++round) run_on_hosts(8, [] { run_loops(4, 100); });
    EXPECT_LE(kept_arenas(), before + 8);
    EXPECT_GE(kept_arenas(), before + 1);
}

// All of them are in a loop at the same time, or this never ends.
TEST(Scheduler, HostThreadsDoNotWaitForEachOther) {
    constexpr int hosts = 8;
    const std::size_t before = kept_arenas();
    std::atomic<int> inside{0};
    const auto wait_for_all = [](void* number) noexcept {
        auto& here = *static_cast<std::atomic<int>*>(number);
        ++here;
        while (here < hosts) std::this_thread::yield();
    };
    run_on_hosts(hosts, [&] { run(5, 1, wait_for_all, &inside); });
    EXPECT_EQ(inside.load(), hosts);
    EXPECT_EQ(kept_arenas(), before + hosts);
}

void nest(void* depth_and_calls) noexcept {
    const auto* const in = static_cast<std::pair<int, std::atomic<int>*>*>(depth_and_calls);
    ++*in->second;
    std::pair<int, std::atomic<int>*> next{in->first - 1, in->second};
    if (in->first > 0) run(2, 2, nest, &next);
}

TEST(Scheduler, LoopsMayBeWithinLoops) {
    for (int round = 0; round < 100; ++round) {
        std::atomic<int> calls{0};
        std::pair<int, std::atomic<int>*> outermost{4, &calls};
        nest(&outermost);
        EXPECT_EQ(calls.load(), 31);
    }
}

// Those of the parent are not in the child, and nothing waits for them.
TEST(Scheduler, HasNoThreadsInTheChildOfAFork) {
    run_loops(2, 1);
    const pid_t child = fork();
    if (child == 0) {
        alarm(60);
        std::atomic<int> calls{0};
        run(2, 2, count, &calls);
        _exit(calls.load());
    }
    int end = -1;
    ASSERT_EQ(waitpid(child, &end, 0), child);
    EXPECT_TRUE(WIFEXITED(end) && WEXITSTATUS(end) == 0) << end;
    run_loops(2, 1);
}

} // namespace
} // namespace raywise
