// The triangle test for many rays, each with a triangle of its own, several at once in vector registers.
//
// It takes the steps of PreparedRay and of triangle_test.h as long as float64 settles everything, by the same operations in the same
// order, so that its hits have the same bits. What needs more is left to the test for one ray.
#pragma once

#include "base/ray.h"
#include "geometry/triangle_mesh.h"

#include <cstddef>
#include <cstdint>

namespace raywise {

class TriangleTests {
public:
    static constexpr std::size_t most = 32;

    enum class Answer : std::uint8_t {
        misses,
        hits,   // within the ray's interval
        unknown // ask Primitives::test_corners
    };

    bool is_full() const { return size_ == most; }
    std::size_t size() const { return size_; }

    // ray: traceable.
    void add(const Ray& ray, const Corners& corners) {
        const std::size_t k = size_++;
        const int z = MajorAxis(ray.direction).axis;
        const int x = z == 2 ? 0 : z + 1;
        const int y = x == 2 ? 0 : x + 1;
        const int axes[3] = {x, y, z};
        for (int axis = 0; axis < 3; ++axis) {
            lanes_.origin[axis][k] = at(ray.origin, axes[axis]);
            lanes_.direction[axis][k] = at(ray.direction, axes[axis]);
            for (std::size_t corner = 0; corner < 3; ++corner)
                lanes_.corner[corner][axis][k] = at(corners[corner], axes[axis]);
        }
        lanes_.tmin[k] = ray.tmin;
        lanes_.tmax[k] = ray.tmax;
    }
    void clear() { size_ = 0; }

    // Answers all that were added.
    void run();
    Answer answer(std::size_t k) const { return static_cast<Answer>(lanes_.answer[k]); }
    // Of a hit, as TriangleHit.
    double t(std::size_t k) const { return lanes_.t[k]; }
    double u(std::size_t k) const { return lanes_.u[k]; }
    double v(std::size_t k) const { return lanes_.v[k]; }

    // Axes are x, y, z of each ray as of PreparedRay: z its major axis.
    struct alignas(64) Lanes {
        double origin[3][most];
        double direction[3][most];
        double corner[3][3][most]; // corner, axis
        double tmin[most];
        double tmax[most];

        double t[most];
        double u[most];
        double v[most];
        std::int64_t answer[most];
    };

private:
    Lanes lanes_{}; // those beyond the last are tested along, and hold numbers
    std::size_t size_ = 0;
};

} // namespace raywise
