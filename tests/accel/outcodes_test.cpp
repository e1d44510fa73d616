// The scan by outcodes: meshes whose triangles share their vertices, of any layout, count and place, one ray and many at a time.
#include "accel/linear_scan_testing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace raywise {
namespace {

using namespace scan_testing;

// A rough height field over [-1, 1]^2: half as many vertices as triangles. The last vertex is one of them.
struct Field {
    std::vector<Vec3> vertices;
    std::vector<std::uint64_t> indices;

    Field(std::size_t cells, unsigned seed, double scale = 1.0, const Vec3& center = Vec3(0.0)) {
        Random random(seed);
        const auto n = static_cast<double>(cells);
        for (std::size_t y = 0; y <= cells; ++y) {
            for (std::size_t x = 0; x <= cells; ++x) {
                const Vec3 p(2.0 * static_cast<double>(x) / n - 1.0, 2.0 * static_cast<double>(y) / n - 1.0,
                             random.uniform(-0.2, 0.2));
                vertices.push_back(center + scale * p);
            }
        }
        for (std::uint64_t y = 0; y < cells; ++y) {
            for (std::uint64_t x = 0; x < cells; ++x) {
                const std::uint64_t a = y * (cells + 1) + x;
                const std::uint64_t b = a + cells + 1;
                for (const std::uint64_t i : {a, a + 1, b, b + 1, b, a + 1}) indices.push_back(i);
            }
        }
    }
};

std::unique_ptr<World> world_of(const Field& field, const Layout& layout, AreasAre areas = AreasAre::settled_now) {
    auto world = std::make_unique<World>();
    world->add(field.vertices, field.indices, layout);
    world->finish(areas);
    return world;
}

bool all_suit(const World& world) { return suit_outcodes(world.primitives()); }

TEST(Outcodes, AreForMeshesThatShareTheirVertices) {
    EXPECT_TRUE(all_suit(*world_of(Field(12, 1), every_layout()[0])));
    EXPECT_FALSE(all_suit(*world_of(Field(11, 1), every_layout()[0]))) << "too few triangles";
    EXPECT_FALSE(all_suit(*world_of(Field(12, 1), every_layout()[1]))) << "no vertex is shared";
    EXPECT_TRUE(suits_outcodes(*world_of(Field(12, 1), every_layout()[1])->primitives().meshes()[0], 1));
    Field with_unused(12, 1);
    with_unused.vertices.resize(with_unused.indices.size() + 1);
    EXPECT_FALSE(suits_outcodes(*world_of(with_unused, every_layout()[0])->primitives().meshes()[0], 1));
    Field with_invalid(12, 1);
    with_invalid.indices[5] = with_invalid.vertices.size();
    World invalid;
    invalid.add(with_invalid.vertices, with_invalid.indices, every_layout()[0], true);
    invalid.finish();
    EXPECT_FALSE(all_suit(invalid));
    EXPECT_GT(check(invalid, 60, 1), 10u);
    // No triangle has this vertex, and nothing is known of how far it lies.
    Field with_bad_vertex(12, 1);
    with_bad_vertex.vertices.emplace_back(0.0, std::nan(""), 0.0);
    World bad;
    bad.add(with_bad_vertex.vertices, with_bad_vertex.indices, every_layout()[0], true);
    bad.finish();
    EXPECT_EQ(bad.primitives().invalid_count(), 0u);
    EXPECT_FALSE(all_suit(bad));
    EXPECT_GT(check(bad, 60, 1), 10u);
}

TEST(Outcodes, ReadEveryLayout) {
    for (const Layout& layout : every_layout()) {
        SCOPED_TRACE(layout.name);
        const auto world = world_of(Field(18, 2), layout);
        EXPECT_EQ(all_suit(*world), layout.indexed);
        EXPECT_GT(check(*world, 130, 2), 30u);
    }
}

TEST(Outcodes, AnswerForAnyCountOfTrianglesAndVertices) {
    const Field field(32, 3);
    for (const std::size_t count : {256, 257, 511, 512, 513, 1023, 1024, 1025, 2047}) {
        SCOPED_TRACE(count);
        Field part = field;
        part.indices.resize(3 * count);
        // As many vertices as it has, and none behind the last.
        part.vertices.resize(1 + *std::max_element(part.indices.begin(), part.indices.end()));
        const auto world = world_of(part, every_layout()[0]);
        EXPECT_TRUE(all_suit(*world));
        EXPECT_GT(check(*world, 40, static_cast<unsigned>(count)), 5u);
    }
}

TEST(Outcodes, AnswerAtAllScalesAndPlaces) {
    for (const double scale : {1e-37, 1e-30, 1e-12, 1e12, 1e30, 1e37}) {
        for (const std::size_t layout : {0, 6}) {
            SCOPED_TRACE(scale);
            EXPECT_GT(check(*world_of(Field(14, 4, scale), every_layout()[layout]), 60, 4), 15u);
        }
    }
    for (const double scale : {1e-300, 1e-100})
        EXPECT_GT(check(*world_of(Field(14, 4, scale), every_layout()[6]), 60, 4), 15u) << scale;
    EXPECT_GT(check(*world_of(Field(14, 4, 0.001, {5e6, -3e6, 4e6}), every_layout()[6]), 100, 4), 25u);
    EXPECT_GT(check(*world_of(Field(14, 4, 1.0, {5e6, 0.0, 0.0}), every_layout()[9]), 100, 4), 25u);
    for (const std::size_t layout : {0, 3})
        EXPECT_GT(check(*world_of(Field(14, 4, 1.0, {2e4, -3e4, 100.0}), every_layout()[layout]), 100, 4), 25u);
}

TEST(Outcodes, AnswerRaysFromVeryFarAway) {
    const auto world = world_of(Field(14, 5), every_layout()[0]);
    const Expected expected(*world, rays_from_far_away(*world));
    EXPECT_GT(expected.hits(), 50u);
    expect_answers_everywhere(*world, expected);
}

// Rays along the axes, in the planes of vertices: each edge and vertex is met exactly, and lies on no side of the ray.
TEST(Outcodes, LeaveWhatIsMetExactly) {
    const auto world = world_of(Field(16, 6), every_layout()[0]);
    std::vector<Ray> rays;
    for (int k = 0; k < 40; ++k) {
        const double at = -1.0 + 0.125 * (k % 17);
        rays.push_back({{at, -1.0 + 0.125 * (k % 13), 3.0}, 0.0, {0, 0, -1}, infinity});
        rays.push_back({{-4.0, at, 0.0}, 0.0, {1, 0, 0}, infinity});
        rays.push_back({{at, 4.0, 0.05}, 0.0, {0, -2, 0}, infinity});
    }
    const Expected expected(*world, rays);
    EXPECT_GT(expected.hits(), 60u);
    expect_answers_everywhere(*world, expected);
}

// Nearly all triangles have corners around nearly all rays.
TEST(Outcodes, GiveWayWhereTrianglesAreLarge) {
    Random random(7);
    Field tangle(2, 7);
    tangle.vertices.clear();
    tangle.indices.clear();
    for (int i = 0; i < 300; ++i) tangle.vertices.push_back(random.in_cube());
    for (std::uint64_t i = 0; i < 1800; ++i) tangle.indices.push_back((i * 7919 + i / 3) % 300);
    const auto world = world_of(tangle, every_layout()[0]);
    EXPECT_TRUE(all_suit(*world));
    EXPECT_GT(check(*world, 150, 7), 100u);
}

TEST(Outcodes, NumberThroughManyMeshes) {
    World world;
    unsigned seed = 0;
    for (const std::size_t cells : {1, 14, 3, 3, 20, 2}) {
        const Field field(cells, seed, 0.3, {0.1 * seed, 0.0, 0.2});
        world.add(field.vertices, field.indices, every_layout()[seed]);
        world.add(soup(seed * 60, 0.3, seed), every_layout()[seed]);
        ++seed;
    }
    world.finish();
    EXPECT_GT(check(world, 200, 8), 60u);
}

TEST(Outcodes, HeedSkipLists) {
    const auto world = world_of(Field(20, 9), every_layout()[0]);
    std::vector<std::uint32_t> skipped(world->primitives().count() / 2);
    std::iota(skipped.begin(), skipped.end(), 100);
    const std::vector<Ray> rays = rays_for(world->triangles(), world->primitives().bounds(), 150, 9);
    const Expected without(*world, rays, {skipped.data(), skipped.data() + skipped.size()});
    EXPECT_LT(without.hits(), Expected(*world, rays).hits());
    EXPECT_GT(without.hits(), 10u);
    expect_answers_everywhere(*world, without);
}

// Triangles without area, before anybody has told which those are.
TEST(Outcodes, NeedNoAreas) {
    Field field(18, 10);
    for (std::size_t i = 0; i + 2 < field.indices.size(); i += 15) field.indices[i + 1] = field.indices[i];
    const auto settled = world_of(field, every_layout()[0]);
    const Expected expected(*settled, rays_for(settled->triangles(), settled->primitives().bounds(), 150, 10));
    EXPECT_GT(expected.hits(), 30u);
    for (const bool few_rays : {false, true}) {
        const auto world = world_of(field, every_layout()[0], AreasAre::settled_on_demand);
        const LinearScan scan(world->input(few_rays));
        ASSERT_NO_FATAL_FAILURE(expect_answers(scan, expected));
        EXPECT_FALSE(world->primitives().are_areas_settled()) << "somebody has asked for them";
    }
    // The same where no triangle has area, and the scene no extent.
    const Triangles none(300, Corners{Vec3(1.0), Vec3(1.0), Vec3(1.0)});
    World nothing;
    nothing.add(none, every_layout()[0]);
    nothing.finish(AreasAre::settled_on_demand);
    const Expected misses(nothing, {{Vec3(0.0), 0.0, Vec3(1.0), infinity}, {Vec3(1.0), 0.0, Vec3(1.0), infinity}});
    EXPECT_EQ(misses.hits(), 0u);
    expect_answers(LinearScan(nothing.input(true)), misses);
}

TEST(Outcodes, TakeThePlaceOfLargeBlocks) {
    const auto small = world_of(Field(90, 11), every_layout()[0]);
    const auto large = world_of(Field(91, 11), every_layout()[0]);
    const auto apart = world_of(Field(91, 11), every_layout()[1]);
    EXPECT_TRUE(LinearScan(small->input()).is_gathered());
    const LinearScan scan(large->input());
    EXPECT_FALSE(scan.is_gathered());
    EXPECT_EQ(scan.bytes(), sizeof(LinearScan));
    EXPECT_TRUE(LinearScan(apart->input()).is_gathered());
    const Expected expected(*large, rays_for(large->triangles(), large->primitives().bounds(), 40, 11));
    EXPECT_GT(expected.hits(), 10u);
    expect_answers(scan, expected);
}

} // namespace
} // namespace raywise
