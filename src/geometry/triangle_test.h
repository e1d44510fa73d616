// The one ray-triangle test. Every structure, entry point and precision ends here; it decides what is hit.
//
// Whether the ray's line passes through the triangle is decided by the signs of three determinants, one for each edge,
// and those signs are those of exact arithmetic on the numbers given. Two triangles that share an edge look at the same
// determinant with the opposite sign, so no ray slips between them (Woop, Benthin, Wald 2013, "Watertight Ray/Triangle
// Intersection", asks the same of float32 and retries in float64 at zero). Points on an edge or a corner belong to the triangle.
//
// Almost always float64 settles the signs: the corners are sheared so that the ray runs along its major axis (the first
// steps of Woop et al.), which makes the determinants two-dimensional and their error small and known. Only what lies
// within that error of zero goes to exact_weights.
//
// A triangle without area, and one the ray lies in the plane of, has determinants that add up to exactly zero: it
// cannot be hit. No epsilon is used anywhere.
#pragma once

#include "base/vec.h"
#include "geometry/exact.h"
#include "ray/exact_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raywise {

// What the test computes. u and v are the weights of the second and third corner, and lie within 2^-30 of the exact ones; for
// triangles that are not tiny against their distance they are good to nearly all bits.
struct TriangleHit {
    double t; // in the caller's unit
    double u;
    double v;
};

namespace triangle_test_detail {

// A corner in the ray's frame: x and y across the ray after shearing, z along its major axis.
struct Sheared {
    double x;
    double y;
    double z;
};

inline Sheared shear(const ExactRay& ray, const Vec3& corner) {
    const double z = at(corner, ray.major_axis) - ray.axis_origin.z;
    return {(at(corner, ray.x_axis) - ray.axis_origin.x) - ray.shear_x * z,
            (at(corner, ray.y_axis) - ray.axis_origin.y) - ray.shear_y * z, z};
}

// Twice the area of the origin with p and q.
inline double edge(const Sheared& p, const Sheared& q) { return p.x * q.y - p.y * q.x; }

inline double largest_component(const Vec3& v) {
    return std::max(std::max(std::fabs(v.x), std::fabs(v.y)), std::fabs(v.z));
}

// The edges in float64. wa is the weight of corner a: the edge opposite to it, and so on.
struct Edges {
    double wa;
    double wb;
    double wc;
};

// z of a hit that lies within z_error of the ray's origin, with the sign that exact arithmetic gives it: a ray that starts on a
// triangle hits it at 0, one that starts beyond it, by however little, does not hit it again. backwards: whether the edges add up
// to less than zero.
double z_near_origin(const ExactRay& ray, const Vec3& a, const Vec3& b, const Vec3& c, bool backwards, double z,
                     double z_error);

// The test of a triangle that may be hit, or is so close to the ray or so small that its miss is not certain at first sight.
inline bool test_closely(const ExactRay& ray, const Vec3& a, const Vec3& b, const Vec3& c, const Sheared& sa,
                         const Sheared& sb, const Sheared& sc, const Edges& edges, TriangleHit& hit) {
    auto [wa, wb, wc] = edges;
    const Vec3 pa = a - ray.origin;
    const Vec3 pb = b - ray.origin;
    const Vec3 pc = c - ray.origin;

    // The error of an edge value. |shear_x| <= 1, and each of the few operations behind a sheared coordinate rounds by at most
    // 2^-53 of the largest relative coordinate: 8 of them are more than enough. An edge multiplies two such coordinates, whose
    // magnitudes are below `reach`, and rounds three times.
    const double largest = std::max(std::max(largest_component(pa), largest_component(pb)), largest_component(pc));
    const double reach =
        std::fabs(sa.x) + std::fabs(sa.y) + std::fabs(sb.x) + std::fabs(sb.y) + std::fabs(sc.x) + std::fabs(sc.y);
    const double shear_error = 0x1p-50 * largest;
    const double error = 1.01 * shear_error * (reach + 2.0 * shear_error) + 0x1p-51 * reach * reach;

    // Certainly of different signs: a miss. Products of extreme coordinates leave the range in which the bound holds.
    const bool in_range = largest > 0x1p-400 && largest < 0x1p400;
    if (in_range && std::max(std::max(wa, wb), wc) > error && std::min(std::min(wa, wb), wc) < -error) return false;

    const double z_low = std::min(std::min(sa.z, sb.z), sc.z);
    const double z_high = std::max(std::max(sa.z, sb.z), sc.z);
    const bool signs_certain = std::min(std::min(std::fabs(wa), std::fabs(wb)), std::fabs(wc)) > error;
    // The weights' relative error is that of u and v, which are to be good to 2^-30. t is a mean of the corners' z by these
    // weights: its error is theirs times the triangle's extent in z, and has to stay below the margin that traversal leaves.
    const double weight_error = 3.0 * error;
    const double area = std::fabs(wa + wb + wc);
    const bool weights_certain =
        weight_error * 0x1p30 <= area && weight_error * (z_high - z_low) * 0x1p40 <= area * largest;
    if (!in_range || !signs_certain || !weights_certain) {
        Weights exact;
        if (!exact_weights(ray.origin, ray.direction, a, b, c, exact)) return false;
        // The edges above are these determinants divided by the direction's largest component.
        const double sign = std::copysign(1.0, ray.inverse_major);
        wa = sign * exact.a;
        wb = sign * exact.b;
        wc = sign * exact.c;
    }
    const double sum = wa + wb + wc;
    const double u = wb / sum;
    const double v = wc / sum;
    double z = std::clamp(sa.z + (u * (sb.z - sa.z) + v * (sc.z - sa.z)), z_low, z_high);
    const double z_error = 0x1p-38 * largest;
    // Where the ray's interval begins beyond z_error the hit is not in it either way, and need not be told from one at the start.
    if (z_low <= 0.0 && z_high >= 0.0 && std::fabs(z) <= z_error && ray.scaled_tmin <= 2.0 * z_error)
        z = z_near_origin(ray, a, b, c, sum < 0.0, z, z_error);
    hit.t = ray.caller_t(z * ray.inverse_major);
    hit.u = u + 0.0; // never a negative zero
    hit.v = v + 0.0;
    return true;
}

} // namespace triangle_test_detail

// a, b, c: corners. Returns whether the line of the ray hits the triangle, in front of the origin or behind it; the caller compares
// hit.t with its interval.
inline bool test_triangle(const ExactRay& ray, const Vec3& a, const Vec3& b, const Vec3& c, TriangleHit& hit) {
    using namespace triangle_test_detail;
    const Sheared sa = shear(ray, a);
    const Sheared sb = shear(ray, b);
    const Sheared sc = shear(ray, c);
    return test_closely(ray, a, b, c, sa, sb, sc, {edge(sb, sc), edge(sc, sa), edge(sa, sb)}, hit);
}

// What tells most misses at first sight: an edge value beyond it has the right sign, whatever the triangle, as long as no corner is
// farther than `distance` from the ray's origin along any axis. It is the bound of test_closely for such corners: `reach` there is at most
// 12 R (1 + 2^-49) with R the distance, since a sheared coordinate is at most 2 R (1 + 2^-50); so `error` is below (12.2 + 72.1) * 2^-50
// R^2. Infinite where products of coordinates might leave the range of float64.
inline double certain_edge(double distance) {
    return distance > 0x1p-370 && distance < 0x1p400 ? 0x1p-43 * distance * distance
                                                     : std::numeric_limits<double>::infinity();
}

} // namespace raywise
