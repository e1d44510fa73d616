#include "contract/meshes.h"

#include "contract/numbers.h"
#include "oracle/judge.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace raywise::contract {
namespace {

Mesh mesh_of(const std::string& lines, bool float32 = false) {
    const Family family =
        parse_cases("family a\ncase b\nabout It.\n" + std::string("geometry ") + (float32 ? "float32" : "float64") +
                        "\n" + lines + "\nray 0 0 0 0 0 1\nexpect hit\n",
                    "test");
    return make_mesh(family.cases[0].geometries[0]);
}

// Every edge once in each direction.
bool is_closed(const Mesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& [a, b, c] : mesh.triangles) {
        ++edges[{a, b}];
        ++edges[{b, c}];
        ++edges[{c, a}];
    }
    for (const auto& [edge, count] : edges) {
        const auto opposite = edges.find({edge.second, edge.first});
        if (count != 1 || opposite == edges.end() || opposite->second != 1) return false;
    }
    return !edges.empty();
}

double volume(const Mesh& mesh) {
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.triangles)
        sum += glm::dot(mesh.vertices[a], glm::cross(mesh.vertices[b], mesh.vertices[c])) / 6.0;
    return sum;
}

struct Closed {
    const char* line;
    std::size_t vertices;
    std::size_t triangles;
    double least_volume;
    double most_volume;
};

class ClosedMesh : public testing::TestWithParam<Closed> {};

TEST_P(ClosedMesh, HasEveryEdgeTwiceAndItsOutsideOutside) {
    const Mesh mesh = mesh_of(GetParam().line);
    EXPECT_EQ(mesh.vertices.size(), GetParam().vertices);
    EXPECT_EQ(mesh.triangles.size(), GetParam().triangles);
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_GE(volume(mesh), GetParam().least_volume - 1e-12);
    EXPECT_LE(volume(mesh), GetParam().most_volume + 1e-12);
    for (const auto& [a, b, c] : mesh.triangles)
        EXPECT_FALSE(oracle::has_no_area(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
}

INSTANTIATE_TEST_SUITE_P(All, ClosedMesh,
                         testing::Values(Closed{"mesh box 1 2 3", 8, 12, 6, 6}, Closed{"mesh grid-box 1", 8, 12, 8, 8},
                                         Closed{"mesh grid-box 8", 386, 768, 8, 8},
                                         Closed{"mesh tetrahedron", 4, 4, 2.6, 2.7},
                                         Closed{"mesh icosphere 3", 642, 1280, 4.1, 4.19},
                                         Closed{"mesh uv-sphere 31 32", 994, 1984, 4.1, 4.19},
                                         Closed{"mesh uv-sphere 1 3", 5, 6, 0.8, 0.9},
                                         Closed{"mesh cylinder 1.5 4 32", 66, 128, 28, 28.3},
                                         Closed{"mesh torus 1 0.25 32 16", 512, 1024, 1.1, 1.24},
                                         // Rounding and scaling keep it so.
                                         Closed{"mesh icosphere 3\ngrid 0x1p-10", 642, 1280, 4.1, 4.19},
                                         Closed{"mesh icosphere 2\nscale 1 1 0.5", 162, 320, 2, 2.1}));

TEST(Meshes, OpenOnesHaveTheirSizes) {
    EXPECT_EQ(mesh_of("mesh terrain 16").triangles.size(), 512u);
    EXPECT_EQ(mesh_of("mesh flat 0 4").triangles.size(), 32u);
    EXPECT_EQ(mesh_of("mesh stack 100").triangles.size(), 200u);
    EXPECT_EQ(mesh_of("mesh soup 60 4").triangles.size(), 60u);
    EXPECT_EQ(mesh_of("mesh slivers 150 2").triangles.size(), 150u);
    EXPECT_EQ(mesh_of("mesh strips 256 0x1p-23").triangles.size(), 512u);
}

TEST(Meshes, FlatOnesAreFlatAcrossTheirAxis) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const Vec3& v : mesh_of("mesh flat " + std::to_string(axis) + " 4").vertices) {
            EXPECT_EQ(v[axis], 0.0);
            EXPECT_GE(v[(axis + 1) % 3], 0.0);
            EXPECT_LE(v[(axis + 2) % 3], 4.0);
        }
    }
}

TEST(Meshes, SliversAreAsSlimAsSaid) {
    const Mesh mesh = mesh_of("mesh strips 3 0x1p-23");
    EXPECT_EQ(mesh.vertices[2] - mesh.vertices[0], Vec3(0x1p-23, 0, 0));
    EXPECT_EQ(mesh.vertices[1] - mesh.vertices[0], Vec3(0, 1, 0));
}

TEST(Meshes, ChangesConcernTheLatestMeshOnly) {
    const Mesh mesh = mesh_of("mesh box 2 2 2\nmesh box 2 2 2\nscale 2\nscale 1 2 3\nmove 10 0 0");
    ASSERT_EQ(mesh.vertices.size(), 16u);
    EXPECT_EQ(mesh.vertices[7], Vec3(1, 1, 1));
    EXPECT_EQ(mesh.vertices[15], Vec3(12, 4, 6));
    EXPECT_EQ(mesh.triangles[12], (std::array<std::uint32_t, 3>{8, 10, 11})); // numbered on
    EXPECT_EQ(mesh_of("v 1 2 3\nv 4 5 6\nmove 1 0 0").vertices[1], Vec3(5, 5, 6));
}

TEST(Meshes, GridMovesToMultiples) {
    EXPECT_EQ(mesh_of("v 0.3 -0.3 0.74\ngrid 0.5").vertices[0], Vec3(0.5, -0.5, 0.5));
}

TEST(Meshes, Float32MeansFloat32AfterEveryStep) {
    const Mesh mesh = mesh_of("mesh uv-sphere 7 9\nscale 0.1\nmove 1000000.1 0 0", true);
    EXPECT_TRUE(mesh.float32);
    for (const Vec3& v : mesh.vertices) EXPECT_TRUE(is_float32(v.x) && is_float32(v.y) && is_float32(v.z));
    EXPECT_FALSE(is_float32(mesh_of("mesh uv-sphere 7 9").vertices[0].x));
}

TEST(Meshes, AnAbsentFileIsSaidToBeAbsent) { EXPECT_THROW(mesh_of("mesh file no-such-mesh.obj"), MeshFileAbsent); }

} // namespace
} // namespace raywise::contract
