// A number for each ray, by which many are put in order: rays with near numbers run through the same part of the scene in about the same
// direction.
#pragma once

#include "base/box.h"
#include "ray/ray.h"

#include <cstddef>
#include <cstdint>

namespace raywise {

class RayKeys {
public:
    // From the least significant bits: where the ray points within its octant, the cell in which it enters the scene (interleaved, so
    // that near cells have near keys), and the octant. More bits bring nothing (docs/decisions/0014).
    static constexpr int direction_bits = 3; // on each of two axes
    static constexpr int cell_bits = 5;      // on each of three
    static constexpr int bits = 2 * direction_bits + 3 * cell_bits + 3;

    // Keys are had for so many rays at a time.
    static constexpr std::size_t most = 256;

    // bounds: of the scene.
    explicit RayKeys(const Box& bounds);

    // The keys of the first n of the rays; rays and keys beyond may be read and written. Any ray has a key.
    void of(const Ray (&rays)[most], std::size_t n, std::uint32_t (&keys)[most]) const;
    void of(const RayF (&rays)[most], std::size_t n, std::uint32_t (&keys)[most]) const;
    // Whether two keys are of the same cell and octant.
    static bool is_near(std::uint32_t a, std::uint32_t b) { return (a ^ b) >> 2 * direction_bits == 0; }

    // The scene: what is at p lies in the cells (p - lower) * cells_per_unit.
    const Vec3& lower() const { return lower_; }
    const Vec3& cells_per_unit() const { return cells_per_unit_; }

private:
    Vec3 lower_;
    Vec3 cells_per_unit_; // 0 where the scene is flat
};

} // namespace raywise
