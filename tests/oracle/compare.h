// Linear scan against the judge, and every structure against the linear scan.
#pragma once

#include "accel/accel.h"
#include "oracle/rays.h"
#include "oracle/scenes.h"

#include <cstdint>
#include <string>
#include <vector>

namespace raywise::oracle {

// How far u and v may lie from the exact weights.
inline constexpr double uv_bound = 0x1p-30;

// What a comparison found; empty `faults` means agreement.
struct Comparison {
    std::uint64_t rays = 0;
    std::uint64_t tests = 0; // rays times triangles
    std::uint64_t hits = 0;
    double worst_t = 0.0;  // largest error of t, in units of the bound
    double worst_uv = 0.0; // largest error of u or v
    std::vector<std::string> faults;

    void add(const Comparison& other);
    std::string text() const; // the first faults, for a failed assertion
};

// Which triangles are hit has to agree exactly, except where the exact t lies within the bound of an end of the
// interval; t has to lie within 2^-37 of the distance between the ray's origin and the farthest corner of the scene, u and v within uv_bound, and the order of two hits may differ
// only where their exact t differ by less than the bound.
Comparison compare_with_judge(const Scene& scene, const std::vector<Ray>& rays);

// Closest, any and all of a structure against the linear scan's, bit for bit.
Comparison compare_with_linear_scan(Structure structure, const Scene& scene, const std::vector<Ray>& rays,
                                    const std::optional<ViewFrame>& view = std::nullopt);

std::string describe(const Ray& ray);

} // namespace raywise::oracle
