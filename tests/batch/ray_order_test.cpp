#include "batch/ray_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace raywise {
namespace {

std::vector<std::uint32_t> random_keys(std::size_t count, std::uint32_t below) {
    std::mt19937 engine(static_cast<unsigned>(count));
    std::uniform_int_distribution<std::uint32_t> uniform(0, below - 1);
    std::vector<std::uint32_t> keys(count);
    for (std::uint32_t& key : keys) key = uniform(engine);
    return keys;
}

TEST(RayOrder, IsThatOfAStableSort) {
    for (const unsigned threads : {1u, 2u, 5u}) {
        const Parallel parallel(threads);
        RayOrder order;
        for (const std::size_t count : {0u, 1u, 2u, 100u, 5000u, 3u, 200000u, 70000u}) {
            for (const std::uint32_t below : {1u, 50u, 1u << RayKeys::bits}) {
                const std::vector<std::uint32_t> keys = random_keys(count, below);
                std::vector<std::uint32_t> expected(count);
                std::iota(expected.begin(), expected.end(), 0u);
                std::stable_sort(expected.begin(), expected.end(),
                                 [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
                std::copy(keys.begin(), keys.end(), order.keys(count));
                const std::uint32_t* const numbers = order.sort(parallel);
                ASSERT_TRUE(std::equal(expected.begin(), expected.end(), numbers)) << count << " below " << below;
            }
        }
    }
}

} // namespace
} // namespace raywise
