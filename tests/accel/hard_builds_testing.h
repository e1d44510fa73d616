// Scenes that break builders.
#pragma once

#include "accel/bvh_testing.h"

#include <cmath>

namespace raywise::bvh_testing {

inline Triangles copies(std::size_t count) {
    return Triangles(count, {Vec3(0.0), Vec3(1.0, 0.0, 0.5), Vec3(0.0, 1.0, 0.5)});
}

// Every triangle around the same centroid of its box, each a little larger than the one before.
inline Triangles one_centroid(std::size_t count) {
    Triangles triangles;
    for (std::size_t i = 1; i <= count; ++i) {
        const double r = static_cast<double>(i);
        triangles.push_back({Vec3(-r, -r, -r), Vec3(r, -r, r), Vec3(-r, r, 0.0)});
    }
    return triangles;
}

inline Triangles one_huge_many_tiny(std::size_t count) {
    Triangles triangles = soup(count, 0.002, 21, 1e-4, Vec3(3.0, 2.0, 1.0));
    triangles.insert(triangles.begin() + static_cast<std::ptrdiff_t>(count / 2),
                     {Vec3(-1e6, -1e6, 0.5), Vec3(1e6, -1e6, 0.5), Vec3(0.0, 1e6, 0.5)});
    return triangles;
}

// Next to each other on a line, long and thin, and each wider than the one before: every triangle's nearest is the same
// side's, so that clusters hardly form.
inline Triangles collinear_slivers(std::size_t count) {
    Triangles triangles;
    double x = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double width = 1e-3 * (1.0 + static_cast<double>(i) / static_cast<double>(count));
        triangles.push_back({Vec3(x, 0.0, 0.0), Vec3(x + width, 0.0, 1e-6), Vec3(x + 0.5 * width, 1e-6, 0.0)});
        x += width;
    }
    return triangles;
}

// Each half as large and half as far as the one before.
inline Triangles geometric_series(int count) {
    Triangles triangles;
    for (int i = 0; i < count; ++i) {
        const double scale = std::ldexp(1e30, -(i % 200));
        triangles.push_back({scale * Vec3(1.0, 0.0, 0.1), scale * Vec3(1.0, 0.1, 0.0), scale * Vec3(1.1, 0.0, 0.0)});
    }
    return triangles;
}

// Hills, n by n squares of side 1 around `corner`.
inline Triangles hills(int n, const Vec3& corner) {
    const auto point = [&](int x, int y) { return corner + Vec3(x, y, 4.0 * std::sin(0.3 * x) * std::cos(0.2 * y)); };
    Triangles triangles;
    for (int x = 0; x < n; ++x) {
        for (int y = 0; y < n; ++y) {
            triangles.push_back({point(x, y), point(x + 1, y), point(x, y + 1)});
            triangles.push_back({point(x + 1, y), point(x + 1, y + 1), point(x, y + 1)});
        }
    }
    return triangles;
}

} // namespace raywise::bvh_testing
