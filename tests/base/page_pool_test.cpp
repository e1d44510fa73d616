#include "base/page_pool.h"

#include "base/page_array.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <optional>
#include <thread>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace raywise {
namespace {

constexpr std::size_t mega = std::size_t{1} << 20;

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true; // a sanitizer's malloc ends the program where it cannot serve
#else
constexpr bool sanitized = false;
#endif

using Bytes = PageArray<std::byte>;

std::uint64_t kept() { return page_pool_figures().kept; }
std::uint64_t in_use() { return page_pool_figures().in_use; }
std::uint64_t fresh_blocks() { return page_pool_figures().fresh_blocks; }

// Forgets what was in use before.
void pass_builds() {
    for (std::size_t i = 0; i < builds_remembered; ++i) note_build();
}

class PagePool : public ::testing::Test {
protected:
    void SetUp() override {
        keep_pages(0);
        pass_builds();
        ASSERT_EQ(kept(), 0u);
        ASSERT_EQ(in_use(), 0u);
    }
    void TearDown() override { keep_pages(0); }
};

TEST_F(PagePool, LeavesSmallArraysToMalloc) {
    const KeepPages keep;
    const std::uint64_t fresh = fresh_blocks();
    { const Bytes small(least_pooled_bytes - 1); }
    EXPECT_EQ(fresh_blocks(), fresh);
    EXPECT_EQ(kept(), 0u);
    { const Bytes large(least_pooled_bytes); }
    EXPECT_EQ(fresh_blocks(), fresh + 1);
    EXPECT_GE(kept(), least_pooled_bytes);
}

TEST_F(PagePool, KeepsNothingThatNobodyAskedFor) {
    {
        const Bytes array(3 * mega);
        EXPECT_GE(in_use(), 3 * mega);
        EXPECT_LT(in_use(), 3 * mega + 8192);
    }
    EXPECT_EQ(in_use(), 0u);
    EXPECT_EQ(kept(), 0u);
}

TEST_F(PagePool, ServesTheNextArrayOfAboutThatSize) {
    const KeepPages keep;
    Bytes array(4 * mega);
    const std::byte* const memory = array.data();
    array = {};
    const std::uint64_t fresh = fresh_blocks();
    for (const std::size_t size : {4 * mega, 4 * mega + mega / 4, 4 * mega - mega / 4}) {
        array = Bytes(size); // the same and a little more or less
        EXPECT_EQ(array.data(), memory) << size;
        array = {};
    }
    EXPECT_EQ(fresh_blocks(), fresh);
    array = Bytes(3 * mega); // too small to take up so much
    EXPECT_EQ(fresh_blocks(), fresh + 1);
    array = Bytes(6 * mega);
    EXPECT_EQ(fresh_blocks(), fresh + 2);
}

// Whatever the order: the block of another length stays for whoever had it.
TEST_F(PagePool, GivesEachArrayWhatOneOfItsLengthHad) {
    const KeepPages keep;
    const std::size_t lengths[] = {4 * mega, 4 * mega + mega / 2, 5 * mega};
    const std::byte* memory[3];
    {
        Bytes arrays[3];
        for (std::size_t i = 0; i < 3; ++i) {
            arrays[i] = Bytes(lengths[i]);
            memory[i] = arrays[i].data();
        }
    }
    for (const std::size_t i : {2, 1, 0}) EXPECT_EQ(Bytes(lengths[i]).data(), memory[i]);
    for (const std::size_t i : {1, 0, 2}) EXPECT_EQ(Bytes(lengths[i]).data(), memory[i]);
}

TEST_F(PagePool, ServesWhatGrowsFromFrameToFrame) {
    const KeepPages keep;
    std::size_t size = 4 * mega;
    Bytes array(size);
    const std::uint64_t fresh = fresh_blocks();
    constexpr int frames = 60;
    for (int i = 0; i < frames; ++i) {
        size += size / 50;
        Bytes next(size);
        array = std::move(next);
        note_build();
        EXPECT_LE(in_use() + kept(), 5 * size); // twice of two arrays with their room
    }
    EXPECT_LT(fresh_blocks() - fresh, frames / 2u);
}

// It would be too small for the next frame as likely as not.
TEST_F(PagePool, DoesNotKeepWhatHasNoRoomForGrowth) {
    std::optional<Bytes> before(Bytes(2 * mega));
    const KeepPages keep;
    before.reset();
    EXPECT_EQ(kept(), 0u);
    { const Bytes array(2 * mega); }
    EXPECT_GE(kept(), 2 * mega + mega / 4);
}

TEST_F(PagePool, GivesBackWithTheLastKeeper) {
    std::optional<KeepPages> one(std::in_place), other(std::in_place);
    { const Bytes array(2 * mega); }
    EXPECT_GE(kept(), 2 * mega);
    one.reset();
    EXPECT_GE(kept(), 2 * mega);
    other.reset();
    EXPECT_EQ(kept(), 0u);
}

TEST_F(PagePool, KeepsAtMostTwiceWhatWasInUse) {
    const KeepPages keep;
    const Bytes stays(mega);
    // Each too large or too small for the others.
    for (std::size_t i = 0; i < 12; ++i) {
        { const Bytes array((1 + i) * mega); }
        const std::uint64_t peak = (2 + i) * mega;
        EXPECT_LE(in_use() + kept(), 2 * (peak + peak / 8 + 16384)) << i;
    }
    EXPECT_GT(kept(), 12 * mega);
}

TEST_F(PagePool, GivesBackWhatSmallerScenesDoNotNeed) {
    const KeepPages keep;
    { const Bytes array(16 * mega); }
    for (std::size_t i = 0; i + 1 < builds_remembered; ++i) {
        { const Bytes array(mega); }
        note_build();
        EXPECT_GE(kept(), 16 * mega) << i;
    }
    note_build();
    { const Bytes array(mega); }
    EXPECT_LT(kept(), 4 * mega);
    EXPECT_GE(kept(), mega);
}

TEST_F(PagePool, KeepsAsMuchAsItIsTold) {
    keep_pages(5 * mega);
    { const Bytes array(4 * mega); }
    EXPECT_GE(kept(), 4 * mega);
    { const Bytes array(2 * mega); } // the one released last is kept, both would be too much
    EXPECT_GE(kept(), 2 * mega);
    EXPECT_LT(kept(), 4 * mega);
    { const Bytes array(8 * mega); }
    EXPECT_LE(kept(), 5 * mega);
    EXPECT_GE(kept(), 2 * mega);
    const KeepPages keep;
    { const Bytes array(8 * mega); }
    EXPECT_GE(kept(), 8 * mega);
    keep_pages(0); // that of frames too
    EXPECT_EQ(kept(), 0u);
    { const Bytes array(8 * mega); }
    EXPECT_GE(kept(), 8 * mega);
}

TEST_F(PagePool, OfTwoArraysNoneSeesTheOthersMemory) {
    const KeepPages keep;
    std::atomic<int> wrong{0};
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (std::size_t i = 0; i < 200; ++i) {
                const std::size_t size = least_pooled_bytes + (i % 7 + t) * 20000;
                const auto mark = static_cast<std::byte>(t * 50 + i % 50);
                Bytes one(size), two(size / 2 + least_pooled_bytes);
                std::memset(one.data(), static_cast<int>(mark), one.size());
                std::memset(two.data(), static_cast<int>(mark), two.size());
                for (std::size_t k = 0; k < one.size(); k += 997) wrong += one[k] != mark ? 1 : 0;
                for (std::size_t k = 0; k < two.size(); k += 997) wrong += two[k] != mark ? 1 : 0;
                if (i % 16 == 0) note_build();
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(in_use(), 0u);
}

TEST_F(PagePool, WhatIsRefusedIsNotCounted) {
    if (sanitized) GTEST_SKIP();
    const KeepPages keep;
    { const Bytes array(mega); }
    for (const std::size_t size : {std::size_t{1} << 50, SIZE_MAX - 5}) {
        EXPECT_THROW(take_pages(size), std::bad_alloc);
        EXPECT_EQ(in_use(), 0u);
    }
    EXPECT_EQ(kept(), 0u); // it might have been what was missing
    for (std::size_t i = 1; i < 20; ++i) {
        { const Bytes array(i * mega); }
        EXPECT_LE(in_use() + kept(), 2 * (i * mega + i * mega / 8 + 8192)); // not twice what was refused
    }
}

TEST_F(PagePool, WorksInTheChildOfAFork) {
    const KeepPages keep;
    std::atomic<bool> done{false};
    std::thread other([&] {
        while (!done) const Bytes array(least_pooled_bytes);
    });
    for (int i = 0; i < 20; ++i) {
        const pid_t child = fork();
        if (child == 0) {
            { const Bytes array(least_pooled_bytes); }
            _exit(kept() >= least_pooled_bytes ? 0 : 1);
        }
        int end = -1;
        EXPECT_TRUE(child > 0 && waitpid(child, &end, 0) == child && WIFEXITED(end) && WEXITSTATUS(end) == 0);
    }
    done = true;
    other.join();
}

TEST_F(PagePool, HoldsVectorsThatGrow) {
    const KeepPages keep;
    {
        PageVector<std::uint32_t> numbers;
        for (std::uint32_t i = 0; i < 300000; ++i) numbers.push_back(i);
        for (std::uint32_t i = 0; i < 300000; ++i) ASSERT_EQ(numbers[i], i);
        EXPECT_GE(in_use(), numbers.capacity() * sizeof(std::uint32_t));
        const PageVector<std::uint32_t> copy = numbers;
        EXPECT_EQ(copy, numbers);
    }
    EXPECT_GT(kept(), 0u);
    PageVector<bool> flags(8 * mega, false); // in memory that was used before
    for (std::size_t i = 0; i < flags.size(); i += 4099) EXPECT_FALSE(flags[i]);
    const PageVector<std::uint32_t> zeros(300000);
    for (const std::uint32_t zero : zeros) ASSERT_EQ(zero, 0u);
}

} // namespace
} // namespace raywise
