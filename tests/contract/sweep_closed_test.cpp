#include "contract/sweep_closed.h"

#include "contract/sweep_closed_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace raywise::sweep {
namespace {

oracle::Scene joined(oracle::Scene a, const oracle::Scene& b) {
    const auto shift = static_cast<std::uint32_t>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const auto& [x, y, z] : b.triangles) a.triangles.push_back({x + shift, y + shift, z + shift});
    return a;
}

// Three vertices of its own for every triangle, as in an STL file.
oracle::Scene taken_apart(const oracle::Scene& mesh) {
    oracle::Scene apart{mesh.name, {}, {}};
    for (const auto& t : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(apart.vertices.size());
        for (const std::uint32_t corner : t) apart.vertices.push_back(mesh.vertices[corner]);
        apart.triangles.push_back({first, first + 1, first + 2});
    }
    return apart;
}

oracle::Scene inside_out(oracle::Scene mesh) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

TEST(Closed, BodiesAre) {
    for (const oracle::Scene& mesh :
         {oracle::tetrahedron(), oracle::cube(), oracle::icosphere(2), torus(12, 6), welded(grid_box(3))})
        EXPECT_TRUE(is_closed(mesh)) << mesh.name;
}

TEST(Closed, SheetsAndBodiesWithAHoleAreNot) {
    oracle::Scene holed = oracle::icosphere(1);
    holed.triangles.pop_back();
    for (const oracle::Scene& mesh : {oracle::single_triangle(), oracle::terrain(4), oracle::empty_scene(), holed})
        EXPECT_FALSE(is_closed(mesh)) << mesh.name;
}

TEST(Closed, BodiesWithATriangleTurnedRoundAreNot) {
    oracle::Scene turned = oracle::cube();
    std::swap(turned.triangles[3][0], turned.triangles[3][1]);
    EXPECT_FALSE(is_closed(turned));
}

TEST(Closed, VerticesHeldApartAreWelded) {
    const oracle::Scene apart = taken_apart(oracle::icosphere(1));
    EXPECT_FALSE(is_closed(apart));
    const oracle::Scene together = welded(apart);
    EXPECT_TRUE(is_closed(together));
    EXPECT_EQ(together.vertices.size(), oracle::icosphere(1).vertices.size());
    EXPECT_EQ(edges_of(together).size(), 120u); // 30 * 4
}

TEST(Closed, NegativeZeroIsWeldedToZero) {
    oracle::Scene mesh{"zeros", {{0.0, 0, 0}, {-0.0, 0, 0}, {1, 0, 0}}, {{0, 1, 2}}};
    EXPECT_EQ(welded(mesh).vertices.size(), 2u);
}

TEST(Convex, BallsAndBoxesAre) {
    for (const oracle::Scene& mesh : {oracle::tetrahedron(), oracle::cube(), oracle::icosphere(3), welded(grid_box(3)),
                                      inside_out(oracle::icosphere(1))})
        EXPECT_TRUE(is_convex(mesh)) << mesh.name;
}

TEST(Convex, TorusDentAndTwoBodiesAreNot) {
    EXPECT_FALSE(is_convex(torus(12, 6)));
    EXPECT_FALSE(is_convex(joined(oracle::cube(), oracle::transformed(oracle::cube(), 1.0, Vec3(5.0), true))));
    // The smallest dent there can be: one vertex of a flat face, one unit in the last place inwards.
    oracle::Scene dented = welded(grid_box(2));
    for (Vec3& v : dented.vertices) {
        if (v == Vec3(0, 0, 1)) v.z = std::nextafter(1.0, 0.0);
    }
    EXPECT_FALSE(is_convex(dented));
}

TEST(Winding, CountsTheTurnsAroundAPoint) {
    EXPECT_NEAR(winding_number(oracle::cube(), Vec3(0.3, -0.2, 0.9)), 1.0, 1e-12);
    EXPECT_NEAR(winding_number(inside_out(oracle::cube()), Vec3(0.3, -0.2, 0.9)), -1.0, 1e-12);
    EXPECT_NEAR(winding_number(oracle::cube(), Vec3(0.3, -0.2, 1.1)), 0.0, 1e-12);
    EXPECT_NEAR(winding_number(torus(24, 12), Vec3(0.0)), 0.0, 1e-12); // the hole
    EXPECT_NEAR(winding_number(torus(24, 12), Vec3(1.0, 0.0, 0.0)), 1.0, 1e-12);
    const oracle::Scene twice = joined(oracle::cube(), oracle::transformed(oracle::cube(), 0.5, Vec3(0.0), true));
    EXPECT_NEAR(winding_number(twice, Vec3(0.1)), 2.0, 1e-12);
    EXPECT_NEAR(winding_number(oracle::transformed(oracle::cube(), 1e-30, Vec3(0.0), true), Vec3(0.0)), 1.0, 1e-12);
}

TEST(InsidePoints, LieInsideAndKnowTheirParity) {
    Random random{1};
    const std::vector<InsidePoint> in_torus = inside_points(torus(24, 12), 10, random);
    ASSERT_EQ(in_torus.size(), 10u);
    for (const InsidePoint& inside : in_torus) {
        EXPECT_TRUE(inside.odd);
        const double from_ring = std::hypot(std::hypot(inside.point.x, inside.point.y) - 1.0, inside.point.z);
        EXPECT_LT(from_ring, 0.4);
    }
    const oracle::Scene twice = joined(oracle::cube(), oracle::transformed(oracle::cube(), 0.5, Vec3(0.0), true));
    const std::vector<InsidePoint> in_both = inside_points(twice, 30, random);
    ASSERT_EQ(in_both.size(), 30u);
    EXPECT_EQ(in_both.front().point, Vec3(0.0));
    bool any_odd = false;
    for (const InsidePoint& inside : in_both) {
        const Vec3 magnitude = glm::abs(inside.point);
        EXPECT_EQ(inside.odd, max_component(magnitude) > 0.5);
        any_odd = any_odd || inside.odd;
    }
    EXPECT_TRUE(any_odd);
}

TEST(ClosedScenes, AreAllClosedWithPointsInside) {
    const std::vector<ClosedScene> scenes = closed_scenes(1000, false);
    std::size_t convex = 0;
    for (const ClosedScene& scene : scenes) {
        EXPECT_TRUE(is_closed(scene.mesh)) << scene.mesh.name;
        EXPECT_FALSE(scene.inside.empty()) << scene.mesh.name;
        EXPECT_GT(scene.radius, 0.0);
        convex += scene.convex ? 1 : 0;
    }
    EXPECT_GT(scenes.size(), 30u);
    EXPECT_GT(convex, 20u);
    EXPECT_LT(convex, scenes.size());
}

TEST(ClosedScenes, AnOpenMeshIsRefused) { EXPECT_THROW(closed_scene(oracle::terrain(3)), std::runtime_error); }

} // namespace
} // namespace raywise::sweep
