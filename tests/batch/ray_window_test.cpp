#include "batch/ray_window.h"

#include "rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

namespace raywise {
namespace {

using namespace testing;

const BatchWatch unwatched;

// Reads all rays of a window, part by part, and looks whether each comes once.
template <class AnyRay>
void expect_all_of(const RayWindow<AnyRay>& window, const std::vector<AnyRay>& rays, std::uint64_t first,
                   std::size_t count) {
    std::set<std::uint64_t> seen;
    const Elements& elements = window.elements();
    ASSERT_EQ(elements.count(), count);
    for (std::size_t begin = 0; begin < count; begin += 1000) {
        const Elements part = elements.part(begin, std::min<std::size_t>(1000, count - begin));
        std::vector<AnyRay> read(part.count());
        window.read(part, read.data());
        for (std::size_t k = 0; k < part.count(); ++k) {
            ASSERT_EQ(std::memcmp(&read[k], &rays[part[k]], sizeof read[k]), 0);
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

template <class AnyRay>
void expect_every_ray_once(const std::vector<AnyRay>& rays) {
    const RayArrays arrays = arrays_of(rays);
    WindowMemory memory; // for one window after the other
    for (const unsigned threads : {1u, 3u}) {
        const Parallel parallel(threads);
        BatchProgress progress(unwatched, rays.size(), parallel);
        RayWindow<AnyRay> window(arrays, unit_box, parallel, progress, memory);
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
        window.move_to(300, 0, true);
        expect_all_of(window, rays, 300, 0);
    }
}

TEST(RayWindow, HasEveryRayOnce) { expect_every_ray_once(random_rays(70000, 1)); }
TEST(RayWindow, HasEveryRayOfFloat32Once) { expect_every_ray_once(narrowed(random_rays(70000, 1))); }

TEST(RayWindow, KnowsRaysOfACameraFromOthers) {
    const Parallel parallel(2);
    WindowMemory memory;
    for (const bool of_camera : {true, false}) {
        const std::vector<RayF> rays = narrowed(of_camera ? camera_rays(400, 100) : random_rays(40000, 2));
        const RayArrays arrays = arrays_of(rays);
        BatchProgress progress(unwatched, rays.size(), parallel);
        const RayWindow<RayF> window(arrays, unit_box, parallel, progress, memory);
        EXPECT_EQ(window.come_in_order(0, rays.size()), of_camera);
    }
}

TEST(RayWindow, OrdersAlikeOnAnyNumberOfThreads) {
    const std::vector<RayF> rays = narrowed(random_rays(60000, 3));
    const RayArrays arrays = arrays_of(rays);
    std::vector<std::uint64_t> before;
    for (const unsigned threads : {1u, 2u, 5u}) {
        const Parallel parallel(threads);
        BatchProgress progress(unwatched, rays.size(), parallel);
        WindowMemory memory;
        RayWindow<RayF> window(arrays, unit_box, parallel, progress, memory);
        window.move_to(1000, 50000, true);
        std::vector<std::uint64_t> order;
        for (std::size_t k = 0; k < window.elements().count(); ++k) order.push_back(window.elements()[k]);
        if (!before.empty()) {
            EXPECT_EQ(order, before);
        }
        before = order;
    }
}

} // namespace
} // namespace raywise
