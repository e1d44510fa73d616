// Worlds of meshes in any layout, and what a linear scan has to answer about them.
#pragma once

#include "accel/scan/linear_scan.h"

#include "accel/bvh_testing.h"
#include "geometry/every_target.h"
#include "geometry/laid_out_mesh.h"
#include "oracle/plain_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace raywise::scan_testing {

using namespace bvh_testing;
using oracle::PlainScan;

// Vertices that no two triangles share, and their numbers.
struct Unshared {
    std::vector<Vec3> vertices;
    std::vector<std::uint64_t> indices;

    explicit Unshared(const Triangles& triangles) {
        for (const Corners& corners : triangles) {
            for (const Vec3& p : corners) {
                indices.push_back(vertices.size());
                vertices.push_back(p);
            }
        }
    }
};

// Meshes, each in a layout of its own, with all that a build asks for.
class World {
public:
    void add(const Triangles& triangles, const Layout& layout, bool skip_invalid = false) {
        Unshared mesh(triangles);
        // Some begin with the last vertex of all, which has nothing behind it to be read.
        for (std::size_t i = 0; i + 3 < mesh.indices.size(); i += 57) mesh.indices[i] = mesh.vertices.size() - 1;
        add(mesh.vertices, mesh.indices, layout, skip_invalid);
    }
    void add(const std::vector<Vec3>& vertices, const std::vector<std::uint64_t>& indices, const Layout& layout,
             bool skip_invalid = false) {
        laid_out_.push_back(std::make_unique<LaidOutMesh>(vertices, indices, layout));
        meshes_.push_back(laid_out_.back()->shared(skip_invalid));
    }
    void finish(AreasAre areas = AreasAre::settled_now) {
        primitives_ = std::make_unique<Primitives>(meshes_, Parallel(1), areas);
    }

    const Primitives& primitives() const { return *primitives_; }
    BuildInput input(bool few_rays = false, std::uint64_t memory_limit = 0) {
        return {*primitives_, {}, {}, parallel_, progress_, few_rays, memory_limit};
    }
    Triangles triangles() const {
        Triangles all;
        for (std::uint32_t i = 0; i < primitives_->count(); ++i) {
            if (primitives_->is_hittable(i)) all.push_back(primitives_->corners(i));
        }
        return all;
    }

private:
    std::vector<std::unique_ptr<LaidOutMesh>> laid_out_;
    std::vector<std::shared_ptr<const TriangleMesh>> meshes_;
    std::unique_ptr<Primitives> primitives_;
    Parallel parallel_{2};
    Progress progress_;
};

inline std::unique_ptr<World> world_of(const Triangles& triangles, const Layout& layout) {
    auto world = std::make_unique<World>();
    world->add(triangles, layout);
    world->finish();
    return world;
}

// What the plain loop answers.
struct Expected {
    std::vector<Ray> rays;
    std::vector<Query> queries;
    std::vector<PrimitiveHit> closest;
    std::vector<std::vector<PrimitiveHit>> all;

    Expected(World& world, const std::vector<Ray>& asked, const Query& query = {}) {
        const PlainScan plain(world.input());
        for (const Ray& ray : asked) {
            if (!ray.is_traceable()) continue;
            rays.push_back(ray);
            queries.push_back(query);
            closest.push_back(plain.closest(ray, query));
            all.emplace_back();
            plain.all(ray, query, all.back());
        }
    }
    std::size_t hits() const {
        return static_cast<std::size_t>(
            std::count_if(closest.begin(), closest.end(), [](const PrimitiveHit& hit) { return hit.is_hit(); }));
    }
};

inline void expect_answers(const LinearScan& scan, const Expected& expected) {
    for (std::size_t i = 0; i < expected.rays.size(); ++i) {
        const Ray& ray = expected.rays[i];
        const Query& query = expected.queries[i];
        ASSERT_TRUE(same_hit(scan.closest(ray, query), expected.closest[i]))
            << "closest: " << text_of(expected.rays[i]);
        ASSERT_EQ(scan.any(ray, query), expected.closest[i].is_hit()) << "any: " << text_of(expected.rays[i]);
        std::vector<PrimitiveHit> all(1); // must be appended to, not replaced
        scan.all(ray, query, all);
        ASSERT_FALSE(all.empty() || all.front().is_hit());
        all.erase(all.begin());
        std::sort(all.begin(), all.end());
        ASSERT_TRUE(std::equal(all.begin(), all.end(), expected.all[i].begin(), expected.all[i].end(), same_hit))
            << "all: " << all.size() << " instead of " << expected.all[i].size() << ", " << text_of(expected.rays[i]);
    }
    // In groups of any size, the outputs full of something else before.
    Scratch scratch;
    std::size_t size = 1;
    for (std::size_t begin = 0; begin < expected.rays.size(); begin += size, size = size * 2 + 1) {
        const std::size_t count = std::min(size, expected.rays.size() - begin);
        const RayPacket rays{&expected.rays[begin], &expected.queries[begin], count};
        std::vector<PrimitiveHit> hits(count);
        for (PrimitiveHit& hit : hits) hit.t = hit.primitive = 0;
        const auto found = std::make_unique<bool[]>(count);
        std::fill_n(found.get(), count, true);
        scratch.reset();
        scan.closest_many(rays, hits.data(), scratch);
        scan.any_many(rays, found.get(), scratch);
        for (std::size_t i = 0; i < count; ++i) {
            ASSERT_TRUE(same_hit(hits[i], expected.closest[begin + i]))
                << "closest of " << count << ": " << text_of(expected.rays[begin + i]);
            ASSERT_EQ(found[i], expected.closest[begin + i].is_hit())
                << "any of " << count << ": " << text_of(expected.rays[begin + i]);
        }
    }
}

inline void expect_answers_everywhere(World& world, const Expected& expected) {
    on_every_target([&] {
        for (const bool few_rays : {false, true}) {
            SCOPED_TRACE(few_rays ? "in place" : "gathered");
            const LinearScan scan(world.input(few_rays));
            EXPECT_EQ(scan.is_gathered(), !few_rays && world.primitives().hittable_count() > 0);
            ASSERT_NO_FATAL_FAILURE(expect_answers(scan, expected));
        }
    });
}

// Rays that start at very different distances, half of them along an axis, so that they hit from everywhere.
inline std::vector<Ray> rays_from_far_away(const World& world) {
    const Triangles triangles = world.triangles();
    Random random(5);
    std::vector<Ray> rays;
    for (const double distance : {5.0, 1e3, 1e6, 1e9, 1e15, 1e17, 1e18, 1e20, 1e30, 1e300}) {
        for (int i = 0; i < 12; ++i) {
            const Vec3 target = interesting_point(triangles, world.primitives().bounds(), random);
            Vec3 direction = i % 2 == 0 ? random.direction() : Vec3(0.0);
            if (i % 2 == 1) direction[i % 3] = 1.0;
            rays.push_back({target - distance * direction, 0.0, direction, infinity});
        }
    }
    return rays;
}

// Rays of all kinds, with intervals that begin and end anywhere.
inline std::vector<Ray> rays_for(const Triangles& triangles, const Box& bounds, int count, unsigned seed) {
    Random random(seed);
    std::vector<Ray> rays;
    const double size = triangles.empty() ? 1.0 : max_component(bounds.size());
    for (int i = 0; i < count; ++i) {
        Ray ray = triangles.empty() ? Ray{random.in_cube(), 0.0, random.direction(), infinity}
                                    : any_ray(triangles, bounds, random);
        if (i % 5 == 4) ray.tmin = random.uniform(-2.0, 2.0) * size / max_component(glm::abs(ray.direction));
        if (i % 7 == 6) ray.tmax = ray.tmin + random.uniform(0.0, 2.0) * size / max_component(glm::abs(ray.direction));
        rays.push_back(ray);
    }
    return rays;
}

// The rays and the comparison. Returns how many hit.
inline std::size_t check(World& world, int count, unsigned seed) {
    const Expected expected(world, rays_for(world.triangles(), world.primitives().bounds(), count, seed));
    expect_answers_everywhere(world, expected);
    return expected.hits();
}

} // namespace raywise::scan_testing
