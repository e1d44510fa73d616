#include "oracle/judge.h"

#include "ray/exact_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raywise::oracle {
namespace {

constexpr int no_exponent = std::numeric_limits<int>::max();

// The largest e for which x is an integer multiple of 2^e.
int lowest_bit(double x) {
    if (x == 0.0) return no_exponent;
    int exponent = 0;
    auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
    exponent -= 53;
    while (mantissa % 2 == 0) {
        mantissa /= 2;
        ++exponent;
    }
    return exponent;
}

int lowest_bit(const Vec3& v) { return std::min({lowest_bit(v.x), lowest_bit(v.y), lowest_bit(v.z)}); }

// x * 2^-exponent, which has to be an integer.
Integer scaled(double x, int exponent) {
    if (x == 0.0) return 0;
    int own = 0;
    Integer value = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &own), 53));
    const int shift = own - 53 - exponent;
    if (shift >= 0)
        value <<= static_cast<unsigned>(shift);
    else
        value /= Integer(1) << static_cast<unsigned>(-shift);
    return value;
}

std::array<Integer, 3> scaled(const Vec3& v, int exponent) {
    return {scaled(v.x, exponent), scaled(v.y, exponent), scaled(v.z, exponent)};
}

using Point = std::array<Integer, 3>;

Point cross(const Point& a, const Point& b) {
    return {Integer(a[1] * b[2] - a[2] * b[1]), Integer(a[2] * b[0] - a[0] * b[2]), Integer(a[0] * b[1] - a[1] * b[0])};
}
Integer dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point minus(const Point& a, const Point& b) {
    return {Integer(a[0] - b[0]), Integer(a[1] - b[1]), Integer(a[2] - b[2])};
}

Fraction power_of_two(int exponent) {
    const Integer power = Integer(1) << static_cast<unsigned>(std::abs(exponent));
    return exponent >= 0 ? Fraction(power) : Fraction(Integer(1), power);
}

} // namespace

Fraction exact(double x) {
    if (x == 0.0) return 0;
    const int exponent = lowest_bit(x);
    return Fraction(scaled(x, exponent)) * power_of_two(exponent);
}

Fraction exact_determinant_value(const Vec3& d, const Vec3& o, const Vec3& p, const Vec3& q) {
    const auto difference = [](const Vec3& a, const Vec3& b) {
        return std::array<Fraction, 3>{exact(a.x) - exact(b.x), exact(a.y) - exact(b.y), exact(a.z) - exact(b.z)};
    };
    const auto a = difference(p, o);
    const auto b = difference(q, o);
    return exact(d.x) * (a[1] * b[2] - a[2] * b[1]) + exact(d.y) * (a[2] * b[0] - a[0] * b[2]) +
           exact(d.z) * (a[0] * b[1] - a[1] * b[0]);
}

bool has_no_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    const int exponent = std::min({lowest_bit(a), lowest_bit(b), lowest_bit(c)});
    const Point first = scaled(a, exponent);
    const Point normal = cross(minus(scaled(b, exponent), first), minus(scaled(c, exponent), first));
    return normal[0] == 0 && normal[1] == 0 && normal[2] == 0;
}

bool meets_when_nudged(const Scene& scene, const Ray& ray, std::uint32_t towards, std::uint32_t triangle) {
    using FractionVec = std::array<Fraction, 3>;
    const auto corner = [&](std::uint32_t t, std::size_t i) { return scene.vertices[scene.triangles[t][i]]; };
    // As the ray is traced: components that count as zero are zero.
    const Vec3 d = ExactRay(ray).direction;
    FractionVec inside; // the centroid, seen from the origin: the component along the ray changes nothing
    for (int axis = 0; axis < 3; ++axis) {
        inside[static_cast<std::size_t>(axis)] =
            (exact(corner(towards, 0)[axis]) + exact(corner(towards, 1)[axis]) + exact(corner(towards, 2)[axis])) / 3 -
            exact(ray.origin[axis]);
    }
    const std::array<FractionVec, 4> steps = {inside, FractionVec{1, 0, 0}, FractionVec{0, 1, 0}, FractionVec{0, 0, 1}};
    int first_sign = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 p = corner(triangle, i);
        const Vec3 q = corner(triangle, (i + 1) % 3);
        int sign = exact_determinant_value(d, ray.origin, p, q).sign();
        // The determinant is linear in the origin: its change is that of the edge's moment times the step.
        FractionVec moment;
        for (int axis = 0; axis < 3; ++axis) {
            const int next = (axis + 1) % 3;
            const int last = (axis + 2) % 3;
            moment[static_cast<std::size_t>(axis)] =
                (exact(p[next]) - exact(q[next])) * exact(d[last]) - (exact(p[last]) - exact(q[last])) * exact(d[next]);
        }
        for (const FractionVec& step : steps) {
            if (sign != 0) break;
            sign = Fraction(step[0] * moment[0] + step[1] * moment[1] + step[2] * moment[2]).sign();
        }
        if (first_sign == 0) first_sign = sign;
        if (sign != first_sign) return false;
    }
    return true;
}

Judge::Judge(const Scene& scene) : triangles_(scene.triangles) {
    exponent_ = no_exponent;
    for (const Vec3& v : scene.vertices) exponent_ = std::min(exponent_, lowest_bit(v));
    if (exponent_ == no_exponent) exponent_ = 0;
    vertices_.reserve(scene.vertices.size());
    for (const Vec3& v : scene.vertices) vertices_.push_back(scaled(v, exponent_));
}

std::vector<ExactHit> Judge::line_hits(const Ray& ray) const {
    const int origin_bit = lowest_bit(ray.origin);
    const int unit = std::min(exponent_, origin_bit);
    const int direction_unit = lowest_bit(ray.direction);
    const Point origin = scaled(ray.origin, unit);
    const Point direction = scaled(ray.direction, direction_unit);
    const auto shift = static_cast<unsigned>(exponent_ - unit);

    // Seen from the origin, and its moment d x p: the determinant of an edge is one product of those.
    std::vector<Point> relative(vertices_.size());
    std::vector<Point> moment(vertices_.size());
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) relative[i][axis] = (vertices_[i][axis] << shift) - origin[axis];
        moment[i] = cross(direction, relative[i]);
    }

    std::vector<ExactHit> hits;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const auto [a, b, c] = triangles_[i];
        const Integer wa = dot(moment[b], relative[c]);
        const Integer wb = dot(moment[c], relative[a]);
        if (wa.sign() * wb.sign() < 0) continue;
        const Integer wc = dot(moment[a], relative[b]);
        if (wa.sign() * wc.sign() < 0 || wb.sign() * wc.sign() < 0) continue;
        const Integer sum = wa + wb + wc; // direction . normal
        if (sum == 0) continue;
        const Point normal = cross(minus(relative[b], relative[a]), minus(relative[c], relative[a]));
        const Fraction t = Fraction(dot(relative[a], normal), sum) * power_of_two(unit - direction_unit);
        hits.push_back({static_cast<std::uint32_t>(i), t, Fraction(wb, sum), Fraction(wc, sum)});
    }
    std::sort(hits.begin(), hits.end(), [](const ExactHit& x, const ExactHit& y) {
        return x.t < y.t || (x.t == y.t && x.primitive < y.primitive);
    });
    return hits;
}

} // namespace raywise::oracle
