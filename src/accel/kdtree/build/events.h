// Where boxes begin and end along an axis, in the order of a sweep (Wald and Havran 2006, section 4.3).
#pragma once

#include "accel/bvh/build/bounds.h"
#include "base/page_array.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace raywise {

// Where a primitive's box ends, lies flat or begins. One number, so that sorting and merging compare nothing else: 32 bits of position, 2 of
// kind, 30 of the primitive's number within the subtree being built.
class KdEvent {
public:
    enum Kind : std::uint64_t {
        ends = 0,
        lies = 1,
        begins = 2
    }; // in the order of a sweep

    KdEvent() = default;
    KdEvent(float position, Kind kind, std::uint32_t number)
        : bits_(std::uint64_t{ordered_bits(position)} << 32 | kind << 30 | number) {}

    bool operator<(const KdEvent& other) const { return bits_ < other.bits_; }
    std::uint64_t key() const { return bits_ >> 30; } // position and kind
    Kind kind() const { return static_cast<Kind>(bits_ >> 30 & 3u); }
    std::uint32_t number() const { return static_cast<std::uint32_t>(bits_) & 0x3FFFFFFFu; }
    float position() const {
        const auto ordered = static_cast<std::uint32_t>(bits_ >> 32);
        const std::uint32_t bits = (ordered & 0x80000000u) != 0 ? ordered & 0x7FFFFFFFu : ~ordered;
        float f;
        std::memcpy(&f, &bits, sizeof f);
        return f;
    }

private:
    // Unsigned numbers in the order of the floats.
    static std::uint32_t ordered_bits(float f) {
        f += 0.0f; // no negative zero
        std::uint32_t bits;
        std::memcpy(&bits, &f, sizeof bits);
        return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
    }

    std::uint64_t bits_ = 0;
};

using KdEventLists = std::array<PageVector<KdEvent>, 3>; // one for each axis

void add_events(KdEventLists& lists, const Bounds& box, std::uint32_t number);

// By position and kind; equal ones keep their order. scratch: any.
void sort_events(PageVector<KdEvent>& events, PageVector<KdEvent>& scratch);

} // namespace raywise
