// What is certain of triangles' areas without exact arithmetic has to be true, whatever the layout.
#include "geometry/area_check.h"

#include "geometry/every_target.h"
#include "geometry/exact.h"
#include "geometry/laid_out_mesh.h"
#include "geometry/primitives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace raywise {
namespace {

// Fat triangles, slivers, specks, triangles in one line exactly or but for a bit, at all scales.
struct Zoo {
    std::vector<Vec3> vertices;
    std::vector<std::uint64_t> indices;

    Zoo(std::size_t triangles, double scale, unsigned seed) {
        std::mt19937_64 random(seed);
        const auto number = [&] { return std::ldexp(static_cast<double>(random() >> 40) - 0x1p23, -23); };
        const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
        for (std::size_t i = 0; i < triangles; ++i) {
            const Vec3 a(number(), number(), number());
            const Vec3 b(number(), number(), number());
            Vec3 c(number(), number(), number());
            if (i % 5 == 1) c = 0.5 * a + 0.5 * b;                   // one line, or next to it once rounded
            if (i % 5 == 2) c = a;                                   // two corners alike
            if (i % 5 == 3) c = a + (b - a) * 2.0 + 1e-7 * c;        // a sliver
            if (i % 15 == 4) c = a + std::ldexp(1.0, -30) * (c - a); // a speck's edge
            for (Vec3 p : {a, b, c}) {
                p *= scale;
                vertices.emplace_back(rounded(p.x), rounded(p.y), rounded(p.z));
            }
        }
        // The last vertex is used all over.
        for (std::size_t i = 0; i < 3 * triangles; ++i) indices.push_back(i % 70 == 69 ? 3 * triangles - 1 : i);
    }
};

TEST(AreaCheck, IsCertainOnlyOfWhatHasArea) {
    on_every_target([] {
        for (const Layout& layout : every_layout()) {
            for (const double scale : {1.0, 1e-30, 1e-44, 1e19, 1e38}) {
                for (const std::size_t count : {0, 1, 7, 16, 33, 255, 300, 1000}) {
                    const Zoo zoo(count, scale, static_cast<unsigned>(count));
                    const LaidOutMesh laid_out(zoo.vertices, zoo.indices, layout);
                    const auto mesh = laid_out.shared();
                    PageVector<std::uint32_t> doubtful;
                    Reach reach;
                    check_areas(*mesh, 0, static_cast<std::uint32_t>(count), reach, doubtful);
                    const Box& bounds = reach.bounds;
                    Box expected;
                    double longest = 0.0;
                    std::size_t k = 0;
                    std::size_t without_area = 0;
                    for (std::uint32_t i = 0; i < count; ++i) {
                        const Corners c = mesh->corners(i);
                        const bool has_area = exact_normal(c[0], c[1], c[2]) != Vec3(0.0);
                        without_area += has_area ? 0 : 1;
                        if (k < doubtful.size() && doubtful[k] == i) {
                            ++k;
                        } else {
                            ASSERT_TRUE(has_area) << layout.name << ", triangle " << i << " at " << scale;
                            Box box;
                            for (const Vec3& p : c) box.extend(p);
                            expected.extend(box);
                            longest = std::max(longest, max_component(box.size()));
                        }
                    }
                    EXPECT_EQ(k, doubtful.size()) << "in order, each once";
                    EXPECT_GE(reach.largest_extent, longest);
                    EXPECT_LE(reach.largest_extent, 2.000001 * longest);
                    EXPECT_EQ(bounds.lower, expected.lower) << layout.name << " at " << scale;
                    EXPECT_EQ(bounds.upper, expected.upper) << layout.name << " at " << scale;
                    if (scale == 1.0 && count > 0) {
                        EXPECT_LE(doubtful.size(), count * 4 / 5 + 1) << "of little use";
                    }
                    // And the doubtful ones are settled exactly.
                    for (const unsigned threads : {1u, 3u}) {
                        const Primitives primitives({mesh}, Parallel(threads));
                        EXPECT_EQ(primitives.degenerate_count(), without_area);
                        EXPECT_EQ(primitives.invalid_count(), 0u);
                    }
                }
            }
        }
    });
}

TEST(AreaCheck, CountsAlikeOnManyThreads) {
    const Zoo zoo(200000, 1.0, 5);
    for (const std::size_t l : {0u, 6u}) {
        const LaidOutMesh laid_out(zoo.vertices, zoo.indices, every_layout()[l]);
        const Primitives one({laid_out.shared()}, Parallel(1));
        const Primitives four({laid_out.shared()}, Parallel(4));
        EXPECT_GT(one.degenerate_count(), 40000u);
        EXPECT_EQ(one.degenerate_count(), four.degenerate_count());
        EXPECT_EQ(one.bounds().lower, four.bounds().lower);
        EXPECT_EQ(one.bounds().upper, four.bounds().upper);
        for (std::uint32_t i = 0; i < one.count(); ++i) ASSERT_EQ(one.is_hittable(i), four.is_hittable(i)) << i;
    }
}

TEST(AreaCheck, DoubtsWhatIsInvalid) {
    Zoo zoo(100, 1.0, 7);
    zoo.vertices[30].y = std::nan("");
    zoo.indices[150] = 1000;
    for (const Layout& layout : every_layout()) {
        if (!layout.indexed) continue;
        const LaidOutMesh laid_out(zoo.vertices, zoo.indices, layout);
        const Primitives primitives({laid_out.shared(true)});
        EXPECT_EQ(primitives.invalid_count(), 2u) << layout.name;
        EXPECT_FALSE(primitives.is_hittable(10));
        EXPECT_FALSE(primitives.is_hittable(50));
    }
}

} // namespace
} // namespace raywise
