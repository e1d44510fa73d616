#include "scene/look.h"

#include "scene/testing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace raywise {
namespace {

using namespace testing;

Primitives primitives_of(const Soup& soup) {
    return Primitives({std::make_shared<const TriangleMesh>(soup.arrays(), true, true)});
}

// A triangle that fills its box.
void add_triangle(Soup& soup, float x, float y, float z, float size) {
    const float corners[9] = {x, y, z, x + size, y, z + size, x, y + size, z + size};
    soup.vertices.insert(soup.vertices.end(), corners, corners + 9);
}

// In the corners of a unit cube, each a tenth of it wide: cells are 3 x 3 x 3.
TEST(Look, SeesWhatThereIs) {
    Soup soup;
    for (int i = 0; i < 8; ++i)
        add_triangle(soup, i & 1 ? 0.875f : 0.0f, i & 2 ? 0.875f : 0.0f, i & 4 ? 0.875f : 0.0f, 0.125f);
    const SceneFeatures seen = look_at(primitives_of(soup), 8);
    EXPECT_EQ(seen.triangles, 8.0);
    EXPECT_DOUBLE_EQ(seen.boxes, 8 * 0.125 * 0.125);
    EXPECT_DOUBLE_EQ(seen.cells, 3.0);
    EXPECT_DOUBLE_EQ(seen.crowding, 1.0);
    EXPECT_DOUBLE_EQ(seen.references, std::pow(1.375, 3));
    EXPECT_DOUBLE_EQ(seen.filled, 3.0 * 8.0 * std::pow(1.375, 3) / 27.0);
}

// The teapot in the stadium.
TEST(Look, SeesThatMostIsInOneCell) {
    Soup soup = make_soup(20000);
    for (float& x : soup.vertices) x *= 1e-3f;
    add_triangle(soup, -1.0f, -1.0f, -1.0f, 2.0f);
    for (const std::uint32_t sampled : {300u, 20001u}) {
        const SceneFeatures seen = look_at(primitives_of(soup), sampled);
        EXPECT_GT(seen.crowding, 15000.0) << sampled;
        EXPECT_LT(seen.filled, 2.0) << sampled;
        EXPECT_LT(seen.references, 6.0) << "the large one may be among those looked at";
    }
}

TEST(Look, AFewTellOfAll) {
    const Primitives primitives = primitives_of(make_soup(50000));
    const SceneFeatures all = look_at(primitives, 50000);
    const SceneFeatures seen = look_at(primitives, 2048);
    for (const SceneFeature& feature : scene_features)
        EXPECT_NEAR(seen.*feature.value, all.*feature.value, 0.15 * (all.*feature.value)) << feature.name;
    const SceneFeatures again = look_at(primitives, 2048);
    for (const SceneFeature& feature : scene_features) EXPECT_EQ(seen.*feature.value, again.*feature.value);
}

// What cannot be hit is neither looked at nor counted.
TEST(Look, PassesOverWhatCannotBeHit) {
    Soup soup = make_soup(300);
    for (int i = 0; i < 9; ++i) soup.vertices.push_back(0.5f);
    for (int i = 0; i < 9; ++i) soup.vertices.push_back(std::nanf(""));
    const Primitives primitives = primitives_of(soup);
    const SceneFeatures with = look_at(primitives, primitives.count());
    const SceneFeatures without = look_at(primitives_of(make_soup(300)), 300);
    for (const SceneFeature& feature : scene_features)
        EXPECT_DOUBLE_EQ(with.*feature.value, without.*feature.value) << feature.name;
}

TEST(Look, BearsFlatAndTinyScenesAndNone) {
    Soup none;
    Soup flat = make_soup(100);
    for (std::size_t i = 2; i < flat.vertices.size(); i += 3) flat.vertices[i] = 0.25f;
    Soup tiny = make_soup(100);
    for (float& x : tiny.vertices) x *= 1e-30f;
    Soup one;
    add_triangle(one, 0.0f, 0.0f, 0.0f, 1.0f);
    Soup line; // as good as one: thinner than areas can tell
    for (int i = 0; i < 50; ++i) add_triangle(line, static_cast<float>(i) * 1e30f, 0.0f, 0.0f, 1e-30f);
    for (const Soup* soup : {&none, &flat, &tiny, &one, &line}) {
        const Primitives primitives = primitives_of(*soup);
        for (const std::uint32_t sampled : {0u, 1u, 64u, 1000u}) {
            const SceneFeatures seen = look_at(primitives, sampled);
            EXPECT_EQ(seen.triangles, static_cast<double>(primitives.hittable_count()));
            for (const SceneFeature& feature : scene_features)
                EXPECT_TRUE(std::isfinite(seen.*feature.value) && seen.*feature.value >= 0.0) << feature.name;
        }
    }
}

// In float64 a scene may be thinner than any number has an inverse: as good as flat.
TEST(Look, BearsScenesThatAreThinnerThanInverses) {
    const Soup soup = make_soup(100);
    const auto features_with_x_times = [&](double factor) {
        std::vector<double> vertices(soup.vertices.begin(), soup.vertices.end());
        for (std::size_t i = 0; i < vertices.size(); i += 3) vertices[i] *= factor;
        TriangleArrays arrays = soup.arrays();
        arrays.vertices = {reinterpret_cast<const std::byte*>(vertices.data()), 24, 8, Scalar::float64};
        const Primitives primitives({std::make_shared<const TriangleMesh>(arrays, true, true)});
        return look_at(primitives, 1000);
    };
    const SceneFeatures thin = features_with_x_times(4.0 * std::numeric_limits<double>::denorm_min());
    const SceneFeatures flat = features_with_x_times(0.0);
    for (const SceneFeature& feature : scene_features)
        EXPECT_EQ(thin.*feature.value, flat.*feature.value) << feature.name;
}

TEST(Look, WithoutALookASceneIsTypical) {
    const Primitives primitives = primitives_of(make_soup(5000));
    const SceneFeatures seen = look_at(primitives, 0);
    const SceneFeatures typical = typical_features(5000);
    for (const SceneFeature& feature : scene_features)
        EXPECT_EQ(seen.*feature.value, typical.*feature.value) << feature.name;
}

} // namespace
} // namespace raywise
