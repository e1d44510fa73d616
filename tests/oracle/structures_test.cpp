// Every structure of base/structure_list.def against the linear scan: closest, any and all, bit for bit.
#include "oracle/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

namespace raywise::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string text_of(const ::testing::TestParamInfo<Structure>& info) { return name_of(info.param); }

class EveryStructure : public ::testing::TestWithParam<Structure> {
protected:
    static void expect_agreement(const Comparison& comparison) {
        RecordProperty("rays", std::to_string(comparison.rays));
        RecordProperty("hits", std::to_string(comparison.hits));
        EXPECT_TRUE(comparison.faults.empty()) << comparison.text();
    }
    static Comparison compare(const Scene& scene, const std::vector<Ray>& rays) {
        return compare_with_linear_scan(GetParam(), scene, rays);
    }
};

INSTANTIATE_TEST_SUITE_P(, EveryStructure, ::testing::ValuesIn(all_structures()), text_of);

TEST_P(EveryStructure, AgreesOnHardScenes) {
    Comparison all;
    for (const Scene& scene : hard_scenes()) {
        all.add(compare(scene, random_rays(scene, 80, 31)));
        all.add(compare(scene, hard_rays(scene, 15, 32)));
        all.add(compare(scene, leak_rays(scene.triangles.empty() ? cube() : scene, 20, 33)));
    }
    expect_agreement(all);
    EXPECT_GT(all.hits, 20000u);
}

TEST_P(EveryStructure, AgreesOnFarScenes) {
    Comparison all;
    for (const Scene& scene : far_scenes()) {
        all.add(compare(scene, random_rays(scene, 40, 57)));
        all.add(compare(scene, hard_rays(scene, 6, 58)));
        all.add(compare(scene, rays_from_close_by(scene, 40, 59)));
    }
    expect_agreement(all);
    EXPECT_GT(all.hits, 20000u);
}

TEST_P(EveryStructure, AgreesOnRaysFromFarAway) {
    std::vector<Scene> scenes = far_scenes();
    for (const Scene& scene : {icosphere(2), terrain(12), soup(200, 60), flat_square(6, 1), single_triangle()})
        scenes.push_back(scene);
    Comparison all;
    for (const Scene& scene : scenes) {
        for (const double times : {1e3, 1e6, 7.5e10, 1e15, 1e30})
            all.add(compare(scene, rays_from_afar(scene, times, 1, 61)));
    }
    expect_agreement(all);
    EXPECT_GT(all.hits, 5000u);
}

TEST_P(EveryStructure, AgreesOnLargeScenes) {
    Comparison all;
    for (const Scene& scene : large_scenes()) {
        all.add(compare(scene, random_rays(scene, 120, 34)));
        all.add(compare(scene, hard_rays(scene, 6, 35)));
    }
    expect_agreement(all);
}

TEST_P(EveryStructure, AgreesOnRealMeshes) {
    Comparison all;
    for (const Scene& scene : real_meshes(200000)) {
        const bool large = scene.triangles.size() > 20000;
        all.add(compare(scene, random_rays(scene, large ? 20 : 60, 36)));
        all.add(compare(scene, hard_rays(scene, large ? 1 : 4, 37)));
    }
    expect_agreement(all);
}

// Each number of triangles around the sizes of leaves and SIMD groups.
TEST_P(EveryStructure, AgreesForEveryFewTriangles) {
    Comparison all;
    const Scene base = soup(40, 38);
    for (std::size_t count = 0; count <= base.triangles.size(); ++count) {
        Scene scene = base;
        scene.triangles.resize(count);
        scene.name = std::to_string(count) + " triangles";
        all.add(compare(scene, random_rays(scene, 60, 39)));
    }
    expect_agreement(all);
}

TEST_P(EveryStructure, AgreesWhereProductsAndQuotientsLeaveTheRange) {
    std::vector<Ray> rays;
    for (const double tiny : {0x1p-1074, 0x1p-1060, 0x1p-1023, 0x1p-1000, 0x1p-600}) {
        for (const double sign : {1.0, -1.0}) {
            for (int axis = 0; axis < 3; ++axis) {
                Vec3 direction(0.0);
                direction[axis] = sign;
                direction[(axis + 1) % 3] = tiny;
                for (const double offset : {0.0, tiny, -tiny, 0.5, 1.0}) {
                    Vec3 origin(0.25);
                    origin[axis] = -2.0 * sign;
                    origin[(axis + 1) % 3] = offset;
                    rays.push_back({origin, 0.0, direction, infinity});
                    rays.push_back({origin, -infinity, -direction, infinity});
                }
            }
        }
    }
    // The origin lies by less than rounding outside the box, and the ray enters it by less than rounding.
    for (const double outside : {0x1p-1074, 0x1p-1070}) {
        rays.push_back({{-1.0, -outside, 0.1}, 0.0, {1.0, outside, 0.0}, infinity});
        rays.push_back({{-1.0, -outside, 0.1}, 0.0, {1.0, 2 * outside, 0.0}, infinity});
    }
    Comparison all;
    for (const Scene& scene :
         {single_triangle(), flat_square(6, 0), flat_square(6, 1), flat_square(6, 2), cube(), soup(100, 40),
          Scene{"corner", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}, {0, 0, 1}}, {{0, 1, 2}, {0, 1, 3}}}}) {
        all.add(compare(scene, rays));
    }
    expect_agreement(all);
}

// A ray whose interval ends or begins exactly at a hit, or one step before or behind it.
TEST_P(EveryStructure, AgreesAtTheEndsOfIntervals) {
    Comparison all;
    for (const Scene& scene : {soup(400, 41), terrain(20), stacked_squares(20), icosphere(3)}) {
        const Primitives primitives = primitives_of(scene);
        std::vector<Ray> limited;
        for (Ray ray : random_rays(scene, 120, 42)) {
            const ExactRay exact(ray);
            PrimitiveHit hit;
            for (std::uint32_t i = 0; i < primitives.count(); ++i) {
                if (!primitives.test(exact, i, hit)) continue;
                const double t = hit.t;
                for (const double end : {t, std::nextafter(t, 0.0), std::nextafter(t, infinity)}) {
                    limited.push_back({ray.origin, 0.0, ray.direction, end});
                    limited.push_back({ray.origin, end, ray.direction, infinity});
                    limited.push_back({ray.origin, end, ray.direction, end});
                }
            }
        }
        if (limited.size() > 3000) limited.resize(3000);
        all.add(compare(scene, limited));
    }
    expect_agreement(all);
}

// Views: rays that start at the point, aim at it, run along the direction, or have nothing to do with it.
TEST_P(EveryStructure, AgreesWithAnyView) {
    std::vector<Scene> scenes = {icosphere(3),
                                 terrain(16),
                                 soup(500, 43),
                                 flat_square(8, 2),
                                 single_triangle(),
                                 duplicates_and_degenerates(),
                                 transformed(soup(200, 44), 1e-6, Vec3(1e3), false),
                                 empty_scene()};
    Comparison all;
    for (const Scene& scene : scenes) {
        Box box;
        for (const Vec3& v : scene.vertices) box.extend(v);
        if (box.empty()) box.extend(Vec3(0.0));
        const double size = max_component(box.size()) + 1e-9;
        std::vector<Vec3> points = {box.center(), box.center() + Vec3(0, 0, 2 * size),
                                    box.center() + Vec3(-1.5 * size, 0.3 * size, 0.2 * size),
                                    box.center() + Vec3(1e4 * size, 1.0, 0)};
        if (!scene.vertices.empty()) points.push_back(scene.vertices.front());
        for (const Vec3& point : points) {
            for (const Vec3& look : {Vec3(0.0), Vec3(0, 0, -1), Vec3(1, -2, 0.5)}) {
                ViewFrame view{ViewFrame::Kind::point, point, look, look == Vec3(0.0) ? 0.0 : 0.7};
                std::vector<Ray> rays = random_rays(scene, 40, 45);
                for (Ray ray : random_rays(scene, 60, 46)) {
                    ray.origin = point;
                    rays.push_back(ray);
                    rays.push_back({point + ray.direction, 0.0, -ray.direction, 1.0});
                    rays.push_back({point, -infinity, ray.direction, infinity});
                }
                for (const Vec3& v : scene.vertices) {
                    if (rays.size() < 300 && v != point) rays.push_back({point, 0.0, v - point, infinity});
                }
                rays.erase(std::remove_if(rays.begin(), rays.end(), [](const Ray& r) { return !r.is_traceable(); }),
                           rays.end());
                all.add(compare_with_linear_scan(GetParam(), scene, rays, view));
            }
        }
        for (const Vec3& direction : {Vec3(0, 0, -1), Vec3(0.3, -1, 0.2), Vec3(1, 0, 0), Vec3(1e-9, 1, 0)}) {
            const ViewFrame view{ViewFrame::Kind::direction, Vec3(0.0), direction, 0.0};
            std::vector<Ray> rays = random_rays(scene, 40, 47);
            for (Ray ray : random_rays(scene, 60, 48)) {
                for (const double factor : {1.0, -1.0, 0x1p60, 3.0}) {
                    ray.direction = factor * direction;
                    rays.push_back(ray);
                    ray.tmin = -infinity;
                    rays.push_back(ray);
                }
            }
            for (const Vec3& v : scene.vertices) {
                if (rays.size() < 700) rays.push_back({v - 3.0 * size * direction, 0.0, direction, infinity});
            }
            all.add(compare_with_linear_scan(GetParam(), scene, rays, view));
        }
    }
    expect_agreement(all);
}

TEST_P(EveryStructure, AgreesForSeveralMeshes) {
    const Scene first = soup(60, 49);
    const Scene second = transformed(icosphere(2), 0.8, Vec3(0.1), true);
    Scene together = first;
    const auto shift = static_cast<std::uint32_t>(first.vertices.size());
    together.vertices.insert(together.vertices.end(), second.vertices.begin(), second.vertices.end());
    for (const auto& [a, b, c] : second.triangles) together.triangles.push_back({a + shift, b + shift, c + shift});

    std::vector<std::shared_ptr<const TriangleMesh>> meshes;
    for (const Scene& scene : {first, empty_scene(), second}) {
        const Primitives one = primitives_of(scene);
        meshes.push_back(one.meshes().front());
    }
    const Primitives parts(meshes);
    const Primitives whole = primitives_of(together);
    const Parallel parallel(1);
    Progress progress;
    const auto in_parts = build(GetParam(), BuildInput{parts, {}, std::nullopt, parallel, progress});
    const auto expected = build(Structure::linear_scan, BuildInput{whole, {}, std::nullopt, parallel, progress});
    for (const Ray& ray : random_rays(together, 300, 50)) {
        const PrimitiveHit wanted = expected->closest(ray, {});
        const PrimitiveHit hit = in_parts->closest(ray, {});
        EXPECT_EQ(hit.primitive, wanted.primitive) << describe(ray);
        EXPECT_EQ(hit.t, wanted.t);
        if (hit.is_hit()) {
            EXPECT_EQ(parts.locate(hit.primitive).geometry, hit.primitive < 60 ? 0u : 2u);
        }
    }
}

TEST_P(EveryStructure, IsTheSameHoweverManyThreadsBuildIt) {
    const Scene scene = soup(4000, 51);
    const Primitives primitives = primitives_of(scene);
    const std::vector<Ray> rays = random_rays(scene, 200, 52);
    std::vector<PrimitiveHit> wanted;
    std::size_t bytes = 0;
    for (const unsigned threads : {1u, 2u, 4u}) {
        const Parallel parallel(threads);
        Progress progress;
        const auto accel = build(GetParam(), BuildInput{primitives, {}, std::nullopt, parallel, progress});
        if (threads == 1) bytes = accel->bytes();
        EXPECT_GT(accel->bytes(), 0u);
        EXPECT_LT(accel->bytes(), 2 * bytes + 100000);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const PrimitiveHit hit = accel->closest(rays[i], {});
            if (threads == 1) wanted.push_back(hit);
            EXPECT_EQ(hit.primitive, wanted[i].primitive);
            EXPECT_EQ(hit.t, wanted[i].t);
        }
    }
}

TEST_P(EveryStructure, IsBuiltWithAHostsLoopThatRunsBackwards) {
    const Scene scene = terrain(40);
    const Primitives primitives = primitives_of(scene);
    const Parallel backwards(4, [](std::uint64_t count, const Parallel::Task& task) {
        for (std::uint64_t i = count; i-- > 0;) task(i);
    });
    Progress progress;
    const auto accel = build(GetParam(), BuildInput{primitives, {}, std::nullopt, backwards, progress});
    const Parallel one(1);
    const auto expected = build(Structure::linear_scan, BuildInput{primitives, {}, std::nullopt, one, progress});
    for (const Ray& ray : random_rays(scene, 200, 53)) {
        EXPECT_EQ(accel->closest(ray, {}).primitive, expected->closest(ray, {}).primitive);
    }
}

TEST_P(EveryStructure, StopsWhenProgressSaysSo) {
    const Scene scene = soup(20000, 54);
    const Primitives primitives = primitives_of(scene);
    const Parallel parallel(2);
    int calls = 0;
    double last = -1.0;
    Progress counting([&](double fraction, const char* stage) {
        EXPECT_NE(stage, nullptr);
        EXPECT_GE(fraction, 0.0);
        EXPECT_LE(fraction, 1.0);
        last = std::max(last, fraction);
        ++calls;
        return false;
    });
    build(GetParam(), BuildInput{primitives, {}, std::nullopt, parallel, counting});
    if (calls == 0) {
        EXPECT_EQ(GetParam(), Structure::linear_scan) << "only a structure without a build may stay silent";
        return;
    }
    for (const int stop_at : {1, (calls + 1) / 2, calls}) {
        int call = 0;
        Progress stopping([&](double, const char*) { return ++call >= stop_at; });
        try {
            build(GetParam(), BuildInput{primitives, {}, std::nullopt, parallel, stopping});
            // A parallel build may report less often another time.
            EXPECT_LT(call, stop_at);
        } catch (const Error& error) {
            EXPECT_EQ(error.status(), Status::ERROR_CANCELLED);
        }
    }
}

TEST_P(EveryStructure, AnswersManyThreadsAtOnce) {
    const Scene scene = soup(500, 55);
    const Primitives primitives = primitives_of(scene);
    const Parallel one(1);
    Progress progress;
    const auto accel = build(GetParam(), BuildInput{primitives, {}, std::nullopt, one, progress});
    const std::vector<Ray> rays = random_rays(scene, 200, 56);
    std::vector<PrimitiveHit> wanted;
    for (const Ray& ray : rays) wanted.push_back(accel->closest(ray, {}));
    std::vector<std::thread> threads;
    std::vector<int> differences(4, 0);
    for (std::size_t t = 0; t < differences.size(); ++t) {
        threads.emplace_back([&, t] {
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const PrimitiveHit hit = accel->closest(rays[i], {});
                if (hit.primitive != wanted[i].primitive || hit.t != wanted[i].t) ++differences[t];
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(differences, std::vector<int>(4, 0));
}

} // namespace
} // namespace raywise::oracle
