#include "scenes/scenes.h"
#include "scenes/random.h"
#include "scenes/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <ostream>
#include <string>

namespace raywise::workloads {

void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; } // found by GoogleTest

namespace {

std::string name_of_test(const testing::TestParamInfo<Scene>& info) { return info.param.name; }

class EachScene : public testing::TestWithParam<Scene> {};
INSTANTIATE_TEST_SUITE_P(Scenes, EachScene, testing::ValuesIn(scenes()), name_of_test);

bool is_fixed(const Scene& scene) { return std::string(scene.name) == "tiny_box"; }

TEST_P(EachScene, HasAboutAsManyTrianglesAsWanted) {
    for (const std::uint64_t wanted : {100u, 1000u, 12345u, 200000u}) {
        const double count = static_cast<double>(GetParam().make(wanted, 1).triangle_count());
        if (is_fixed(GetParam())) {
            EXPECT_EQ(count, 12.0);
        } else {
            EXPECT_NEAR(count / static_cast<double>(wanted), 1.0, wanted < 1000 ? 0.3 : 0.05) << wanted;
        }
    }
}

TEST_P(EachScene, BearsAbsurdlyFewTriangles) {
    for (const std::uint64_t wanted : {0u, 1u, 2u, 13u})
        EXPECT_GE(GetParam().make(wanted, 1).triangle_count(), 1u) << wanted;
}

TEST_P(EachScene, HasFiniteVerticesAndIndicesInRange) {
    for (const std::uint64_t wanted : {10u, 5000u}) {
        const Mesh mesh = GetParam().make(wanted, 3);
        EXPECT_EQ(mesh.vertices.size() % 3, 0u);
        EXPECT_EQ(mesh.indices.size() % 3, 0u);
        for (const float v : mesh.vertices) ASSERT_TRUE(std::isfinite(v));
        for (const std::uint32_t i : mesh.indices) ASSERT_LT(i, mesh.vertex_count());
        EXPECT_FALSE(mesh.bounds().empty());
    }
}

TEST_P(EachScene, HasHardlyAnyTriangleWithoutArea) {
    const Mesh mesh = GetParam().make(20000, 1);
    const auto vertex = [&](std::uint32_t i) {
        return Vec3(mesh.vertices[3 * i], mesh.vertices[3 * i + 1], mesh.vertices[3 * i + 2]);
    };
    std::uint64_t flat = 0;
    for (std::uint64_t t = 0; t < mesh.triangle_count(); ++t) {
        const Vec3 a = vertex(mesh.indices[3 * t]), b = vertex(mesh.indices[3 * t + 1]),
                   c = vertex(mesh.indices[3 * t + 2]);
        const Vec3 cross = glm::cross(b - a, c - a);
        flat += glm::dot(cross, cross) == 0.0 ? 1u : 0u;
    }
    EXPECT_LT(flat * 1000, mesh.triangle_count());
}

std::uint64_t hash_of(const Mesh& mesh) {
    std::uint64_t h = mesh.triangle_count();
    const auto add = [&](std::uint64_t value) { h = Random::mix(h ^ value) + 0x9E3779B97F4A7C15u; };
    for (const float v : mesh.vertices) {
        std::uint32_t bits;
        std::memcpy(&bits, &v, sizeof(bits));
        add(bits);
    }
    for (const std::uint32_t i : mesh.indices) add(i);
    return h;
}

TEST_P(EachScene, DependsOnNothingButNumberAndSeed) {
    const std::uint64_t hash = hash_of(GetParam().make(3000, 7));
    EXPECT_EQ(hash_of(GetParam().make(3000, 7)), hash);
    if (is_fixed(GetParam())) return;
    EXPECT_NE(hash_of(GetParam().make(3000, 8)), hash);
    EXPECT_NE(hash_of(GetParam().make(4000, 7)), hash);
}

// The bits on every platform. They change when a scene is changed, which makes old profiles and benchmarks another
// matter.
TEST_P(EachScene, IsTheSameEverywhere) {
    const std::map<std::string, std::uint64_t> known = {
        {"tiny_box", 0x3A1E58A2BF8B052Eu}, {"sphereflake", 0xDD6D2C0F5699230Eu},  {"terrain", 0x8ADC729FBC49ED71u},
        {"soup", 0x7960D3A831001977u},     {"sticks", 0x3365DF656B1A5D2Au},       {"stadium", 0x87AC6602932BD0EEu},
        {"interior", 0xF43E1A1E78777DA2u}, {"bumpy_sphere", 0x69117E7BF20793F4u},
    };
    const std::string name = GetParam().name;
    ASSERT_TRUE(known.count(name)) << name << " has the hash 0x" << std::hex << hash_of(GetParam().make(3000, 7));
    EXPECT_EQ(hash_of(GetParam().make(3000, 7)), known.at(name))
        << name << std::hex << " 0x" << hash_of(GetParam().make(3000, 7));
}

TEST(Scenes, AreFoundByName) {
    EXPECT_STREQ(scene_named("sphereflake")->name, "sphereflake");
    EXPECT_EQ(scene_named("teapot"), nullptr);
    for (const Scene& scene : scenes()) EXPECT_EQ(scene_named(scene.name), &scene);
}

TEST(Scenes, StadiumIsASmallObjectInAHugeHall) {
    const Mesh mesh = scene_named("stadium")->make(10000, 1);
    EXPECT_GT(mesh.bounds().size().x, 100.0);
    std::uint64_t small = 0;
    for (const std::uint32_t i : mesh.indices) {
        small += std::abs(mesh.vertices[3 * i]) < 2.0f && std::abs(mesh.vertices[3 * i + 2]) < 2.0f ? 1u : 0u;
    }
    EXPECT_GT(static_cast<double>(small), 0.99 * static_cast<double>(mesh.indices.size()));
}

TEST(Shapes, PointsOnTheCircleAreSineAndCosine) {
    for (int i = 0; i <= 1000; ++i) {
        const double part = i / 1000.0;
        const Vec2 p = on_circle(part);
        EXPECT_NEAR(p.x, std::cos(2.0 * 3.14159265358979323846 * part), 1e-11) << part;
        EXPECT_NEAR(p.y, std::sin(2.0 * 3.14159265358979323846 * part), 1e-11) << part;
    }
}

TEST(Shapes, SpheresAreClosedAndFaceOutwards) {
    for (const std::uint64_t wanted : {8u, 24u, 500u}) {
        Mesh mesh;
        const std::uint64_t count = add_sphere(mesh, Vec3(1.0, 2.0, 3.0), 0.5, wanted);
        EXPECT_EQ(count, mesh.triangle_count());
        EXPECT_LE(count, wanted);
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (std::uint64_t t = 0; t < mesh.triangle_count(); ++t) {
            for (int k = 0; k < 3; ++k) ++edges[{mesh.indices[3 * t + k], mesh.indices[3 * t + (k + 1) % 3]}];
            const auto vertex = [&](int k) {
                const std::size_t i = mesh.indices[3 * t + k];
                return Vec3(mesh.vertices[3 * i], mesh.vertices[3 * i + 1], mesh.vertices[3 * i + 2]);
            };
            const Vec3 normal = glm::cross(vertex(1) - vertex(0), vertex(2) - vertex(0));
            EXPECT_GT(glm::dot(normal, vertex(0) - Vec3(1.0, 2.0, 3.0)), 0.0);
        }
        for (const auto& [edge, times] : edges) {
            EXPECT_EQ(times, 1);
            EXPECT_EQ(edges.count({edge.second, edge.first}), 1u); // each edge once in either direction
        }
    }
}

TEST(Shapes, FramesAreSquare) {
    Random random(5);
    for (int i = 0; i < 100; ++i) {
        const Frame f(random.on_sphere());
        EXPECT_NEAR(glm::dot(f.x, f.y), 0.0, 1e-12);
        EXPECT_NEAR(glm::dot(f.x, f.z), 0.0, 1e-12);
        EXPECT_NEAR(glm::dot(f.x, f.x), 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(f.y, f.y), 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(glm::cross(f.x, f.y), f.z), 1.0, 1e-12);
    }
}

TEST(RandomNumbers, AreThoseOfSplitMix64) {
    Random random(0); // the published first outputs for seed 0
    EXPECT_EQ(random.bits(), 0xE220A8397B1DCDAFu);
    EXPECT_EQ(random.bits(), 0x6E789E6AA1B965F4u);
}

} // namespace
} // namespace raywise::workloads
