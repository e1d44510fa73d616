#include "accel/kdtree/build/events.h"

#include <algorithm>
#include <cstddef>

namespace raywise {
namespace {

// Digits of the keys, the lowest first: 2 bits of kind and 32 of position.
constexpr unsigned digit_bits = 9;
constexpr unsigned key_bits = 34;
constexpr std::size_t digits = (key_bits + digit_bits - 1) / digit_bits;
constexpr std::size_t digit_values = std::size_t{1} << digit_bits;

std::size_t digit_of(KdEvent event, std::size_t digit) {
    return event.key() >> digit * digit_bits & (digit_values - 1);
}

// Fewer are sorted by comparisons.
constexpr std::size_t fewest_to_count = 64;

} // namespace

void add_events(KdEventLists& lists, const Bounds& box, std::uint32_t number) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float lower = box.lower[axis];
        const float upper = box.upper[axis];
        if (lower == upper) {
            lists[axis].emplace_back(lower, KdEvent::lies, number);
        } else {
            lists[axis].emplace_back(lower, KdEvent::begins, number);
            lists[axis].emplace_back(upper, KdEvent::ends, number);
        }
    }
}

void sort_events(PageVector<KdEvent>& events, PageVector<KdEvent>& scratch) {
    if (events.size() < fewest_to_count) {
        std::sort(events.begin(), events.end());
        return;
    }
    scratch.resize(events.size());
    std::uint32_t places[digits][digit_values] = {};
    for (const KdEvent event : events) {
        for (std::size_t digit = 0; digit < digits; ++digit) ++places[digit][digit_of(event, digit)];
    }
    for (std::size_t digit = 0; digit < digits; ++digit) {
        // Events of a small cell have the same exponent, and the same first digits.
        if (places[digit][digit_of(events.front(), digit)] == events.size()) continue;
        std::uint32_t begin = 0;
        for (std::uint32_t& place : places[digit]) {
            const std::uint32_t count = place;
            place = begin;
            begin += count;
        }
        for (const KdEvent event : events) scratch[places[digit][digit_of(event, digit)]++] = event;
        events.swap(scratch);
    }
}

} // namespace raywise
