// The linear scan against a plain loop over the exact test, bit for bit: read in place and gathered, ray by ray and many rays at a time,
// at every level of vector instructions.
#include "accel/linear_scan_testing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>

namespace raywise {
namespace {

using namespace scan_testing;

TEST(LinearScan, AnswersForAnyCountOfTriangles) {
    std::size_t hits = 0;
    for (const std::size_t count : {0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 100, 511, 512, 513, 1030}) {
        SCOPED_TRACE(count);
        for (const std::size_t layout : {0, 1, 6}) {
            const auto world = world_of(soup(count, 0.5, static_cast<unsigned>(count)), every_layout()[layout]);
            hits += check(*world, 40, static_cast<unsigned>(count));
        }
    }
    EXPECT_GT(hits, 500u);
}

TEST(LinearScan, ReadsEveryLayout) {
    for (const Layout& layout : every_layout()) {
        SCOPED_TRACE(layout.name);
        const auto world = world_of(ball(20, 1.0), layout);
        EXPECT_GT(check(*world, 100, 2), 30u);
    }
}

TEST(LinearScan, AnswersAtAllScales) {
    for (const std::size_t layout : {0, 6}) {
        for (const double scale : {1e-37, 1e-30, 1e-12, 1e12, 1e30, 1e37}) {
            SCOPED_TRACE(scale);
            const auto world = world_of(soup(300, 0.2, 3, scale), every_layout()[layout]);
            EXPECT_GT(check(*world, 100, 3), 30u);
        }
    }
    for (const double scale : {1e-300, 1e-100}) {
        SCOPED_TRACE(scale);
        EXPECT_GT(check(*world_of(soup(300, 0.2, 3, scale), every_layout()[6]), 100, 3), 30u);
    }
}

TEST(LinearScan, AnswersFarFromTheOrigin) {
    // Millimetres, 5,000 km away.
    EXPECT_GT(check(*world_of(soup(300, 0.2, 4, 0.001, {5e6, -3e6, 4e6}), every_layout()[6]), 200, 4), 60u);
    EXPECT_GT(check(*world_of(soup(300, 0.2, 4, 1.0, {5e6, 0.0, 0.0}), every_layout()[9]), 200, 4), 60u);
    for (const std::size_t layout : {0, 3}) {
        EXPECT_GT(check(*world_of(soup(300, 0.2, 4, 1.0, {2e4, -3e4, 100.0}), every_layout()[layout]), 200, 4), 60u);
    }
}

TEST(LinearScan, AnswersRaysFromVeryFarAway) {
    const auto world = world_of(ball(6, 1.0), every_layout()[0]);
    const Expected expected(*world, rays_from_far_away(*world));
    EXPECT_GT(expected.hits(), 60u);
    expect_answers_everywhere(*world, expected);
}

// A triangle that is a line in float32, before a ray of which float32 knows nothing.
TEST(LinearScan, SeesASliverThatFloat32DoesNot) {
    Triangles triangles = {{Vec3(0, 0, -1), Vec3(0, 0, 1), Vec3(1e-200, 1e-200, 0)}};
    const auto world = world_of(triangles, {"float64 in threes", Scalar::float64, 0, false, false});
    std::vector<Ray> rays;
    for (const double distance : {1.0, 1e3, 1e12, 1e30, 1e300}) {
        rays.push_back({{-distance, 2.5e-201, 0.0}, 0.0, {1, 0, 0}, infinity});
        rays.push_back({{2.5e-201, distance, 0.0}, 0.0, {0, -1, 0}, infinity});
        rays.push_back({{-distance, -2.5e-201, 0.0}, 0.0, {1, 0, 0}, infinity});
    }
    const Expected expected(*world, rays);
    EXPECT_EQ(expected.hits(), 10u);
    expect_answers_everywhere(*world, expected);
}

TEST(LinearScan, AnswersForAFinePartOfALargeScene) {
    Triangles triangles = ball(12, 0.003);
    add_quad(triangles, {-1, -1, -0.5}, {2, 0, 0}, {0, 2, 0});
    add_quad(triangles, {-1, -1, 1}, {2, 0, 0}, {0, 2, 0});
    EXPECT_GT(check(*world_of(triangles, every_layout()[0]), 100, 6), 30u);
}

TEST(LinearScan, GivesTiesToTheLowestNumber) {
    Triangles triangles = soup(200, 0.4, 7);
    const Triangles same = triangles;
    for (int i = 0; i < 3; ++i) triangles.insert(triangles.end(), same.begin(), same.end());
    const Triangles squares = flat(6, 2, 0.25);
    for (int i = 0; i < 2; ++i) triangles.insert(triangles.end(), squares.begin(), squares.end());
    for (const std::size_t layout : {1, 8}) // without indices, so that all are as they are here
        EXPECT_GT(check(*world_of(triangles, every_layout()[layout]), 200, 7), 60u);
}

TEST(LinearScan, PassesOverWhatCannotBeHit) {
    for (const Layout& layout : every_layout()) {
        SCOPED_TRACE(layout.name);
        Triangles triangles = soup(100, 0.4, 8);
        for (std::size_t i = 0; i < triangles.size(); i += 3) {
            Corners& c = triangles[i];
            c[2] = i % 2 == 0 ? c[0] : c[0] + 2.0 * (c[1] - c[0]);
            if (i % 4 == 0) c = {Vec3(1e38), Vec3(-1e38), Vec3(1e38)}; // far outside of all that can be hit
        }
        EXPECT_GT(check(*world_of(triangles, layout), 30, 8), 8u);

        World invalid;
        Unshared mesh(triangles);
        mesh.vertices[40].x = std::nan("");
        mesh.vertices[200].z = infinity;
        mesh.vertices.back().y = -infinity;
        if (layout.indexed) mesh.indices[100] = mesh.vertices.size();
        if (layout.indexed) mesh.indices[101] = 0xFFFFFFFF;
        invalid.add(mesh.vertices, mesh.indices, layout, true);
        invalid.finish();
        EXPECT_GE(invalid.primitives().invalid_count(), 3u);
        EXPECT_GT(check(invalid, 30, 8), 8u);
    }
    World nothing;
    nothing.add(Triangles(20, Corners{Vec3(1.0), Vec3(1.0), Vec3(1.0)}), every_layout()[0]);
    nothing.finish();
    EXPECT_EQ(check(nothing, 20, 8), 0u);
}

TEST(LinearScan, NumbersThroughManyMeshes) {
    World world;
    unsigned seed = 0;
    for (const std::size_t count : {1, 5, 0, 17, 3, 100, 16, 700, 2, 33}) {
        world.add(soup(count, 0.4, seed), every_layout()[seed % every_layout().size()]);
        ++seed;
    }
    world.add(soup(4, 0.4, 99), {"with invalid ones"}, true);
    world.finish();
    EXPECT_GT(check(world, 300, 9), 100u);
}

TEST(LinearScan, HeedsSkipLists) {
    const auto world = world_of(ball(16, 1.0), every_layout()[0]);
    std::vector<std::uint32_t> skipped;
    for (std::uint32_t i = 0; i < world->primitives().count(); ++i) {
        if (i % 3 != 0) skipped.push_back(i);
    }
    const std::vector<Ray> rays = rays_for(world->triangles(), world->primitives().bounds(), 200, 10);
    const Expected without(*world, rays, {skipped.data(), skipped.data() + skipped.size()});
    EXPECT_LT(without.hits(), Expected(*world, rays).hits());
    EXPECT_GT(without.hits(), 20u);
    expect_answers_everywhere(*world, without);
}

TEST(LinearScan, AnswersInAnInterval) {
    const auto world = world_of(grid_of_boxes(3), every_layout()[6]);
    const Triangles triangles = world->triangles();
    Random random(11);
    std::vector<Ray> rays;
    for (int i = 0; i < 40; ++i) {
        Ray ray = any_ray(triangles, world->primitives().bounds(), random);
        const Expected whole(*world, {ray});
        rays.push_back(ray);
        if (whole.all.empty() || whole.all[0].empty()) continue;
        const double first = whole.all[0].front().t;
        const double last = whole.all[0].back().t;
        const std::pair<double, double> intervals[] = {{first, last},
                                                       {first, first},
                                                       {std::nextafter(first, infinity), last},
                                                       {first, std::nextafter(last, -infinity)},
                                                       {0.0, std::nextafter(first, -infinity)},
                                                       {-infinity, infinity},
                                                       {-infinity, 0.0}};
        for (const auto& [tmin, tmax] : intervals) {
            ray.tmin = tmin;
            ray.tmax = tmax;
            rays.push_back(ray);
        }
    }
    const Expected expected(*world, rays);
    EXPECT_GT(expected.hits(), 100u);
    expect_answers_everywhere(*world, expected);
}

TEST(LinearScan, ReadsInPlaceWhenBlocksDoNotFitTheMemoryLimit) {
    const auto world = world_of(soup(1000, 0.2, 12), every_layout()[0]);
    const LinearScan gathered(world->input(false));
    const LinearScan in_place(world->input(true));
    const LinearScan just(world->input(false, gathered.bytes()));
    const LinearScan short_of_it(world->input(false, gathered.bytes() - 1));
    EXPECT_TRUE(just.is_gathered());
    EXPECT_FALSE(short_of_it.is_gathered());
    EXPECT_GE(gathered.bytes(), 36000u);
    EXPECT_LT(gathered.bytes(), 40000u);
    EXPECT_EQ(in_place.bytes(), sizeof(LinearScan));
    EXPECT_EQ(short_of_it.bytes(), sizeof(LinearScan));
}

TEST(LinearScan, ReportsProgressWhileItGathersAndStopsWhenTold) {
    const auto world = world_of(soup(300000, 0.01, 13), every_layout()[0]);
    const Parallel two(2);
    int calls = 0;
    Progress counting([&](double fraction, const char*) {
        EXPECT_GE(fraction, 0.0);
        EXPECT_LE(fraction, 1.0);
        ++calls;
        return false;
    });
    const LinearScan counted({world->primitives(), {}, {}, two, counting});
    EXPECT_GE(calls, 3);
    Progress stopping([](double, const char*) { return true; });
    EXPECT_THROW(LinearScan({world->primitives(), {}, {}, two, stopping}), Error);
}

} // namespace
} // namespace raywise
