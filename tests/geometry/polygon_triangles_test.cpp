// Polygons cut into triangles: what they cover is counted in exact arithmetic.
#include "geometry/polygon_triangles.h"

#include "geometry/plane_polygons.h"
#include "oracle/judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

namespace raywise {
namespace {

using oracle::Fraction;

// Ways to lay a plane into space: axes swapped, tilted exactly, upside down, far from the origin, and very small or large.
using Placement = Vec3 (*)(const Vec2&);
const std::vector<Placement> placements = {
    [](const Vec2& p) { return Vec3(p.x, p.y, 0.0); },
    [](const Vec2& p) { return Vec3(p.y, p.x, 3.0); },
    [](const Vec2& p) { return Vec3(-1.0, p.x, p.y); },
    [](const Vec2& p) { return Vec3(p.y, 0.5, p.x); },
    [](const Vec2& p) { return Vec3(p.x, p.y, p.x); },
    [](const Vec2& p) { return Vec3(p.x, -4.0 * p.y, p.y); },
    [](const Vec2& p) { return Vec3(p.x - p.y, p.x + p.y, p.x); },
    [](const Vec2& p) { return Vec3(p.x + 0x1p30, 0x1p-200, p.y - 0x1p30); },
    [](const Vec2& p) { return Vec3(p.y, p.x, p.x) * 0x1p-1074; },
    [](const Vec2& p) { return Vec3(p.y * 0x1p900, p.x * 0x1p-900, p.x * 0x1p900); },
};

template <class Number>
std::string text_of(const PlanePolygon<Number>& polygon) {
    std::string text;
    for (const auto& p : polygon) {
        const Vec2 point(static_cast<double>(p[0]), static_cast<double>(p[1]));
        text += "(" + std::to_string(point.x) + ", " + std::to_string(point.y) + ") ";
    }
    return text;
}

std::vector<Vec3> place(const GridPolygon& polygon, Placement placement) {
    std::vector<Vec3> corners;
    for (const GridPoint& p : polygon) {
        corners.push_back(placement({static_cast<double>(p[0]), static_cast<double>(p[1])}));
    }
    return corners;
}

// n - 2 triangles that have the polygon's edges once each and every other edge once in each direction: no gap, whatever the place
// of the corners.
void expect_triangulation(const std::vector<CornerTriple>& triangles, std::size_t corners) {
    ASSERT_EQ(triangles.size(), corners - 2);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const CornerTriple& t : triangles) {
        ASSERT_TRUE(t[0] < t[1] && t[1] < t[2] && t[2] < corners);
        for (std::size_t i = 0; i < 3; ++i) ASSERT_EQ(++edges[std::make_pair(t[i], t[(i + 1) % 3])], 1);
    }
    for (const auto& edge : edges) {
        const auto [from, to] = edge.first;
        const bool is_side = to == (from + 1) % corners;
        ASSERT_EQ(edges.count(std::make_pair(to, from)), is_side ? 0u : 1u);
    }
}

template <class Number>
struct Cover {
    std::vector<PlanePolygon<Number>> triangles; // those with area
    Number area;                                 // twice

    Cover(const PlanePolygon<Number>& polygon, const std::vector<CornerTriple>& triples) : area(0) {
        for (const CornerTriple& t : triples) {
            const Number part = doubled_area(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
            area += part;
            EXPECT_GE(sign_of(part), 0) << "the wrong way round: " << t[0] << " " << t[1] << " " << t[2];
            if (part != 0) triangles.push_back({polygon[t[0]], polygon[t[1]], polygon[t[2]]});
        }
    }

    int count(const PlanePoint<Number>& p) const {
        int sum = 0;
        for (const auto& triangle : triangles) sum += winding_number(triangle, p);
        return sum;
    }
};

// Covers the inside of a counterclockwise polygon once: as often as the polygon winds around random points, and around three
// points in each triangle. Coordinates have to be multiples of 1155.
template <class Number>
void expect_covered_once(const PlanePolygon<Number>& polygon, const std::vector<CornerTriple>& triples, int points,
                         Choices& choices) {
    const Cover<Number> cover(polygon, triples);
    ASSERT_EQ(cover.area, doubled_area(polygon));
    const auto expect_alike = [&](const PlanePoint<Number>& p) {
        if (is_on_outline(polygon, p)) return;
        for (const auto& triangle : cover.triangles) {
            if (is_on_outline(triangle, p)) return;
        }
        const int winding = winding_number(polygon, p);
        ASSERT_TRUE(winding == 0 || winding == 1) << "no polygon for this test";
        ASSERT_EQ(cover.count(p), winding);
    };
    for (const auto& t : cover.triangles) {
        for (std::size_t i = 0; i < 3; ++i) { // inside, near a corner, far from another
            PlanePoint<Number> p;
            for (std::size_t axis = 0; axis < 2; ++axis) {
                p[axis] = (t[i][axis] * 7 + t[(i + 1) % 3][axis] * 3 + t[(i + 2) % 3][axis]) / 11;
            }
            expect_alike(p);
        }
    }
    for (int i = 0; i < points; ++i) {
        const auto& a = choices.one_of(polygon);
        const auto& b = choices.one_of(polygon);
        const auto& c = choices.one_of(polygon);
        PlanePoint<Number> p;
        for (std::size_t axis = 0; axis < 2; ++axis) p[axis] = (a[axis] * 2 + b[axis] * 5 + c[axis] * 98) / 105;
        expect_alike(p);
    }
}

GridPolygon scaled(GridPolygon polygon, std::int64_t factor) {
    for (GridPoint& p : polygon) {
        for (std::int64_t& x : p) x *= factor;
    }
    return polygon;
}

// From every first corner, both ways round, in one of the placements each.
void expect_cut_well(const GridPolygon& polygon, Choices& choices, std::size_t step = 1) {
    SCOPED_TRACE(text_of(polygon));
    PolygonTriangles cutter;
    for (std::size_t first = 0; first < polygon.size(); first += step) {
        GridPolygon rotated = polygon;
        std::rotate(rotated.begin(), rotated.begin() + static_cast<std::ptrdiff_t>(first), rotated.end());
        const std::size_t count = rotated.size();
        for (const bool reversed : {false, true}) {
            const GridPolygon given = reversed ? GridPolygon(rotated.rbegin(), rotated.rend()) : rotated;
            std::vector<CornerTriple> triangles = cutter.cut(place(given, choices.one_of(placements)));
            expect_triangulation(triangles, count);
            if (reversed) {
                for (CornerTriple& t : triangles) {
                    for (std::uint32_t& corner : t) corner = static_cast<std::uint32_t>(count) - 1 - corner;
                    std::swap(t[0], t[2]);
                }
            }
            expect_covered_once(scaled(rotated, 1155), triangles, 20, choices);
            if (testing::Test::HasFailure()) {
                FAIL() << "from corner " << first << (reversed ? ", reversed" : "");
            }
        }
    }
}

std::vector<CornerTriple> fan(std::uint32_t corners) {
    std::vector<CornerTriple> triangles;
    for (std::uint32_t i = 2; i < corners; ++i) triangles.push_back({0, i - 1, i});
    return triangles;
}

std::vector<CornerTriple> cut(const GridPolygon& polygon) {
    return PolygonTriangles().cut(place(polygon, placements[0]));
}

TEST(PolygonTriangles, OfConvexPolygonsAreFans) {
    Choices choices(1);
    for (const std::size_t count : {3, 4, 5, 6, 7, 16, 100}) {
        GridPolygon polygon; // on a parabola, thus convex
        for (std::size_t i = 0; i < count; ++i) {
            const auto x = static_cast<std::int64_t>(i);
            polygon.push_back({x, x * x});
        }
        for (std::size_t first = 0; first < count; ++first) {
            std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
            const GridPolygon reversed(polygon.rbegin(), polygon.rend());
            for (const Placement placement : placements) {
                EXPECT_EQ(PolygonTriangles().cut(place(polygon, placement)), fan(static_cast<std::uint32_t>(count)));
                EXPECT_EQ(PolygonTriangles().cut(place(reversed, placement)), fan(static_cast<std::uint32_t>(count)));
            }
        }
    }
    // With corners in line, and repeated.
    const GridPolygon square = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {2, 2}, {1, 2}, {0, 2}, {0, 1}, {0, 0}};
    for (std::size_t first = 0; first < square.size(); ++first) {
        GridPolygon rotated = square;
        std::rotate(rotated.begin(), rotated.begin() + static_cast<std::ptrdiff_t>(first), rotated.end());
        EXPECT_EQ(cut(rotated), fan(10));
    }
    expect_cut_well(square, choices);
}

TEST(PolygonTriangles, OfAConvexPolygonThatIsBentAreNotUpright) {
    // Corner 1 is between 0 and 2 as seen from above, but lies higher.
    const std::vector<Vec3> bent = {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}, {1, 5, 0}};
    EXPECT_EQ(PolygonTriangles().cut(bent), (std::vector<CornerTriple>{{1, 2, 3}, {0, 1, 3}}));
}

TEST(PolygonTriangles, OfAConcaveQuadLieInside) {
    const GridPolygon dart = {{0, 0}, {4, -2}, {0, 4}, {1, 0}}; // concave at the last
    EXPECT_EQ(cut(dart), (std::vector<CornerTriple>{{1, 2, 3}, {0, 1, 3}}));
    EXPECT_EQ(cut({dart[3], dart[0], dart[1], dart[2]}), fan(4));
    EXPECT_EQ(cut({dart[2], dart[3], dart[0], dart[1]}), (std::vector<CornerTriple>{{1, 2, 3}, {0, 1, 3}}));
    EXPECT_EQ(cut({dart[1], dart[2], dart[3], dart[0]}), fan(4));
}

TEST(PolygonTriangles, LeaveANotchOpen) {
    const GridPolygon notched = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
    Choices choices(2);
    expect_cut_well(notched, choices);
    EXPECT_EQ(cut(notched),
              (std::vector<CornerTriple>{{1, 2, 3}, {5, 6, 7}, {1, 3, 4}, {0, 5, 7}, {0, 1, 4}, {0, 4, 5}}));
}

TEST(PolygonTriangles, CoverSimplePolygonsOnce) {
    Choices choices(3);
    int simple = 0;
    for (int i = 0; i < 400; ++i) {
        const auto corners = static_cast<std::size_t>(4 + choices.below(20));
        const std::int64_t size = 5 + choices.below(4) * choices.below(4) * 10; // small: many in line
        const GridPolygon polygon = random_simple_polygon(corners, size, choices);
        if (polygon.empty()) continue;
        ++simple;
        ASSERT_NO_FATAL_FAILURE(expect_cut_well(polygon, choices));
    }
    EXPECT_GT(simple, 300);
    for (const std::size_t corners : {5, 17, 60, 150}) {
        ASSERT_NO_FATAL_FAILURE(expect_cut_well(random_star(corners, choices), choices, corners / 4));
    }
    for (const std::int64_t size : {1, 2, 8}) {
        ASSERT_NO_FATAL_FAILURE(expect_cut_well(comb(size), choices, 1 + static_cast<std::size_t>(size) / 2));
        ASSERT_TRUE(is_simple(spiral(size)));
        ASSERT_NO_FATAL_FAILURE(expect_cut_well(spiral(size), choices, 1 + static_cast<std::size_t>(size) / 2));
    }
}

TEST(PolygonTriangles, OfSimplePolygonsHaveArea) {
    Choices choices(4);
    for (int i = 0; i < 300; ++i) {
        const GridPolygon polygon = random_simple_polygon(static_cast<std::size_t>(4 + choices.below(16)), 6, choices);
        if (polygon.empty()) continue;
        const std::vector<CornerTriple> triangles = cut(polygon);
        if (triangles == fan(static_cast<std::uint32_t>(polygon.size()))) continue; // of a convex one
        for (const CornerTriple& t : triangles) EXPECT_GT(doubled_area(polygon[t[0]], polygon[t[1]], polygon[t[2]]), 0);
    }
}

TEST(PolygonTriangles, CoverPolygonsWithHolesOnce) {
    Choices choices(5);
    // A square with two square holes, one joined to the outline, the other to the first, by lines there and back.
    const GridPolygon holes = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {1, 1}, {1, 3}, {3, 3},
                               {5, 5}, {5, 7}, {7, 7}, {7, 5}, {5, 5}, {3, 3}, {3, 1}, {1, 1}};
    ASSERT_EQ(doubled_area(holes), 2 * (81 - 4 - 4));
    expect_cut_well(holes, choices);
    // Lines along an axis, from the middle of a side, two from the same corner, and a hole that touches the outline.
    const GridPolygon more = {{0, 0}, {4, 0}, {4, 2}, {3, 3}, {4, 4}, {5, 3}, {4, 2}, {4, 0}, {9, 0},
                              {9, 9}, {6, 8}, {7, 5}, {5, 6}, {6, 8}, {9, 9}, {0, 9}, {1, 5}, {0, 4}};
    expect_cut_well(more, choices);
}

TEST(PolygonTriangles, CoverOutlinesThatTouchThemselvesOnce) {
    Choices choices(6);
    for (int i = 0; i < 400; ++i) {
        const auto triangles = static_cast<std::size_t>(1 + choices.below(24));
        const auto antennas = static_cast<std::size_t>(i % 2 == 0 ? 0 : choices.below(5));
        GridPolygon polygon = outline_of_tree(triangles, 1 + choices.below(5), antennas, choices);
        if (i % 4 > 1) remove_straight_corners(polygon, choices);
        if (i % 3 == 0) repeat_corners(polygon, choices.below(4), choices);
        ASSERT_NO_FATAL_FAILURE(expect_cut_well(polygon, choices, 1 + polygon.size() / 12));
    }
}

// Lines there and back that are easily taken for the border of something.
TEST(PolygonTriangles, CoverOutlinesThatTurnBackOnce) {
    Choices choices(12);
    expect_cut_well({{4, 20},
                     {5, 22},
                     {4, 20},
                     {12, 24},
                     {0, 12},
                     {12, 0},
                     {24, 12},
                     {24, 24},
                     {24, 24},
                     {12, 24},
                     {12, 24},
                     {12, 12},
                     {12, 24}},
                    choices);
    expect_cut_well({{24, 36},
                     {12, 24},
                     {12, 12},
                     {12, 0},
                     {24, 0},
                     {24, 12},
                     {36, 24},
                     {36, 36},
                     {36, 36},
                     {24, 36},
                     {24, 36},
                     {24, 24},
                     {24, 36},
                     {16, 32},
                     {14, 31},
                     {16, 32}},
                    choices);
}

TEST(PolygonTriangles, CoverPartsJoinedByALineOnce) {
    Choices choices(7);
    for (int i = 0; i < 200; ++i) {
        const GridPolygon polygon = dumbbell(static_cast<std::size_t>(1 + choices.below(10)), choices);
        ASSERT_NO_FATAL_FAILURE(expect_cut_well(polygon, choices, 1 + polygon.size() / 12));
    }
}

// Many of each kind, by the way their triangles turn and what they add up to.
TEST(PolygonTriangles, OfOutlinesThatTouchThemselvesAreNeverReversed) {
    Choices choices(11);
    PolygonTriangles cutter;
    for (int i = 0; i < 40000; ++i) {
        GridPolygon polygon = outline_of_tree(static_cast<std::size_t>(1 + choices.below(12)), 1 + choices.below(3),
                                              static_cast<std::size_t>(choices.below(4)), choices);
        if (i % 2 == 0) remove_straight_corners(polygon, choices);
        repeat_corners(polygon, choices.below(3), choices);
        std::rotate(polygon.begin(), polygon.begin() + choices.below(static_cast<std::int64_t>(polygon.size())),
                    polygon.end());
        const Cover<std::int64_t> cover(polygon, cutter.cut(place(polygon, choices.one_of(placements))));
        ASSERT_EQ(cover.area, doubled_area(polygon));
        ASSERT_FALSE(HasFailure()) << text_of(polygon);
    }
}

// Coordinates of all bits, so that nothing is in line but nearly so.
TEST(PolygonTriangles, CoverPolygonsNextToDegenerateOnesOnce) {
    Choices choices(8);
    int simple = 0;
    for (int i = 0; i < 600; ++i) {
        const GridPolygon grid = random_simple_polygon(static_cast<std::size_t>(4 + choices.below(10)), 5, choices);
        if (grid.empty()) continue;
        std::vector<Vec3> corners;
        PlanePolygon<Fraction> polygon;
        const double scale = std::ldexp(1.0, static_cast<int>(choices.below(1900)) - 1000);
        const double offset = choices.below(2) == 0 ? 0.0 : 1e5;
        for (const GridPoint& p : grid) {
            const auto x = static_cast<double>(p[0]);
            const auto y = static_cast<double>(p[1]);
            const Vec2 turned((0.83 * x - 0.56 * y + offset) * scale, (0.56 * x + 0.83 * y + offset) * scale);
            corners.emplace_back(turned.y, 0.0, turned.x);
            polygon.push_back({oracle::exact(turned.x), oracle::exact(turned.y)});
        }
        if (!is_simple(polygon) || doubled_area(polygon) < 0) continue;
        ++simple;
        const std::vector<CornerTriple> triangles = PolygonTriangles().cut(corners);
        ASSERT_NO_FATAL_FAILURE(expect_triangulation(triangles, corners.size()));
        expect_covered_once(polygon, triangles, 10, choices);
        ASSERT_FALSE(HasFailure()) << text_of(grid);
    }
    EXPECT_GT(simple, 200);
}

// Whatever the outline does: triangles of its corners that leave no gap, and together its signed area.
TEST(PolygonTriangles, OfAnyCornersAreTheirTriangulation) {
    Choices choices(9);
    PolygonTriangles used;
    for (int i = 0; i < 20000; ++i) {
        GridPolygon polygon;
        const std::int64_t size = 1 + choices.below(6);
        for (std::int64_t n = 3 + choices.below(i % 100 == 0 ? 200 : 12); n > 0; --n) {
            polygon.push_back({choices.below(size), choices.below(size)});
        }
        const std::vector<Vec3> corners = place(polygon, choices.one_of(placements));
        const std::vector<CornerTriple> triangles = used.cut(corners);
        ASSERT_NO_FATAL_FAILURE(expect_triangulation(triangles, polygon.size())) << text_of(polygon);
        std::int64_t area = 0;
        for (const CornerTriple& t : triangles) area += doubled_area(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
        EXPECT_EQ(area, doubled_area(polygon));
        EXPECT_EQ(PolygonTriangles().cut(corners), triangles) << "depends on what was cut before";
    }
}

TEST(PolygonTriangles, OfAnOutlineWithoutAreaHaveNone) {
    const std::vector<GridPolygon> lines = {
        {{0, 0}, {1, 1}, {2, 2}, {3, 3}},
        {{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}},
        {{0, 0}, {3, 0}, {1, 0}, {2, 0}, {0, 0}},
        {{0, 0}, {4, 0}, {4, 4}, {4, 0}}, // a bent line there and back
        {{0, 0}, {4, 0}, {4, 4}, {9, 1}, {4, 4}, {4, 0}},
    };
    for (const GridPolygon& polygon : lines) {
        for (const Placement placement : placements) {
            const std::vector<CornerTriple> triangles = PolygonTriangles().cut(place(polygon, placement));
            expect_triangulation(triangles, polygon.size());
            for (const CornerTriple& t : triangles)
                EXPECT_EQ(doubled_area(polygon[t[0]], polygon[t[1]], polygon[t[2]]), 0) << text_of(polygon);
        }
    }
}

TEST(PolygonTriangles, OfLargePolygonsAddUp) {
    Choices choices(10);
    for (const GridPolygon& polygon : {random_star(20000, choices), comb(5000), spiral(2500)}) {
        const std::vector<CornerTriple> triangles = cut(polygon);
        ASSERT_NO_FATAL_FAILURE(expect_triangulation(triangles, polygon.size()));
        EXPECT_EQ(Cover<std::int64_t>(polygon, triangles).area, doubled_area(polygon));
    }
}

} // namespace
} // namespace raywise
