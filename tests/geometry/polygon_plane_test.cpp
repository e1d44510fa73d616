// The plane a polygon is looked at in: never edge-on, never from behind.
#include "geometry/polygon_plane.h"

#include "geometry/exact.h"

#include <gtest/gtest.h>

#include <cmath>

namespace raywise {
namespace {

std::vector<Vec2> projected(const std::vector<Vec3>& corners) {
    std::vector<Vec2> points;
    project_polygon(corners, points);
    return points;
}

TEST(PolygonPlane, IsThatOfTheLargestAreaSeenCounterclockwise) {
    EXPECT_EQ(projected({{0, 0, 7}, {2, 0, 7}, {2, 3, 7}, {0, 3, 7}}),
              (std::vector<Vec2>{{0, 0}, {2, 0}, {2, 3}, {0, 3}}));
    EXPECT_EQ(projected({{0, 3, 7}, {2, 3, 7}, {2, 0, 7}, {0, 0, 7}}),
              (std::vector<Vec2>{{3, 0}, {3, 2}, {0, 2}, {0, 0}}))
        << "x and y in turn, from below";
    EXPECT_EQ(projected({{7, 0, 0}, {7, 2, 0}, {7, 2, 3}, {7, 0, 3}}),
              (std::vector<Vec2>{{0, 0}, {2, 0}, {2, 3}, {0, 3}}));
    EXPECT_EQ(projected({{0, 7, 0}, {0, 7, 2}, {3, 7, 2}, {3, 7, 0}}),
              (std::vector<Vec2>{{0, 0}, {2, 0}, {2, 3}, {0, 3}}));
    EXPECT_EQ(projected({{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 0}}),
              (std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}))
        << "the last axis of several alike";
}

TEST(PolygonPlane, IsExactWhereRoundingHidesTheArea) {
    // An area of one unit in the last place, far from the origin, either way round and at every scale.
    for (const double scale : {1.0, 0x1p-1000, 0x1p900, 0x1p-1074 / 0x1p-30, 0x1p970}) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto at_place = [&](double x, double y) {
                Vec3 p(0.0);
                p[axis] = 5.0 * scale;
                p[(axis + 1) % 3] = x * scale;
                p[(axis + 2) % 3] = y * scale;
                return p;
            };
            const double bit = 0x1p-30;
            const std::vector<Vec3> sliver = {at_place(1, 1), at_place(1 + 0x1p20, 1 + 0x1p20 - bit),
                                              at_place(1 + 0x1p21, 1 + 0x1p21 - bit), at_place(1 + 0x1p19, 1 + 0x1p19)};
            const std::vector<Vec3> reversed(sliver.rbegin(), sliver.rend());
            for (const auto& corners : {sliver, reversed}) {
                const std::vector<Vec2> points = projected(corners);
                EXPECT_EQ(orientation(points[0], points[1], points[2]), 1) << scale << " " << axis;
                EXPECT_EQ(points == projected(sliver), corners == sliver);
                EXPECT_EQ(points[0], corners == sliver ? Vec2(scale, scale)
                                                       : Vec2(sliver[3][(axis + 2) % 3], sliver[3][(axis + 1) % 3]));
            }
        }
    }
}

TEST(PolygonPlane, IsThatOfTheFirstTriangleWhereNoAreaIsSeen) {
    // Bow ties of two equal halves, and a bent line there and back that is seen as a straight one from the side.
    EXPECT_EQ(projected({{7, 0, 0}, {7, 2, 2}, {7, 0, 2}, {7, 2, 0}}),
              (std::vector<Vec2>{{0, 0}, {2, 2}, {0, 2}, {2, 0}}));
    EXPECT_EQ(projected({{7, 0, 0}, {7, 2, 2}, {7, 2, 0}, {7, 0, 2}}),
              (std::vector<Vec2>{{0, 0}, {2, 2}, {0, 2}, {2, 0}}));
    EXPECT_EQ(projected({{0, 0, 0}, {0, 0, 0}, {9, 0, 9}, {9, 4, 9}, {9, 0, 9}}),
              (std::vector<Vec2>{{0, 0}, {0, 0}, {9, 0}, {9, 4}, {9, 0}}));
}

TEST(PolygonPlane, IsAcrossTheSmallestExtentOfCornersInLine) {
    EXPECT_EQ(projected({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), (std::vector<Vec2>{{1, 1}, {1, 1}, {1, 1}}));
    EXPECT_EQ(projected({{0, 5, 0}, {0, 7, 0}, {0, 6, 0}}), (std::vector<Vec2>{{0, 5}, {0, 7}, {0, 6}}));
    EXPECT_EQ(projected({{0, 0, 0}, {1, 3, 2}, {3, 9, 6}}), (std::vector<Vec2>{{0, 0}, {3, 2}, {9, 6}}));
}

} // namespace
} // namespace raywise
