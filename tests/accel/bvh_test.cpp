#include "accel/bvh/bvh.h"

#include "accel/bvh/binary_traversal.h"
#include "accel/bvh_testing.h"

#include <algorithm>
#include <atomic>

namespace raywise {
namespace {

using namespace bvh_testing;

void expect_same_answers(const Triangles& triangles, int rays, unsigned seed) {
    Scene scene(triangles);
    const Bvh bvh(scene.input());
    Random random(seed);
    int hits = 0;
    for (int i = 0; i < rays && !testing::Test::HasFailure(); ++i) {
        hits += expect_same_with_intervals(scene, bvh, any_ray(triangles, scene.bounds(), random)) ? 1 : 0;
    }
    EXPECT_GT(hits, rays / 20) << "the rays have to test something";
}

TEST(Bvh, NothingToHit) {
    for (const Triangles& triangles : {Triangles{}, Triangles{{Vec3(0.0), Vec3(1.0), Vec3(2.0)}}})
        expect_nothing_to_hit<Bvh>(triangles);
}

TEST(Bvh, OneTriangle) {
    expect_same_answers({{Vec3(0.0, 0.0, 1.0), Vec3(1.0, 0.0, 1.5), Vec3(0.0, 1.0, 2.0)}}, 500, 1);
}

TEST(Bvh, Soups) {
    unsigned seed = 10;
    for (const std::size_t count : {2u, 5u, 13u, 40u, 300u, 5000u}) {
        for (const double size : {0.02, 0.2, 1.0}) {
            ++seed;
            expect_same_answers(soup(count, size, seed), count > 1000 ? 60 : 300, seed);
        }
    }
}

TEST(Bvh, GridOfBoxesWithAxisParallelRays) {
    const int n = 4;
    const Triangles triangles = grid_of_boxes(n);
    Scene scene(triangles);
    const Bvh bvh(scene.input());
    for (int axis = 0; axis < 3; ++axis) {
        // Through corners, edges and faces, from outside, from within and from on a face; and just beside.
        for (double a = -0.5; a <= n + 0.5; a += 0.5) {
            for (double b = -0.5; b <= n + 0.5; b += 0.5) {
                for (const double start : {-1.0, 0.0, 1.5, 2.0}) {
                    for (const double sign : {1.0, -1.0}) {
                        Ray ray;
                        ray.origin[axis] = start;
                        ray.origin[(axis + 1) % 3] = a;
                        ray.origin[(axis + 2) % 3] = std::nextafter(b, start * infinity);
                        ray.direction[axis] = sign;
                        expect_same(scene, bvh, ray);
                        ray.origin[(axis + 2) % 3] = b;
                        expect_same(scene, bvh, ray);
                        ray.direction[(axis + 1) % 3] = -0.0;
                        ray.direction[(axis + 2) % 3] = 1e-300;
                        expect_same(scene, bvh, ray);
                    }
                }
            }
        }
    }
    expect_same_answers(triangles, 300, 3);
}

TEST(Bvh, FlatScenes) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const double height : {0.0, 1.0, -1e6}) expect_same_answers(flat(8, axis, height), 200, 4);
    }
}

TEST(Bvh, AllScales) {
    for (const double scale : {1e-30, 1e-8, 1e8, 1e30, 1e38}) expect_same_answers(soup(200, 0.3, 5, scale), 200, 6);
}

TEST(Bvh, FarFromTheOriginOfCoordinates) {
    // Millimetres at 5,000 km, in float64; one axis only; and float32's last bits.
    expect_same_answers(soup(500, 0.2, 7, 1e-3, Vec3(5e6, -5e6, 5e6)), 300, 7);
    expect_same_answers(soup(500, 0.2, 8, 1.0, Vec3(0.0, 5e6, 0.0)), 300, 8);
    expect_same_answers(soup(500, 0.2, 9, 10.0, Vec3(1e16)), 300, 9); // corners on a coarse grid
}

TEST(Bvh, FarScenesKeepTheirDetail) {
    // Boxes of float32 at 5,000 km would all be the same; a ray would meet all of them.
    const Triangles triangles = soup(5000, 0.01, 7, 1e-2, Vec3(5e6, -5e6, 5e6));
    Scene scene(triangles);
    const BvhTree tree = build_bvh(scene.input());
    const CellRay ray(ExactRay(ray_between(scene.bounds().lower, scene.bounds().upper)), scene.bounds(),
                      scene.primitives().largest_extent());
    std::uint32_t count = 0;
    traverse_boxes(tree, ray, [&](const BvhNode& leaf, double&) {
        count += leaf.count;
        return false;
    });
    EXPECT_LT(count, 500u);
}

TEST(Bvh, DegenerateTrianglesAreLeftOut) {
    Triangles triangles = soup(300, 0.3, 11);
    Random random(12);
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        triangles[i][2] = i % 2 == 0 ? triangles[i][0] : 0.5 * triangles[i][0] + 0.5 * triangles[i][1];
    }
    triangles[7][1].x = std::numeric_limits<double>::quiet_NaN(); // skipped: invalid
    Scene scene(triangles);
    const Bvh bvh(scene.input());
    EXPECT_EQ(build_bvh(scene.input()).references.size(), scene.primitives().hittable_count());
    triangles.erase(triangles.begin() + 7);
    for (int i = 0; i < 300; ++i) expect_same_with_intervals(scene, bvh, any_ray(triangles, scene.bounds(), random));
}

TEST(Bvh, DuplicatesTieToTheLowestNumber) {
    Triangles triangles = soup(100, 0.4, 13);
    const Triangles copy = triangles;
    for (int i = 0; i < 3; ++i) triangles.insert(triangles.end(), copy.begin(), copy.end());
    expect_same_answers(triangles, 300, 14);
}

struct Shape {
    int depth = 0;
    std::uint32_t largest_leaf = 0;
    std::uint64_t references = 0;
};

void measure(const BvhTree& tree, const BvhNode& node, int depth, Shape& shape) {
    shape.depth = std::max(shape.depth, depth);
    if (node.is_leaf()) {
        shape.largest_leaf = std::max(shape.largest_leaf, node.count);
        shape.references += node.count;
        return;
    }
    for (const BvhNode& child : tree.pairs[node.first].child) {
        if (!child.is_leaf()) {
            EXPECT_GT(child.first, node.first);
        }
        measure(tree, child, depth + 1, shape);
    }
}

Shape shape_of(const BvhTree& tree) {
    Shape shape;
    measure(tree, tree.root, 0, shape);
    return shape;
}

TEST(Bvh, IdenticalTriangles) {
    const Corners corners = {Vec3(0.0), Vec3(1.0, 0.0, 0.5), Vec3(0.0, 1.0, 0.5)};
    Scene scene(Triangles(100000, corners));
    const Bvh bvh(scene.input());
    const Shape shape = shape_of(build_bvh(scene.input()));
    EXPECT_LE(shape.depth, 20);
    EXPECT_LE(shape.largest_leaf, 16u);
    expect_same(scene, bvh, {Vec3(0.25, 0.25, -1.0), 0.0, Vec3(0.0, 0.0, 1.0), infinity});
    expect_same(scene, bvh, {Vec3(2.0, 0.25, -1.0), 0.0, Vec3(0.0, 0.0, 1.0), infinity});
}

TEST(Bvh, DepthIsBounded) {
    // Each triangle half as large and half as far as the one before: the heuristic would cut them off one by one.
    Triangles triangles;
    double scale = 1e30;
    for (int i = 0; i < 230; ++i, scale *= 0.5) {
        for (int copy = 0; copy < 20; ++copy) {
            triangles.push_back(
                {scale * Vec3(1.0, 0.0, 0.1), scale * Vec3(1.0, 0.1, 0.0), scale * Vec3(1.1, 0.0, 0.0)});
        }
    }
    Scene scene(triangles);
    const Bvh bvh(scene.input());
    const Shape shape = shape_of(build_bvh(scene.input()));
    EXPECT_LE(shape.depth, bvh_max_depth);
    EXPECT_GT(shape.depth, bvh_max_depth / 2) << "the scene should have strained the bound";
    EXPECT_EQ(shape.references, triangles.size());
    Random random(15);
    for (int i = 0; i < 40; ++i) expect_same(scene, bvh, any_ray(triangles, scene.bounds(), random));
}

TEST(Bvh, EveryPrimitiveIsInOneLeaf) {
    for (const std::size_t count : {1u, 2u, 17u, 5000u, 20000u}) {
        Scene scene(soup(count, 0.02, 16));
        const BvhTree tree = build_bvh(scene.input());
        PageVector<std::uint32_t> references = tree.references;
        std::sort(references.begin(), references.end());
        ASSERT_EQ(references.size(), count);
        for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(references[i], i);
        EXPECT_EQ(shape_of(tree).references, count);
        EXPECT_LE(shape_of(tree).largest_leaf, 16u);
    }
}

TEST(Bvh, TheSameTreeForAnyNumberOfThreads) {
    const Triangles triangles = soup(60000, 0.01, 17);
    Scene one(triangles, 1);
    Scene many(triangles, 0);
    const BvhTree a = build_bvh(one.input());
    const BvhTree b = build_bvh(many.input());
    ASSERT_EQ(a.pairs.size(), b.pairs.size());
    EXPECT_EQ(std::memcmp(a.pairs.data(), b.pairs.data(), a.pairs.size() * sizeof(BvhPair)), 0);
    EXPECT_EQ(a.references, b.references);
    const Bvh wide_a(one.input());
    const Bvh wide_b(many.input());
    const WideBvh& c = wide_a.tree();
    const WideBvh& d = wide_b.tree();
    ASSERT_EQ(c.bytes(), d.bytes());
    EXPECT_EQ(std::memcmp(c.nodes.data(), d.nodes.data(), c.nodes.bytes()), 0);
    EXPECT_EQ(std::memcmp(c.blocks.data(), d.blocks.data(), c.blocks.bytes()), 0);
}

TEST(Bvh, ProgressRisesAndCancels) {
    Scene scene(soup(200000, 0.01, 18));
    const Parallel parallel(1);
    double last = 0.0;
    int reports = 0;
    Progress progress([&](double fraction, const char* stage) {
        EXPECT_GE(fraction, last);
        EXPECT_LE(fraction, 1.0);
        EXPECT_NE(stage, nullptr);
        last = fraction;
        ++reports;
        return false;
    });
    const Bvh bvh({scene.primitives(), {}, {}, parallel, progress});
    EXPECT_GT(reports, 10);
    EXPECT_GT(last, 0.7);

    for (const int stop : {1, 5, 30}) {
        const Parallel two(2);
        std::atomic<int> calls{0};
        Progress stopping([&](double, const char*) { return ++calls >= stop; });
        try {
            const Bvh cancelled({scene.primitives(), {}, {}, two, stopping});
            FAIL() << "not cancelled";
        } catch (const Error& error) {
            EXPECT_EQ(error.status(), Status::ERROR_CANCELLED);
        }
    }
}

} // namespace
} // namespace raywise
