// For each of many boxes in a row, the one nearby that makes the smallest box with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace raywise {

// How far along the row is looked, in both directions. Of 8 and 16 the larger was no better; see
// docs/decisions/0011-bvh-builders.md.
inline constexpr std::ptrdiff_t nearest_radius = 4;

// Boxes side by side, each coordinate in an array of its own, and room for what the search finds.
class NearestBoxes {
public:
    explicit NearestBoxes(std::size_t capacity);

    // plane 0 to 2: the lower corner, negated; 3 to 5: the upper. Overflow and underflow of areas is up to the caller.
    float* plane(int plane) { return planes_.get() + static_cast<std::size_t>(plane) * stride_ + padding; }

    // Fills offset() for the first `count` boxes: what to add to a box's index for the index of its nearest. Of equally
    // good ones the nearest along the row, and of its two neighbours the one that pairs an even index with the odd one
    // above: with one box many times over, all find a partner. 0: there is none, or the areas overflow.
    void search(std::size_t count);
    std::int32_t offset(std::size_t i) const { return offsets_[i]; }

    // Used by the search of each instruction set.
    static constexpr std::size_t padding = 64; // more than nearest_radius and the widest vector
    const float* plane(int plane) const { return const_cast<NearestBoxes*>(this)->plane(plane); }
    float* distances(std::ptrdiff_t step) { // between boxes i and i + step; step from 1 on
        return distances_.get() + static_cast<std::size_t>(step - 1) * stride_ + padding;
    }
    std::int32_t* offsets() { return offsets_.get(); }

private:
    std::size_t stride_;
    std::unique_ptr<float[]> planes_;
    std::unique_ptr<float[]> distances_;
    std::unique_ptr<std::int32_t[]> offsets_;
};

} // namespace raywise
