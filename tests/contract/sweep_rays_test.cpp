#include "contract/sweep_rays.h"

#include "contract/sweep_compare.h"
#include "contract/sweep_edge_rays.h"
#include "contract/sweep_subject.h"
#include "oracle/judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace raywise::sweep {
namespace {

// Whether the ray's line runs exactly through a point.
bool runs_through(const rw_ray& ray, const Vec3& point) {
    using oracle::exact;
    const Vec3 o = origin_of(ray);
    const Vec3 d = direction_of(ray);
    for (int axis = 0; axis < 3; ++axis) {
        const int next = (axis + 1) % 3;
        if (exact(d[axis]) * (exact(point[next]) - exact(o[next])) !=
            exact(d[next]) * (exact(point[axis]) - exact(o[axis])))
            return false;
    }
    return true;
}

Ray as_ray(const rw_ray& ray) { return {origin_of(ray), ray.tmin, direction_of(ray), ray.tmax}; }

bool same_bits(const rw_ray& a, const rw_ray& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

SweepScene box_scene() { return with_views("test", welded(grid_box(4))); }

TEST(RayMaker, RunsThroughVerticesExactly) {
    const SweepScene scene = box_scene();
    Random random{1};
    RayMaker maker(scene, random);
    int through = 0;
    constexpr int count = 300;
    for (int i = 0; i < count; ++i) {
        const rw_ray ray = maker.at_vertex();
        const auto& vertices = scene.mesh.vertices;
        if (std::any_of(vertices.begin(), vertices.end(), [&](const Vec3& v) { return runs_through(ray, v); }))
            ++through;
    }
    EXPECT_GT(through, count / 3); // those that start where the difference is exact
}

TEST(RayMaker, RunsThroughEdgesExactly) {
    const SweepScene scene = box_scene();
    const oracle::Judge judge(scene.mesh);
    Random random{2};
    RayMaker maker(scene, random);
    int at_edges = 0;
    constexpr int count = 200;
    for (int i = 0; i < count; ++i) {
        // On an edge or a corner the weight of at least one corner is zero.
        for (const oracle::ExactHit& hit : judge.line_hits(as_ray(maker.at_edge()))) {
            if (hit.u != 0 && hit.v != 0 && hit.u + hit.v != 1) continue;
            ++at_edges;
            break;
        }
    }
    EXPECT_GT(at_edges, count / 5);
}

TEST(RayMaker, RunsAlongEdges) {
    const SweepScene scene = box_scene();
    Random random{3};
    RayMaker maker(scene, random);
    int along = 0;
    for (int i = 0; i < 100; ++i) {
        const rw_ray ray = maker.along_edge();
        const auto& triangles = scene.mesh.triangles;
        if (std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) {
                return runs_through(ray, scene.mesh.vertices[t[0]]) && runs_through(ray, scene.mesh.vertices[t[1]]);
            }))
            ++along;
    }
    EXPECT_GT(along, 40);
}

TEST(RayMaker, EndsIntervalsExactlyAtAHit) {
    const SweepScene scene = box_scene();
    Random random{4};
    RayMaker maker(scene, random);
    const rw_ray ray = ray_of(Vec3(0.1, 0.2, -3.0), Vec3(0.0, 0.0, 1.0));
    rw_hit hit{};
    hit.t = 2.0;
    // Its triangle is one whose normal points against the ray.
    const auto& at = scene.mesh.vertices;
    const auto faces_ray = [&](const auto& t) { return unit_normal({at[t[0]], at[t[1]], at[t[2]]}).z == -1.0; };
    const auto& triangles = scene.mesh.triangles;
    const auto found = std::find_if(triangles.begin(), triangles.end(), faces_ray);
    ASSERT_NE(found, triangles.end());
    hit.primitive = static_cast<std::uint32_t>(found - triangles.begin());
    int ends = 0;
    int begins = 0;
    int diffuse = 0;
    for (int i = 0; i < 400; ++i) {
        const rw_ray made = maker.from_hit(ray, hit);
        ends += made.tmax == 2.0 ? 1 : 0;
        begins += made.tmin == 2.0 ? 1 : 0;
        const Vec3 direction = direction_of(made);
        if (origin_of(made) == Vec3(0.1, 0.2, -1.0) && made.tmax == HUGE_VAL && direction != scene.sun &&
            direction != -scene.sun) {
            EXPECT_LE(direction.z, 1e-12); // away from the surface
            ++diffuse;
        }
    }
    EXPECT_GT(ends, 20);
    EXPECT_GT(begins, 20);
    EXPECT_GT(diffuse, 50);
}

TEST(RayMaker, BadRaysAreMisses) {
    const SweepScene scene = box_scene();
    const Subject reference = reference_of(scene);
    Random random{5};
    RayMaker maker(scene, random);
    for (int i = 0; i < 200; ++i) {
        const rw_ray ray = maker.bad();
        if (as_ray(ray).is_traceable()) {
            // An interval that ends at infinity or begins before everything is none of the bad ones.
            ADD_FAILURE() << text_of(ray);
        }
        rw_hit hit;
        ASSERT_EQ(reference.closest(&ray, &hit), RW_OK);
        EXPECT_FALSE(is_hit(hit));
    }
}

TEST(RayMaker, MakesTheSameRaysFromTheSameNumbers) {
    const SweepScene scene = box_scene();
    Random first{7, 8};
    Random again{7, 8};
    Random other{8, 7};
    RayMaker one(scene, first);
    RayMaker two(scene, again);
    RayMaker three(scene, other);
    int different = 0;
    for (int i = 0; i < 200; ++i) {
        const rw_ray ray = one.ordinary_or_hard();
        EXPECT_TRUE(same_bits(ray, two.ordinary_or_hard()));
        different += same_bits(ray, three.ordinary_or_hard()) ? 0 : 1;
    }
    EXPECT_GT(different, 150);
}

TEST(RayMaker, RoundsToFloat32) {
    const rw_ray ray = rounded_to_float32(ray_of(Vec3(0.1), Vec3(1.0, 2.0, 1e-60)));
    EXPECT_EQ(ray.origin[0], static_cast<double>(0.1f));
    EXPECT_EQ(ray.direction[1], 2.0);
    EXPECT_EQ(ray.direction[2], 0.0);
    EXPECT_EQ(ray.tmax, HUGE_VAL);
}

TEST(EdgeRayMaker, HitsEdgesAndVerticesExactlyFromTheMiddle) {
    const ClosedScene scene = closed_scene(grid_box(4));
    const oracle::Judge judge(scene.mesh);
    ASSERT_EQ(scene.inside.front().point, Vec3(0.0));
    Random random{9};
    EdgeRayMaker maker(scene, random);
    int exact_edges = 0;
    int corners = 0;
    constexpr int count = 300;
    for (int i = 0; i < count; ++i) {
        std::size_t met = 0; // triangles in front of the ray
        for (const oracle::ExactHit& hit : judge.line_hits(as_ray(maker.from(Vec3(0.0))))) met += hit.t > 0 ? 1 : 0;
        EXPECT_GE(met, 1u);
        exact_edges += met == 2 ? 1 : 0;
        corners += met > 2 ? 1 : 0;
    }
    EXPECT_GT(exact_edges, count / 6);
    EXPECT_GT(corners, count / 8);
}

TEST(EdgeRayMaker, StartsOutsideAndReachesTheMesh) {
    const ClosedScene scene = closed_scene(oracle::icosphere(2));
    const oracle::Judge judge(scene.mesh);
    Random random{10};
    EdgeRayMaker maker(scene, random);
    int hits = 0;
    for (int i = 0; i < 100; ++i) {
        const rw_ray ray = maker.from_outside();
        EXPECT_GT(glm::dot(origin_of(ray), origin_of(ray)), 1.0);
        const std::vector<oracle::ExactHit> met = judge.line_hits(as_ray(ray));
        if (!met.empty()) ++hits;
        for (const oracle::ExactHit& hit : met) EXPECT_GT(hit.t, 0);
    }
    EXPECT_GT(hits, 80);
}

TEST(EdgeRayMaker, NeighboursAreOneUnitAway) {
    Random random{11};
    bool seen[3] = {};
    for (int i = 0; i < 50; ++i) {
        const double x = neighbour(1.0, random);
        seen[0] = seen[0] || x == std::nextafter(1.0, 0.0);
        seen[1] = seen[1] || x == 1.0;
        seen[2] = seen[2] || x == std::nextafter(1.0, 2.0);
        EXPECT_LE(std::fabs(x - 1.0), 0x1p-52);
    }
    EXPECT_TRUE(seen[0] && seen[1] && seen[2]);
}

} // namespace
} // namespace raywise::sweep
