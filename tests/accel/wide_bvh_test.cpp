// What is special about the tree that rays are traced in: float32 coordinates in a frame of their own, and a walk for each level of vector
// instructions. tests/accel/bvh_test.cpp compares its answers over many scenes.
#include "accel/bvh/node.h"

#include "accel/bvh/bvh.h"
#include "accel/bvh_testing.h"
#include "geometry/every_target.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <memory>
#include <set>

namespace raywise {
namespace {

using namespace bvh_testing;

// In float32: corners that a tree gives back without loss where the scene is around the origin.
Triangles rounded(Triangles triangles) {
    for (Corners& corners : triangles) {
        for (Vec3& corner : corners) corner = through_float(corner);
    }
    return triangles;
}

// Rays near the scene and far from it, along axes and nearly so, short and long, starting on triangles and beside them.
Ray varied_ray(const Triangles& triangles, const Box& bounds, int i, Random& random) {
    Ray ray = any_ray(triangles, bounds, random);
    const Corners& corners =
        triangles[static_cast<std::size_t>(random.integer(0, static_cast<int>(triangles.size()) - 1))];
    const Vec3 target = (corners[0] + corners[1] + corners[2]) / 3.0;
    const double size = max_component(bounds.size());
    switch (i % 6) {
        case 0:
            ray.origin = target + random.direction() * size * std::pow(10.0, random.uniform(0.0, 20.0));
            ray.direction = target - ray.origin;
            break;
        case 1:
            ray.origin = target;
            ray.direction = random.direction();
            ray.tmin = i % 4 == 0 ? 0.0 : 1e-5 * size;
            break;
        case 2:
            ray.origin = target - Vec3(3.0 * size, 0.0, 0.0);
            ray.direction = Vec3(1.0, std::pow(10.0, random.uniform(-310.0, 0.0)), i % 4 == 0 ? 0.0 : -1e-30);
            break;
        case 3:
            ray.direction *= std::pow(10.0, random.uniform(-200.0, 200.0));
            ray.tmin = -infinity;
            break;
        case 4:
            ray.origin = target + random.direction() * size * 1e-9;
            ray.direction = random.direction();
            break;
        default:
            break;
    }
    return ray;
}

void expect_same_on_every_target(const Triangles& triangles, int rays, unsigned seed) {
    Scene scene(triangles);
    const Bvh bvh(scene.input());
    on_every_target([&] {
        Random random(seed);
        int hits = 0;
        for (int i = 0; i < rays && !testing::Test::HasFailure(); ++i) {
            const Ray ray = varied_ray(triangles, scene.bounds(), i, random);
            hits += expect_same_with_intervals(scene, bvh, ray) ? 1 : 0;
        }
        EXPECT_GT(hits, rays / 20) << "the rays have to test something";
    });
}

TEST(WideBvh, KeepsCornersAsTheyWereGiven) {
    Scene floats(rounded(soup(500, 0.2, 1)));
    EXPECT_FALSE(Bvh(floats.input()).tree().is_float64);
    Scene doubles(soup(500, 0.2, 1));
    const Bvh bvh(doubles.input());
    EXPECT_TRUE(bvh.tree().is_float64);
    for (std::size_t n = 0; n < bvh.tree().nodes.size(); ++n) {
        for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
            const NodeRef child = bvh.tree().nodes[n].child[i];
            if (is_empty_child(bvh.tree().nodes[n], i) || !child.is_leaf()) continue;
            for_each_block<double>(bvh.tree(), child, [&](const TriangleBlock<double>& block) {
                for (std::uint32_t k = 0; k < block.n; ++k) {
                    EXPECT_EQ(block.corners(k), doubles.primitives().corners(block.id(k)));
                    for (const Vec3& corner : block.corners(k))
                        EXPECT_LE(max_component(magnitudes(corner - bvh.tree().frame.center())), child.distance());
                }
            });
        }
    }
}

TEST(WideBvh, TheSameOnEveryTarget) {
    expect_same_on_every_target(rounded(soup(300, 0.2, 2)), 240, 2);
    expect_same_on_every_target(soup(300, 0.05, 3), 240, 3);
}

TEST(WideBvh, TheSameOnEveryTargetAtAllScales) {
    for (const double scale : {1e-300, 1e-38, 1e-20, 1e20, 1e38})
        expect_same_on_every_target(soup(100, 0.3, 4, scale), 60, 4);
}

TEST(WideBvh, TheSameOnEveryTargetFarFromTheOrigin) {
    expect_same_on_every_target(soup(200, 0.2, 5, 1e-3, Vec3(5e6, -5e6, 5e6)), 120, 5);
}

// Whatever eight numbers come: a ray that nothing can be said of hits nothing.
TEST(WideBvh, AnyNumbersOfFloat32OnEveryTarget) {
    using Limits = std::numeric_limits<float>;
    const float numbers[] = {0.0f,
                             -0.0f,
                             1.0f,
                             -1.0f,
                             0.3f,
                             -0.7f,
                             Limits::denorm_min(),
                             -Limits::min(),
                             Limits::max(),
                             -Limits::max(),
                             Limits::infinity(),
                             -Limits::infinity(),
                             Limits::quiet_NaN(),
                             0x1p-60f,
                             0x1p60f,
                             -0x1p61f,
                             0x1p-61f,
                             0x1p-100f};
    for (const double scale : {1.0, 0x1p-58, 0x1p-62, 0x1p62, 0x1p120}) {
        for (const bool is_far : {false, true}) {
            const Vec3 center(is_far ? 1e6 * scale : 0.0);
            const Triangles triangles = soup(60, 0.6, 8, scale, center);
            Scene scene(triangles);
            const Bvh bvh(scene.input());
            on_every_target([&] {
                Random random(9);
                const auto any_number = [&] {
                    return numbers[random.integer(0, static_cast<int>(std::size(numbers)) - 1)];
                };
                for (int i = 0; i < 3000 && !testing::Test::HasFailure(); ++i) {
                    RayF ray = rounded_to_float(any_ray(triangles, scene.bounds(), random));
                    for (int changes = random.integer(0, 3); changes > 0; --changes) {
                        const int axis = random.integer(0, 2);
                        switch (random.integer(0, 3)) {
                            case 0:
                                ray.origin[axis] = any_number();
                                break;
                            case 1:
                                ray.direction[axis] = any_number();
                                break;
                            case 2:
                                ray.tmin = any_number();
                                break;
                            default:
                                ray.tmax = any_number();
                                break;
                        }
                    }
                    expect_same_f32(scene, bvh, ray);
                }
            });
        }
    }
}

TEST(WideBvh, MoreTrianglesInALeafThanInABlock) {
    const Corners corners = {Vec3(0.0), Vec3(1.0, 0.0, 0.5), Vec3(0.0, 1.0, 0.5)};
    for (const std::size_t count : {1u, 7u, 8u, 9u, 15u, 16u, 17u, 300u}) {
        expect_same_on_every_target(Triangles(count, corners), 60, static_cast<unsigned>(count));
    }
}

TEST(WideBvh, SkippedTrianglesAreNotHit) {
    Triangles triangles = rounded(soup(100, 0.6, 6));
    Scene scene(triangles);
    const Bvh bvh(scene.input());
    on_every_target([&] {
        Random random(6);
        int checked = 0;
        for (int i = 0; i < 200; ++i) {
            const Ray ray = any_ray(triangles, scene.bounds(), random);
            const PrimitiveHit first = bvh.closest(ray, {});
            if (!first.is_hit()) continue;
            const Query query{{&first.primitive, &first.primitive + 1}};
            const PrimitiveHit expected = oracle::PlainScan(scene.input()).closest(ray, query);
            EXPECT_TRUE(same_hit(bvh.closest(ray, query), expected)) << text_of(ray);
            EXPECT_EQ(bvh.any(ray, query), expected.is_hit()) << text_of(ray);
            ++checked;
        }
        EXPECT_GT(checked, 50);
    });
}

// Rays of which some hit nothing for certain, some cannot be traced, and some skip what they would hit first.
struct ManyRays {
    std::vector<Ray> rays;
    std::vector<std::uint32_t> skipped;
    std::vector<Query> queries;
    std::vector<PrimitiveHit> closest; // expected

    ManyRays(Scene& scene, const Triangles& triangles, std::size_t count, unsigned seed) {
        Random random(seed);
        const oracle::PlainScan scan(scene.input());
        skipped.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            Ray ray = varied_ray(triangles, scene.bounds(), static_cast<int>(i), random);
            if (i % 17 == 3) ray.direction = -ray.direction;
            if (i % 29 == 5) ray.tmax = ray.tmin - 1.0;
            if (i % 31 == 7) ray.origin.y = std::numeric_limits<double>::quiet_NaN();
            if (i % 37 == 11) ray.direction.z = std::numeric_limits<double>::quiet_NaN();
            if (i % 41 == 13) ray.direction = Vec3(0.0);
            rays.push_back(ray);
            queries.emplace_back();
            closest.push_back(scan.closest(ray, {}));
            if (i % 5 == 2 && closest.back().is_hit()) {
                skipped[i] = closest.back().primitive;
                queries.back().skip = {&skipped[i], &skipped[i] + 1};
                closest.back() = scan.closest(ray, queries.back());
            }
        }
    }
};

void expect_same_of_many(const Bvh& bvh, const ManyRays& many, std::size_t begin, std::size_t count) {
    const RayPacket rays{&many.rays[begin], &many.queries[begin], count};
    std::vector<PrimitiveHit> hits(count, PrimitiveHit{-1.0, 0.0, 0.0, 0});
    const auto found = std::make_unique<bool[]>(count);
    std::fill_n(found.get(), count, true);
    Scratch scratch;
    bvh.closest_many(rays, hits.data(), scratch);
    bvh.any_many(rays, found.get(), scratch);
    for (std::size_t i = 0; i < count; ++i) {
        const PrimitiveHit& expected = many.closest[begin + i];
        ASSERT_TRUE(same_hit(hits[i], expected)) << "ray " << i << " of " << count << ": " << text_of(rays.rays[i]);
        ASSERT_EQ(found[i], expected.is_hit()) << "ray " << i << " of " << count << ": " << text_of(rays.rays[i]);
    }
}

TEST(WideBvh, ManyRaysTogetherAreAnsweredAsEachAlone) {
    const std::vector<Triangles> scenes = {rounded(soup(2000, 0.1, 8)), soup(500, 0.3, 9, 1e-20),
                                           soup(300, 0.2, 10, 1e-3, Vec3(5e6, -5e6, 5e6)), soup(5, 0.5, 11)};
    for (const Triangles& triangles : scenes) {
        Scene scene(triangles);
        const Bvh bvh(scene.input());
        const ManyRays many(scene, triangles, 1500, 12);
        const auto hits = std::count_if(many.closest.begin(), many.closest.end(),
                                        [](const PrimitiveHit& hit) { return hit.is_hit(); });
        EXPECT_GT(hits, 100);
        on_every_target([&] {
            // Below, at and beyond what makes a stream, and what vectors hold.
            for (const std::size_t count : {1u, 2u, 31u, 32u, 33u, 47u, 48u, 100u, 1500u})
                ASSERT_NO_FATAL_FAILURE(expect_same_of_many(bvh, many, many.rays.size() - count, count));
        });
    }
}

TEST(WideBvh, OneRayManyTimes) {
    const Triangles triangles = rounded(soup(3000, 0.1, 13));
    Scene scene(triangles);
    const Bvh bvh(scene.input());
    Ray ray;
    ray.origin = Vec3(0.1, 0.2, -5.0);
    ray.direction = Vec3(0.01, 0.02, 1.0);
    ManyRays many(scene, triangles, 0, 14);
    many.rays.resize(700, ray);
    many.queries.resize(700);
    many.closest.resize(700, oracle::PlainScan(scene.input()).closest(ray, {}));
    ASSERT_TRUE(many.closest[0].is_hit());
    on_every_target([&] { expect_same_of_many(bvh, many, 0, 700); });
}

TEST(WideBvh, EveryTriangleIsInOneLeaf) {
    for (const std::size_t count : {1u, 6u, 7u, 100u, 40000u}) {
        Scene scene(soup(count, 0.02, 7), 0);
        const Bvh bvh(scene.input());
        const WideBvh& tree = bvh.tree();
        std::multiset<std::uint32_t> nodes;
        std::vector<std::uint32_t> found;
        for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
            const WideNode& node = tree.nodes[n];
            for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
                if (is_empty_child(node, i)) continue;
                const NodeRef child = node.child[i];
                if (!child.is_leaf()) {
                    EXPECT_GT(child.index(), n) << "parents come before their children";
                    nodes.insert(child.index());
                    continue;
                }
                for_each_block<double>(tree, child, [&](const TriangleBlock<double>& block) {
                    for (std::uint32_t k = 0; k < block.n; ++k) found.push_back(block.id(k));
                });
            }
        }
        EXPECT_EQ(nodes.size() + 1, tree.nodes.size()) << "every node but the root has one parent";
        EXPECT_EQ(std::set<std::uint32_t>(nodes.begin(), nodes.end()).size(), nodes.size());
        std::sort(found.begin(), found.end());
        ASSERT_EQ(found.size(), count);
        for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(found[i], i);
    }
}

} // namespace
} // namespace raywise
