#include "geometry/plane_polygons.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace raywise {
namespace {

// Apart from each other, so that there is room between.
constexpr std::int64_t grid_step = 12;

GridPoint operator+(const GridPoint& a, const GridPoint& b) { return {a[0] + b[0], a[1] + b[1]}; }

void make_counterclockwise(GridPolygon& polygon) {
    if (doubled_area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
}

// Triangles of a grid, each square cut along one diagonal.
struct GridTriangle {
    GridPoint corners[3]; // counterclockwise

    GridPoint inner_point(std::int64_t a, std::int64_t b, std::int64_t c) const { // a + b + c is grid_step
        GridPoint sum{};
        for (std::size_t axis = 0; axis < 2; ++axis) {
            sum[axis] = (a * corners[0][axis] + b * corners[1][axis] + c * corners[2][axis]) / grid_step;
        }
        return sum;
    }
};

std::vector<GridTriangle> grid_triangles(std::int64_t size, Choices& choices) {
    std::vector<GridTriangle> triangles;
    for (std::int64_t x = 0; x < size; ++x) {
        for (std::int64_t y = 0; y < size; ++y) {
            const std::int64_t s = grid_step;
            const GridPoint a{x * s, y * s};
            const GridPoint b = a + GridPoint{s, 0};
            const GridPoint c = a + GridPoint{s, s};
            const GridPoint d = a + GridPoint{0, s};
            if (choices.below(2) == 0) {
                triangles.push_back({{a, b, c}});
                triangles.push_back({{a, c, d}});
            } else {
                triangles.push_back({{a, b, d}});
                triangles.push_back({{b, c, d}});
            }
        }
    }
    return triangles;
}

// The triangle on the left of an edge, or nullptr.
const GridTriangle* triangle_left_of(const std::vector<GridTriangle>& triangles, const GridPoint& a,
                                     const GridPoint& b) {
    for (const GridTriangle& triangle : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (triangle.corners[i] == a && triangle.corners[(i + 1) % 3] == b) return &triangle;
        }
    }
    return nullptr;
}

const GridPoint& third_corner(const GridTriangle& triangle, const GridPoint& a, const GridPoint& b) {
    return *std::find_if(std::begin(triangle.corners), std::end(triangle.corners),
                         [&](const GridPoint& p) { return p != a && p != b; });
}

} // namespace

GridPolygon random_simple_polygon(std::size_t corners, std::int64_t size, Choices& choices) {
    std::set<GridPoint> chosen;
    while (chosen.size() < corners) chosen.insert({choices.below(size), choices.below(size)});
    GridPolygon polygon(chosen.begin(), chosen.end());
    for (std::size_t i = corners - 1; i > 0; --i) {
        std::swap(polygon[i], polygon[static_cast<std::size_t>(choices.below(static_cast<std::int64_t>(i + 1)))]);
    }
    for (int rounds = 0; rounds < 300; ++rounds) {
        if (is_simple(polygon)) {
            make_counterclockwise(polygon);
            return polygon;
        }
        for (std::size_t i = 0; i < corners; ++i) {
            for (std::size_t j = i + 2; j < corners; ++j) {
                if ((j + 1) % corners == i) continue;
                if (segments_meet(polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % corners])) {
                    std::reverse(polygon.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                 polygon.begin() + static_cast<std::ptrdiff_t>(j) + 1);
                }
            }
        }
    }
    return {};
}

GridPolygon random_star(std::size_t corners, Choices& choices) {
    GridPolygon polygon;
    for (std::size_t i = 0; i < corners; ++i) {
        const double angle = 2.0 * 3.14159265358979 * static_cast<double>(i) / static_cast<double>(corners);
        const auto radius = static_cast<double>(100000 + choices.below(1000000));
        polygon.push_back({std::llround(radius * std::cos(angle)), std::llround(radius * std::sin(angle))});
    }
    return polygon;
}

GridPolygon comb(std::int64_t teeth) {
    GridPolygon polygon{{2 * teeth, -1}, {2 * teeth, 10}};
    for (std::int64_t i = teeth - 1; i >= 0; --i) {
        polygon.push_back({2 * i + 1, 10});
        polygon.push_back({2 * i + 1, 0});
        polygon.push_back({2 * i, 0});
        polygon.push_back({2 * i, 10});
    }
    polygon.push_back({-1, 10});
    polygon.push_back({-1, -1});
    return polygon;
}

// A corridor one wide that winds inwards, with walls one wide.
GridPolygon spiral(std::int64_t windings) {
    constexpr GridPoint directions[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    GridPolygon outer{{0, 0}};
    GridPolygon inner{{0, 1}};
    for (std::int64_t i = 0; i < 4 * windings; ++i) {
        const std::int64_t length = 4 * windings + 3 - (i > 0 ? (i - 1) / 2 * 2 : 0);
        const GridPoint& d = directions[i % 4];
        const GridPoint& last = outer.back();
        outer.push_back({last[0] + d[0] * length, last[1] + d[1] * length});
        // Beside the outer one, to the left: inside the turn.
        const GridPoint& n = directions[(i + 1) % 4];
        inner.push_back(outer.back() + GridPoint{n[0] - d[0], n[1] - d[1]});
    }
    outer.insert(outer.end(), inner.rbegin(), inner.rend());
    return outer;
}

GridPolygon outline_of_tree(std::size_t triangles, std::int64_t size, std::size_t antennas, Choices& choices) {
    const std::vector<GridTriangle> all = grid_triangles(size, choices);
    const GridTriangle& first = choices.one_of(all);
    std::vector<const GridTriangle*> taken{&first};
    GridPolygon polygon(std::begin(first.corners), std::end(first.corners));
    const auto is_taken = [&](const GridTriangle* t) {
        return std::find(taken.begin(), taken.end(), t) != taken.end();
    };
    for (std::size_t tries = 0; taken.size() < triangles && tries < 100 * triangles; ++tries) {
        const auto i = static_cast<std::size_t>(choices.below(static_cast<std::int64_t>(polygon.size())));
        const GridPoint& a = polygon[i];
        const GridPoint& b = polygon[(i + 1) % polygon.size()];
        const GridTriangle* beyond = triangle_left_of(all, b, a);
        if (beyond == nullptr || is_taken(beyond)) continue;
        taken.push_back(beyond);
        polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(i) + 1, third_corner(*beyond, a, b));
    }
    std::set<const GridTriangle*> with_antenna;
    for (std::size_t tries = 0; with_antenna.size() < antennas && tries < 100 * antennas; ++tries) {
        const auto i = static_cast<std::size_t>(choices.below(static_cast<std::int64_t>(polygon.size())));
        const GridPoint a = polygon[i];
        const GridPoint b = polygon[(i + 1) % polygon.size()];
        const bool inside = choices.below(2) == 0;
        const GridTriangle* triangle = inside ? triangle_left_of(all, a, b) : triangle_left_of(all, b, a);
        if (triangle == nullptr || is_taken(triangle) != inside || !with_antenna.insert(triangle).second) continue;
        const GridPoint bend = triangle->inner_point(4, 4, 4);
        const GridPoint end = choices.one_of<GridPoint>(
            {triangle->inner_point(2, 5, 5), triangle->inner_point(5, 2, 5), triangle->inner_point(5, 5, 2)});
        const GridPolygon antenna{bend, end, bend, a};
        polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(i) + 1, antenna.begin(), antenna.end());
    }
    return polygon;
}

GridPolygon dumbbell(std::size_t triangles, Choices& choices) {
    GridPolygon left;
    GridPolygon right;
    // The line must not begin in a wedge between two others.
    do {
        left = outline_of_tree(triangles, 4, 0, choices);
        std::rotate(left.begin(), std::max_element(left.begin(), left.end()), left.end());
    } while (std::count(left.begin(), left.end(), left[0]) > 1);
    do {
        right = outline_of_tree(triangles, 4, 0, choices);
        std::rotate(right.begin(), std::min_element(right.begin(), right.end()), right.end());
    } while (std::count(right.begin(), right.end(), right[0]) > 1);
    for (GridPoint& p : right) p[0] += 8 * grid_step;
    GridPolygon line;
    const std::int64_t bends = choices.below(4);
    for (std::int64_t i = 1; i <= bends; ++i) line.push_back({(4 + i) * grid_step, choices.below(4 * grid_step)});
    GridPolygon polygon = left;
    polygon.push_back(left[0]);
    polygon.insert(polygon.end(), line.begin(), line.end());
    polygon.insert(polygon.end(), right.begin(), right.end());
    polygon.push_back(right[0]);
    polygon.insert(polygon.end(), line.rbegin(), line.rend());
    return polygon;
}

void remove_straight_corners(GridPolygon& polygon, Choices& choices) {
    for (std::size_t i = 0; i < polygon.size() && polygon.size() > 3;) {
        const std::size_t count = polygon.size();
        const GridPoint& before = polygon[(i + count - 1) % count];
        const GridPoint& after = polygon[(i + 1) % count];
        const GridPoint& corner = polygon[i];
        if (before != corner && corner != after && is_on_segment(corner, before, after) && choices.below(4) > 0) {
            polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
        } else {
            ++i;
        }
    }
}

void repeat_corners(GridPolygon& polygon, std::int64_t count, Choices& choices) {
    for (; count > 0; --count) {
        const std::int64_t i = choices.below(static_cast<std::int64_t>(polygon.size()));
        const GridPoint corner = polygon[static_cast<std::size_t>(i)];
        polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(i), corner);
    }
}

} // namespace raywise
