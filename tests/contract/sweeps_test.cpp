#include "contract/sweeps.h"

#include "contract/exact_hits.h"
#include "contract/numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace raywise::contract {
namespace {

Family family_of(const std::string& mesh, const std::string& rays, bool float32) {
    return parse_cases("family a\ncase b\nabout It.\nprecision " + std::string(float32 ? "float32" : "float64") + "\n" +
                           mesh + "\n" + rays + "\nexpect even\n",
                       "test");
}

std::vector<Mesh> meshes_of(const std::string& mesh, bool float32) {
    return {make_mesh(family_of(mesh, "ray 0 0 0 0 0 1", float32).cases[0].geometries[0])};
}

std::vector<Ray> rays_of(const std::string& mesh, const std::string& rays, bool float32 = false,
                         std::uint64_t factor = 1) {
    return sweep_rays(family_of(mesh, rays, float32).cases[0].rays[0], meshes_of(mesh, float32), float32, factor);
}

const char* const sphere = "mesh icosphere 2\ngrid 0x1p-12";
const char* const torus = "mesh torus 1 0.375 24 12\ngrid 0x1p-12";

// What a line of each kind needs beyond its count and seed.
std::string line_of(const SweepKind& kind, const std::string& count) {
    std::string line = std::string("rays ") + kind.name + " " + count + " 1";
    for (const Parameter& parameter : kind.parameters)
        line += std::string(" ") + (std::string(parameter.name) == "dz" ? "1" : parameter.whole ? "0" : "0.25");
    return line;
}

TEST(Sweeps, HaveAsManyRaysAsAskedForAndAreTraceable) {
    for (const SweepKind& kind : sweep_kinds()) {
        const bool lattice = std::string(kind.name) == "axis-grid";
        const std::size_t few = rays_of(sphere, line_of(kind, "5")).size();
        const std::size_t more = rays_of(sphere, line_of(kind, "5"), false, 9).size();
        EXPECT_EQ(few, lattice ? 25u : 5u) << kind.name;
        EXPECT_EQ(more, lattice ? 169u : 45u) << kind.name;
        for (const Ray& ray : rays_of(sphere, line_of(kind, "5"))) EXPECT_TRUE(ray.is_traceable());
    }
}

TEST(Sweeps, AreTheSameEveryTimeAndDifferBySeed) {
    for (const SweepKind& kind : sweep_kinds()) {
        if (std::string(kind.name) == "axis-grid") continue; // has nothing random about it
        std::string line = line_of(kind, "20");
        const std::vector<Ray> first = rays_of(sphere, line);
        const std::vector<Ray> again = rays_of(sphere, line);
        line.replace(line.find(" 20 1") + 4, 1, "2");
        const std::vector<Ray> other = rays_of(sphere, line);
        const auto same = [](const std::vector<Ray>& a, const std::vector<Ray>& b) {
            for (std::size_t i = 0; i < a.size(); ++i) {
                if (a[i].origin != b[i].origin || a[i].direction != b[i].direction) return false;
            }
            return a.size() == b.size();
        };
        EXPECT_TRUE(same(first, again)) << kind.name;
        EXPECT_FALSE(same(first, other)) << kind.name;
    }
}

TEST(Sweeps, OfFloat32CasesAreFloat32) {
    for (const SweepKind& kind : sweep_kinds()) {
        for (const Ray& ray : rays_of("mesh uv-sphere 5 7", line_of(kind, "10"), true)) {
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_TRUE(is_float32(ray.origin[axis]) && is_float32(ray.direction[axis])) << kind.name;
            EXPECT_TRUE(is_float32(ray.tmin) && is_float32(ray.tmax)) << kind.name;
        }
    }
}

// How many triangles share each hit: 1 inside, 2 at an edge, more at a corner.
std::size_t most_at_one_t(const ExactAnswers& answers) {
    std::size_t most = 0;
    for (const ExactAnswer& one : answers.touched) {
        std::size_t here = 0;
        for (const ExactAnswer& other : answers.touched) here += other.t == one.t ? 1 : 0;
        most = std::max(most, here);
    }
    return most;
}

// "Through an edge" is meant exactly, in float32 as well.
TEST(Sweeps, PassExactlyThroughVerticesAndEdges) {
    const std::pair<const char*, std::size_t> kinds[] = {{"vertices-from-point 60 1 0 0 0", 3},
                                                         {"vertices-from-point all 0 0.25 0.125 -0.5", 3},
                                                         {"edges-from-point 60 1 0 0 0", 2},
                                                         {"edges-from-point all 0 0 0 0", 2}};
    for (const auto& [line, least] : kinds) {
        for (const bool float32 : {false, true}) {
            const ExactScene exact(meshes_of(sphere, float32));
            for (const Ray& ray : rays_of(sphere, std::string("rays ") + line, float32))
                EXPECT_GE(most_at_one_t(exact.answers(ray)), least) << line;
        }
    }
}

// From outside an edge of a silhouette may be met by one triangle alone: the other is edge-on.
TEST(Sweeps, FromOutsideMeetTheirTargetAtTOne) {
    for (const char* kind : {"vertices-from-outside", "edges-from-outside"}) {
        for (const bool float32 : {false, true}) {
            const ExactScene exact(meshes_of(torus, float32));
            for (const Ray& ray : rays_of(torus, std::string("rays ") + kind + " 100 3", float32)) {
                const ExactAnswers answers = exact.answers(ray);
                const bool at_one = std::any_of(answers.touched.begin(), answers.touched.end(),
                                                [](const ExactAnswer& answer) { return answer.t == 1; });
                EXPECT_TRUE(at_one) << kind;
                Ray before = ray;
                before.tmin = -std::numeric_limits<double>::infinity();
                before.tmax = 0.0;
                EXPECT_TRUE(exact.answers(before).touched.empty()) << "starts outside";
            }
        }
    }
}

TEST(Sweeps, AllTakesEachVertexAndEdgeOnce) {
    EXPECT_EQ(rays_of("mesh box 2 2 2", "rays vertices-from-point all 0 0 0 0").size(), 8u);
    EXPECT_EQ(rays_of("mesh box 2 2 2", "rays edges-from-point all 0 0 0 0").size(), 18u);
    EXPECT_EQ(rays_of("mesh box 2 2 2", "rays edges-from-point all 0 0 0 0", false, 7).size(), 18u);
}

TEST(Sweeps, AlongEdgesStayOnTheirEdge) {
    const std::vector<Mesh> meshes = meshes_of("mesh tetrahedron", false);
    for (const Ray& ray : rays_of("mesh tetrahedron", "rays along-edges 40 2")) {
        std::size_t corners = 0;
        for (const Vec3& v : meshes[0].vertices)
            corners += glm::cross(v - ray.origin, ray.direction) == Vec3(0.0) ? 1 : 0;
        EXPECT_EQ(corners, 2u);
    }
}

TEST(Sweeps, InPlaneStayInThePlane) {
    const char* const triangle = "v 1 0 0\nv 0 2 0\nv 0 0 4\nf 0 1 2";
    const Vec3 normal(4, 2, 1); // 4 x + 2 y + z = 4
    for (const Ray& ray : rays_of(triangle, "rays in-plane 50 2")) {
        EXPECT_EQ(glm::dot(ray.direction, normal), 0.0);
        EXPECT_EQ(glm::dot(ray.origin, normal), 4.0);
    }
}

TEST(Sweeps, OnSurfaceStartExactlyThere) {
    const ExactScene exact(meshes_of(sphere, false));
    for (const char* kind : {"rays on-surface 50 2", "rays leaving 50 2 0"}) {
        for (const Ray& ray : rays_of(sphere, kind)) {
            const ExactAnswers answers = exact.answers(ray);
            ASSERT_FALSE(answers.touched.empty());
            EXPECT_EQ(answers.touched[0].t, 0) << kind;
        }
    }
}

TEST(Sweeps, AxisGridReachesFromBorderToBorder) {
    const std::vector<Ray> rays = rays_of("mesh box 2 4 6", "rays axis-grid 5 0 2");
    ASSERT_EQ(rays.size(), 25u);
    Box box;
    for (const Ray& ray : rays) {
        box.extend(Vec3(ray.origin.x, ray.origin.y, 0));
        EXPECT_EQ(std::fabs(ray.direction.z), 1.0);
        EXPECT_EQ(ray.direction.x, 0.0);
        EXPECT_LT(ray.origin.z * ray.direction.z, -3.0) << "starts outside";
    }
    EXPECT_EQ(box.lower, Vec3(-1, -2, 0));
    EXPECT_EQ(box.upper, Vec3(1, 2, 0));
}

TEST(Sweeps, PointsAreWhereTheySayTheyAre) {
    for (const Ray& ray : rays_of(sphere, "rays points-in-ball 100 1 0.5"))
        EXPECT_LE(glm::length(ray.origin), 0.5 + 1e-3);
    for (const Ray& ray : rays_of(sphere, "rays points-beyond-ball 100 1 1.25"))
        EXPECT_GT(glm::length(ray.origin), 1.25 - 1e-3);
    for (const Ray& ray : rays_of(sphere, "rays from-afar 100 1 1000 0.25")) EXPECT_GT(glm::length(ray.origin), 1900.0);
}

} // namespace
} // namespace raywise::contract
