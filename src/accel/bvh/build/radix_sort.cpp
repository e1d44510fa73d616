#include "accel/bvh/build/radix_sort.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

namespace raywise {
namespace {

constexpr int passes = 3;
static_assert(passes % 2 == 1, "the sorted keys are in the second array");

// A pass orders by so many bits, and three see all of a code.
constexpr int most_digit_bits = 11;
static_assert(passes * most_digit_bits >= std::numeric_limits<decltype(MortonKey::code)>::digits);

using Places = std::array<std::uint32_t, std::size_t{1} << most_digit_bits>; // of each digit's next key

// Few bits make few places, whose lines of the cache are all at hand: where no code has more than 30 bits a key takes a third less time than
// with digits of 11.
class Digits {
public:
    explicit Digits(std::uint32_t bits_that_differ) {
        while (bits_ < most_digit_bits && bits_that_differ >> (passes * bits_) != 0) ++bits_;
    }
    std::size_t count() const { return std::size_t{1} << bits_; }
    std::size_t of(const MortonKey& key, int pass) const { return key.code >> (pass * bits_) & (count() - 1); }

private:
    int bits_ = 6;
};

std::uint32_t all_bits(const MortonKey* keys, std::uint32_t count) {
    std::uint32_t bits = 0;
    for (std::uint32_t i = 0; i < count; ++i) bits |= keys[i].code;
    return bits;
}

void scatter(const MortonKey* keys, std::uint32_t count, MortonKey* other, const Digits& digits, int pass,
             Places& next) {
    for (std::uint32_t i = 0; i < count; ++i) other[next[digits.of(keys[i], pass)]++] = keys[i];
}

// Counting goes through some thousand digits, however few keys there are.
constexpr std::uint32_t fewest_to_count = 128;

void sort_few(const MortonKey* keys, MortonKey* other, std::uint32_t count) {
    const auto number = [](const MortonKey& key) { return std::uint64_t{key.code} << 32 | key.index; };
    std::copy(keys, keys + count, other);
    std::sort(other, other + count, [&](const MortonKey& a, const MortonKey& b) { return number(a) < number(b); });
}

// The digits of all passes are counted at once: their numbers do not depend on the order.
void sort_alone(MortonKey* keys, MortonKey* other, std::uint32_t count) {
    const Digits digits(all_bits(keys, count));
    Places places[passes];
    for (Places& each : places) std::fill_n(each.begin(), digits.count(), 0);
    for (std::uint32_t i = 0; i < count; ++i) {
        for (int pass = 0; pass < passes; ++pass) ++places[pass][digits.of(keys[i], pass)];
    }
    for (int pass = 0; pass < passes; ++pass) {
        std::uint32_t place = 0;
        for (std::size_t d = 0; d < digits.count(); ++d) {
            const std::uint32_t here = places[pass][d];
            places[pass][d] = place;
            place += here;
        }
        scatter(keys, count, other, digits, pass, places[pass]);
        std::swap(keys, other);
    }
}

// Blocks count their digits, and then each knows where its keys go.
void sort_by_blocks(MortonKey* keys, MortonKey* other, std::uint32_t count, const Parallel& parallel) {
    const std::size_t blocks = (count + radix_sort_block - 1) / radix_sort_block;
    std::vector<Places> places(blocks);
    std::vector<std::uint32_t> bits(blocks);
    const auto for_blocks = [&](const auto& body) {
        parallel.for_each(blocks, [&](std::uint64_t block) {
            const auto begin = static_cast<std::uint32_t>(block * radix_sort_block);
            body(block, keys + begin, std::min(count - begin, radix_sort_block));
        });
    };
    for_blocks(
        [&](std::uint64_t block, const MortonKey* first, std::uint32_t size) { bits[block] = all_bits(first, size); });
    const Digits digits(std::accumulate(bits.begin(), bits.end(), std::uint32_t{0}, std::bit_or<>()));
    for (int pass = 0; pass < passes; ++pass) {
        for_blocks([&](std::uint64_t block, const MortonKey* first, std::uint32_t size) {
            std::fill_n(places[block].begin(), digits.count(), 0);
            for (std::uint32_t i = 0; i < size; ++i) ++places[block][digits.of(first[i], pass)];
        });
        std::uint32_t place = 0;
        for (std::size_t d = 0; d < digits.count(); ++d) {
            for (Places& block : places) {
                const std::uint32_t here = block[d];
                block[d] = place;
                place += here;
            }
        }
        for_blocks([&](std::uint64_t block, const MortonKey* first, std::uint32_t size) {
            scatter(first, size, other, digits, pass, places[block]);
        });
        std::swap(keys, other);
    }
}

} // namespace

void radix_sort(MortonKey* keys, MortonKey* other, std::uint32_t count, const Parallel& parallel) {
    if (count < fewest_to_count) {
        sort_few(keys, other, count);
    } else if (count <= radix_sort_block || parallel.threads() == 1) {
        sort_alone(keys, other, count);
    } else {
        sort_by_blocks(keys, other, count, parallel);
    }
}

} // namespace raywise
