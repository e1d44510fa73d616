// Polygons on a grid for tests, and what is to be said of them without any rounding.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

namespace raywise {

template <class Number>
using PlanePoint = std::array<Number, 2>;

template <class Number>
using PlanePolygon = std::vector<PlanePoint<Number>>;

using GridPoint = PlanePoint<std::int64_t>;
using GridPolygon = PlanePolygon<std::int64_t>;

// Twice the signed area of a triangle.
template <class Number>
Number doubled_area(const PlanePoint<Number>& a, const PlanePoint<Number>& b, const PlanePoint<Number>& c) {
    const Number left = (b[0] - a[0]) * (c[1] - a[1]);
    const Number right = (b[1] - a[1]) * (c[0] - a[0]);
    return left - right;
}

template <class Number>
Number doubled_area(const PlanePolygon<Number>& polygon) {
    Number sum = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i) sum += doubled_area(polygon[0], polygon[i - 1], polygon[i]);
    return sum;
}

template <class Number>
int sign_of(const Number& x) {
    return x > 0 ? 1 : x < 0 ? -1 : 0;
}

// Whether p lies on the segment, its ends included.
template <class Number>
bool is_on_segment(const PlanePoint<Number>& p, const PlanePoint<Number>& a, const PlanePoint<Number>& b) {
    if (doubled_area(a, b, p) != 0) return false;
    return std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) && std::min(a[1], b[1]) <= p[1] &&
           p[1] <= std::max(a[1], b[1]);
}

template <class Number>
bool segments_meet(const PlanePoint<Number>& a, const PlanePoint<Number>& b, const PlanePoint<Number>& c,
                   const PlanePoint<Number>& d) {
    if (is_on_segment(a, c, d) || is_on_segment(b, c, d) || is_on_segment(c, a, b) || is_on_segment(d, a, b))
        return true;
    return sign_of(doubled_area(a, b, c)) * sign_of(doubled_area(a, b, d)) < 0 &&
           sign_of(doubled_area(c, d, a)) * sign_of(doubled_area(c, d, b)) < 0;
}

// Whether edges meet at the corner they share and nowhere else.
template <class Number>
bool is_simple(const PlanePolygon<Number>& p) {
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i) {
        const auto& a = p[i];
        const auto& b = p[(i + 1) % n];
        const auto& c = p[(i + 2) % n];
        if (a == b || is_on_segment(a, b, c) || is_on_segment(c, a, b)) return false;
        for (std::size_t j = i + 2; j < n; ++j) {
            if ((j + 1) % n != i && segments_meet(a, b, p[j], p[(j + 1) % n])) return false;
        }
    }
    return true;
}

// How often a polygon winds around a point that is on none of its edges.
template <class Number>
int winding_number(const PlanePolygon<Number>& polygon, const PlanePoint<Number>& p) {
    int winding = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto& a = polygon[i];
        const auto& b = polygon[(i + 1) % polygon.size()];
        if ((a[1] <= p[1]) == (b[1] <= p[1])) continue;
        const int rises = a[1] <= p[1] ? 1 : -1;
        if (sign_of(doubled_area(a, b, p)) == rises) winding += rises;
    }
    return winding;
}

template <class Number>
bool is_on_outline(const PlanePolygon<Number>& polygon, const PlanePoint<Number>& p) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        if (is_on_segment(p, polygon[i], polygon[(i + 1) % polygon.size()])) return true;
    }
    return false;
}

// Deterministic choices on every platform.
class Choices {
public:
    explicit Choices(std::uint64_t seed) : random_(seed) {}
    std::int64_t below(std::int64_t count) {
        return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(count));
    }
    template <class T>
    const T& one_of(const std::vector<T>& values) {
        return values[static_cast<std::size_t>(below(static_cast<std::int64_t>(values.size())))];
    }

private:
    std::mt19937_64 random_;
};

// All counterclockwise.

// Random corners of a size * size grid, joined by a tour whose crossings are taken out; empty where that fails.
GridPolygon random_simple_polygon(std::size_t corners, std::int64_t size, Choices& choices);
// One corner in each of so many directions.
GridPolygon random_star(std::size_t corners, Choices& choices);
GridPolygon comb(std::int64_t teeth);
GridPolygon spiral(std::int64_t windings);

// The outline of triangles of a grid that hang together in a tree, each joined to another by an edge. It touches itself at
// corners, and comes back along an edge where two triangles are neighbours but not joined. antennas: that many bent lines there
// and back, inside and outside.
GridPolygon outline_of_tree(std::size_t triangles, std::int64_t size, std::size_t antennas, Choices& choices);
// Two such outlines, joined by a line with bends there and back.
GridPolygon dumbbell(std::size_t triangles, Choices& choices);

// Takes some of the corners out that are between their neighbours, so that others touch the sides of what is left.
void remove_straight_corners(GridPolygon& polygon, Choices& choices);
// Repeats some corners.
void repeat_corners(GridPolygon& polygon, std::int64_t count, Choices& choices);

} // namespace raywise
