// The judge: ray against triangles in integers and fractions of any length, so nothing is ever rounded.
//
// It shares no code with the library: the numbers of scene and ray are scaled by powers of two until all are integers,
// and the sign of each edge's determinant is simply computed.
#pragma once

#include "oracle/scenes.h"
#include "ray/ray.h"

#include <boost/multiprecision/gmp.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace raywise::oracle {

using Integer = boost::multiprecision::mpz_int;
using Fraction = boost::multiprecision::mpq_rational;

struct ExactHit {
    std::uint32_t primitive;
    Fraction t; // in units of the ray's direction, as the caller counts
    Fraction u;
    Fraction v;
};

// The exact value of a finite double.
Fraction exact(double x);

// d . ((p - o) x (q - o))
Fraction exact_determinant_value(const Vec3& d, const Vec3& o, const Vec3& p, const Vec3& q);

// Whether a ray still meets `triangle`, which it touches, when its origin moves by an infinitesimal step towards the inside of
// `towards`, a far smaller one along x, a smaller one again along y, then z. (No code shared with geometry/crossings.)
bool meets_when_nudged(const Scene& scene, const Ray& ray, std::uint32_t towards, std::uint32_t triangle);

// Whether the corners lie in one line.
bool has_no_area(const Vec3& a, const Vec3& b, const Vec3& c);

class Judge {
public:
    explicit Judge(const Scene& scene);

    // Every triangle the ray's line meets, in front of the origin or behind it, in the order of t, then of the number.
    // Edges and corners belong to a triangle; a triangle without area, or parallel to the ray, is not met.
    // Origin and direction have to be finite.
    std::vector<ExactHit> line_hits(const Ray& ray) const;

private:
    using Point = std::array<Integer, 3>;

    std::vector<Point> vertices_; // times 2^-exponent_
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    int exponent_ = 0;
};

} // namespace raywise::oracle
