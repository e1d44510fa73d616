#include "base/shared_bytes.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

namespace raywise {
namespace {

std::set<std::int64_t> bytes_of(const ByteLayout& a) {
    std::set<std::int64_t> bytes;
    for (std::uint64_t i = 0; i < a.count; ++i) {
        for (int c = 0; c < a.components; ++c) {
            for (std::size_t b = 0; b < a.size; ++b) {
                bytes.insert(static_cast<std::int64_t>(a.address) + static_cast<std::int64_t>(i) * a.stride +
                             c * a.component_stride + static_cast<std::int64_t>(b));
            }
        }
    }
    return bytes;
}

bool share_by_walking(const ByteLayout& one, const ByteLayout& other) {
    const std::set<std::int64_t> mine = bytes_of(one);
    for (const std::int64_t byte : bytes_of(other)) {
        if (mine.count(byte) != 0) return true;
    }
    return false;
}

TEST(SharedBytes, AreThoseThatWalkingFinds) {
    std::mt19937_64 random(11);
    const auto between = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    const auto layout = [&] {
        const std::size_t sizes[] = {1, 2, 4, 8};
        ByteLayout a;
        a.address = static_cast<std::uintptr_t>(4000 + between(-60, 60));
        a.count = static_cast<std::uint64_t>(between(0, 9));
        a.stride = between(-40, 40);
        a.components = between(1, 3);
        a.component_stride = between(-30, 30);
        a.size = sizes[between(0, 3)];
        return a;
    };
    int shared = 0;
    constexpr int trials = 60000;
    for (int i = 0; i < trials; ++i) {
        const ByteLayout one = layout();
        ByteLayout other = layout();
        if (i % 2 == 0) other.stride = one.stride; // as in an array of structs
        const bool expected = share_by_walking(one, other);
        shared += expected ? 1 : 0;
        ASSERT_EQ(share_bytes(one, other), expected)
            << one.address << " " << one.count << " " << one.stride << " " << one.components << " "
            << one.component_stride << " " << one.size << " / " << other.address << " " << other.count << " "
            << other.stride << " " << other.components << " " << other.component_stride << " " << other.size;
        ASSERT_EQ(share_bytes(other, one), expected);
    }
    EXPECT_GT(shared, trials / 10); // both answers are common
    EXPECT_LT(shared, trials * 9 / 10);
}

TEST(SharedBytes, MembersOfOneStructShareNone) {
    constexpr std::uint64_t billion = 1000000000;
    const ByteLayout t{4096, billion, 32, 1, 4, 4}, uv{4100, billion, 32, 2, 4, 4}, normal{4108, billion, 32, 3, 4, 4},
        id{4120, billion, 32, 1, 8, 8};
    for (const ByteLayout& one : {t, uv, normal, id}) {
        EXPECT_TRUE(share_bytes(one, one));
        for (const ByteLayout& other : {t, uv, normal, id})
            EXPECT_EQ(share_bytes(one, other), &one == &other || one.address == other.address);
    }
    // A last member that is one byte too long meets the next struct's first.
    EXPECT_TRUE(share_bytes(t, {4121, billion, 32, 1, 8, 8}));
}

TEST(SharedBytes, DifferentStridesMeetOnlyWhereNumberTheoryLetsThem) {
    constexpr std::uint64_t many = std::uint64_t{1} << 40;
    EXPECT_FALSE(
        share_bytes({1u << 20, many, 12, 1, 4, 4}, {(1u << 20) + 4, many, 24, 1, 4, 4})); // 4 + 24 j is no 12 i
    EXPECT_TRUE(share_bytes({1u << 20, many, 12, 1, 4, 4}, {(1u << 20) + 4, many, 20, 1, 4, 4}));
    EXPECT_TRUE(share_bytes({1u << 20, many, 12, 1, 4, 4}, {(1u << 20) + 1, many, 24, 1, 4, 4}));
    // One against many: only if it is among them.
    EXPECT_TRUE(share_bytes({1u << 20, many, 16, 1, 8, 8}, {(1u << 20) + 16 * 12345 + 7, 1, 0, 1, 8, 1}));
    EXPECT_FALSE(share_bytes({1u << 20, many, 16, 1, 8, 8}, {(1u << 20) + 16 * 12345 + 8, 1, 0, 1, 8, 8}));
}

TEST(SharedBytes, NoStrideOverflows) {
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max(),
                           least = std::numeric_limits<std::int64_t>::min();
    constexpr std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
    for (const std::int64_t stride : {most, most - 1, least + 1, std::int64_t{1}, std::int64_t{-1}, std::int64_t{0}}) {
        for (const std::int64_t other : {most, most - 2, least + 1, least + 3, std::int64_t{7}}) {
            for (const std::uint64_t count : {std::uint64_t{1}, std::uint64_t{2}, all}) {
                const ByteLayout a{4096, count, stride, 3, other, 8},
                    b{std::uintptr_t{0} - 4096, all, other, 3, stride, 4};
                EXPECT_EQ(share_bytes(a, b), share_bytes(b, a));
                EXPECT_TRUE(share_bytes(a, a));
            }
        }
    }
    EXPECT_FALSE(share_bytes({4096, 0, 8, 1, 8, 8}, {4096, 5, 8, 1, 8, 8}));
}

} // namespace
} // namespace raywise
