// Real meshes, where the data folder is present: the facts that are known of them.
#include "io/mesh_file.h"

#include "oracle/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace raywise {
namespace {

std::filesystem::path file_named(const std::string& name) {
    const std::filesystem::path folder = oracle::data_folder();
    std::error_code error;
    return !folder.empty() && std::filesystem::is_regular_file(folder / name, error) ? folder / name
                                                                                     : std::filesystem::path();
}

TEST(RealMeshes, BunnyHasItsTriangles) {
    const std::filesystem::path path = file_named("stanford-bunny.obj");
    if (path.empty()) GTEST_SKIP() << "no data folder";
    const LoadedMesh mesh = load_mesh(path);
    EXPECT_EQ(mesh.triangle_count(), 69451u);
    EXPECT_EQ(mesh.face_count, 69451u);
    EXPECT_TRUE(mesh.is_float64()) << "six decimals, which float32 does not hold";
    EXPECT_EQ(mesh.coordinate(0), -0.037830);
}

TEST(RealMeshes, SuzanneHasQuads) {
    const std::filesystem::path path = file_named("suzanne.obj");
    if (path.empty()) GTEST_SKIP() << "no data folder";
    const LoadedMesh mesh = load_mesh(path);
    EXPECT_GT(mesh.triangle_count(), mesh.face_count);
    EXPECT_EQ(mesh.vertex_count(), 507u);
    EXPECT_EQ(mesh.face_of_triangle.back(), mesh.face_count - 1);
}

TEST(RealMeshes, WoodyIsFlat) {
    const std::filesystem::path path = file_named("woody.obj");
    if (path.empty()) GTEST_SKIP() << "no data folder";
    const LoadedMesh mesh = load_mesh(path);
    double lower = mesh.coordinate(2);
    double upper = lower;
    for (std::size_t i = 2; i < 3 * mesh.vertex_count(); i += 3) {
        lower = std::min(lower, mesh.coordinate(i));
        upper = std::max(upper, mesh.coordinate(i));
    }
    EXPECT_EQ(lower, upper);
}

// Lines that begin with v and f, counted by themselves.
TEST(RealMeshes, EveryObjFileHasAsManyFacesAsLines) {
    const std::filesystem::path folder = oracle::data_folder();
    if (folder.empty()) GTEST_SKIP() << "no data folder";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".obj") continue;
        std::ifstream file(entry.path());
        std::size_t vertices = 0;
        std::size_t faces = 0;
        for (std::string line; std::getline(file, line);) {
            vertices += line.rfind("v ", 0) == 0 ? 1 : 0;
            faces += line.rfind("f ", 0) == 0 ? 1 : 0;
        }
        const LoadedMesh mesh = load_mesh(entry.path());
        EXPECT_EQ(mesh.vertex_count(), vertices) << entry.path();
        EXPECT_EQ(mesh.face_count, faces) << entry.path();
    }
}

TEST(RealMeshes, IgeaIsReadFromPly) {
    const std::filesystem::path path = file_named("igea.ply");
    if (path.empty()) GTEST_SKIP() << "no data folder";
    const LoadedMesh mesh = load_mesh(path);
    EXPECT_EQ(mesh.triangle_count(), mesh.face_count);
    EXPECT_GT(mesh.face_count, 50000u);
    EXPECT_FALSE(mesh.is_float64()) << "as its header says";
}

} // namespace
} // namespace raywise
