#include "batch/ray_window.h"

#include "rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

namespace raywise {
namespace {

using namespace testing;

bool same_bits(const Ray& a, const Ray& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// Two triangles across the unit box, whose normals differ.
Primitives make_primitives() {
    static const float vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 1, 0, 1, 1, 0, 0, 1};
    TriangleArrays arrays;
    arrays.vertex_count = 6;
    arrays.triangle_count = 2;
    arrays.vertices = {reinterpret_cast<const std::byte*>(vertices), 12, 4, Scalar::float32};
    return Primitives({std::make_shared<const TriangleMesh>(arrays, true, false)});
}
const Primitives primitives = make_primitives();
const BatchWatch unwatched;

// Reads all rays of a window, part by part, and looks whether each comes once.
void expect_all_of(RayWindow& window, const std::vector<Ray>& rays, std::uint64_t first, std::size_t count) {
    std::set<std::uint64_t> seen;
    const Elements& elements = window.elements();
    ASSERT_EQ(elements.count(), count);
    for (std::size_t begin = 0; begin < count; begin += 1000) {
        const Elements part = elements.part(begin, std::min<std::size_t>(1000, count - begin));
        std::vector<Ray> read(part.count());
        window.read(part, read.data());
        for (std::size_t k = 0; k < part.count(); ++k) {
            ASSERT_TRUE(same_bits(read[k], rays[part[k]]));
            ASSERT_GE(part[k], first);
            ASSERT_LT(part[k], first + count);
            ASSERT_TRUE(seen.insert(part[k]).second);
        }
    }
}

bool is_in_callers_order(const Elements& elements) {
    for (std::size_t k = 1; k < elements.count(); ++k) {
        if (elements[k] != elements[k - 1] + 1) return false;
    }
    return true;
}

TEST(RayWindow, HasEveryRayOnce) {
    const std::vector<Ray> rays = random_rays(70000, 1);
    const RayArrays arrays = arrays_of(rays);
    for (const unsigned threads : {1u, 3u}) {
        const Parallel parallel(threads);
        BatchProgress progress(unwatched, rays.size(), parallel);
        RayWindow window(arrays, primitives, parallel, progress);
        window.move_to(0, 20000, true);
        EXPECT_FALSE(is_in_callers_order(window.elements()));
        expect_all_of(window, rays, 0, 20000);
        window.move_to(20000, 50000, true); // more than before
        expect_all_of(window, rays, 20000, 50000);
        window.move_to(69000, 1000, true);
        expect_all_of(window, rays, 69000, 1000);
        window.move_to(300, 5000, false);
        EXPECT_TRUE(is_in_callers_order(window.elements()));
        expect_all_of(window, rays, 300, 5000);
    }
}

TEST(RayWindow, LeavesRaysOfACameraInTheirOrder) {
    const std::vector<Ray> rays = camera_rays(400, 100);
    const RayArrays arrays = arrays_of(rays);
    const Parallel parallel(2);
    BatchProgress progress(unwatched, rays.size(), parallel);
    RayWindow window(arrays, primitives, parallel, progress);
    window.move_to(0, rays.size(), true);
    EXPECT_TRUE(is_in_callers_order(window.elements()));
}

TEST(RayWindow, WritesHitsToTheirRays) {
    const std::vector<Ray> rays = random_rays(10000, 6);
    const RayArrays arrays = arrays_of(rays);
    const Parallel parallel(2);
    for (const bool in_order : {false, true}) {
        std::vector<double> t(rays.size(), -1.0);
        std::vector<std::uint32_t> primitive(rays.size(), 7);
        std::vector<Vec3> normal(rays.size(), Vec3(5.0));
        HitArrays hits;
        hits.t = {reinterpret_cast<std::byte*>(t.data()), 8, 8, Scalar::float64};
        hits.primitive = {reinterpret_cast<std::byte*>(primitive.data()), 4, 4, Scalar::uint32};
        hits.normal = {reinterpret_cast<std::byte*>(normal.data()), sizeof(Vec3), 8, Scalar::float64};
        BatchProgress progress(unwatched, rays.size(), parallel);
        RayWindow window(arrays, primitives, parallel, progress);
        const std::uint64_t first = 100;
        const std::size_t count = 9800;
        window.move_to(first, count, in_order);
        for (std::size_t begin = 0; begin < count; begin += 700) {
            const Elements part = window.elements().part(begin, std::min<std::size_t>(700, count - begin));
            std::vector<Ray> read(part.count());
            window.read(part, read.data());
            std::vector<Hit> found(part.count());
            for (std::size_t k = 0; k < part.count(); ++k) {
                found[k].t = read[k].origin.x;
                if (part[k] % 3 == 2) continue; // a miss
                found[k].geometry = 0;
                found[k].primitive = static_cast<std::uint32_t>(part[k] % 3);
            }
            window.write(part, found.data(), hits);
        }
        window.finish(hits);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const bool within = i >= first && i < first + count;
            ASSERT_EQ(t[i], within ? rays[i].origin.x : -1.0) << i;
            ASSERT_EQ(primitive[i], !within ? 7u : i % 3 == 2 ? invalid_id : i % 3) << i;
            const Vec3 right = i % 3 == 2 ? Vec3(0.0) : unit_normal(primitives.corners(i % 3));
            ASSERT_EQ(normal[i], within ? right : Vec3(5.0)) << i;
        }
    }
}

} // namespace
} // namespace raywise
