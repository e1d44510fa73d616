#include "accel/bvh/build/radix_sort.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace raywise {
namespace {

// A pass of the radix sort orders by so many bits: three passes see all of a code.
constexpr int digit_bits = 11;
constexpr std::size_t digit_count = std::size_t{1} << digit_bits;
constexpr int passes = 3;

std::uint32_t digit(const MortonKey& key, int pass) { return (key.code >> (pass * digit_bits)) & (digit_count - 1); }

} // namespace

// Blocks count their digits, and then each knows where its keys go.
void radix_sort(MortonKey* keys, MortonKey* other, std::uint32_t count, const Parallel& parallel) {
    const std::size_t blocks = (count + radix_sort_block - 1) / radix_sort_block;
    std::vector<std::array<std::uint32_t, digit_count>> places(blocks);
    const auto for_blocks = [&](const auto& body) {
        parallel.for_each(blocks, [&](std::uint64_t block) {
            const auto begin = static_cast<std::uint32_t>(block * radix_sort_block);
            body(begin, std::min(count - begin, radix_sort_block) + begin, places[block]);
        });
    };
    for (int pass = 0; pass < passes; ++pass) {
        for_blocks([&](std::uint32_t begin, std::uint32_t end, auto& counts) {
            counts.fill(0);
            for (std::uint32_t i = begin; i < end; ++i) ++counts[digit(keys[i], pass)];
        });
        std::uint32_t place = 0;
        for (std::size_t d = 0; d < digit_count; ++d) {
            for (auto& block : places) {
                const std::uint32_t here = block[d];
                block[d] = place;
                place += here;
            }
        }
        for_blocks([&](std::uint32_t begin, std::uint32_t end, auto& next) {
            for (std::uint32_t i = begin; i < end; ++i) other[next[digit(keys[i], pass)]++] = keys[i];
        });
        std::swap(keys, other);
    }
    static_assert(passes % 2 == 1, "the sorted keys are in the second array");
    static_assert(passes * digit_bits >= std::numeric_limits<decltype(MortonKey::code)>::digits);
}

} // namespace raywise
