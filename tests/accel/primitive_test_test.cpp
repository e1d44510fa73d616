// The one leaf test, for lists of primitives on every instruction set, beside the test of one triangle.
#include "accel/primitive_test.h"

#include "geometry/every_target.h"
#include "geometry/laid_out_mesh.h"
#include "geometry/primitives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

namespace raywise {
namespace {

struct Case {
    Ray ray;
    Corners corners;
};

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool same_hit(const PrimitiveHit& a, const PrimitiveHit& b) {
    return a.primitive == b.primitive && same_bits(a.t, b.t) && same_bits(a.u, b.u) && same_bits(a.v, b.v);
}

std::unique_ptr<Primitives> primitives_of(const std::vector<Case>& cases) {
    std::vector<Corners> triangles;
    for (const Case& c : cases) triangles.push_back(c.corners);
    TriangleArrays arrays;
    arrays.vertices = {reinterpret_cast<const std::byte*>(triangles.data()), 3 * sizeof(double), sizeof(double),
                       Scalar::float64};
    arrays.vertex_count = 3 * triangles.size();
    arrays.triangle_count = triangles.size();
    return std::make_unique<Primitives>(
        std::vector<std::shared_ptr<const TriangleMesh>>{std::make_shared<const TriangleMesh>(arrays, true, true)});
}

// Each ray with the triangle that it was made for and those around it, `together` in a list. Returns how many hits there were.
std::size_t compare(const std::vector<Case>& cases, const Primitives* primitives, std::size_t together) {
    std::size_t hits = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const Ray& ray = cases[i].ray;
        if (!ray.is_traceable()) continue;
        const ExactRay exact(ray);
        const std::size_t first = std::min(i / together * together, cases.size() - std::min(together, cases.size()));
        std::vector<std::uint32_t> list(std::min(together, cases.size()));
        std::iota(list.begin(), list.end(), static_cast<std::uint32_t>(first));

        std::vector<PrimitiveHit> expected;
        for (const std::uint32_t primitive : list) {
            PrimitiveHit hit;
            if (primitives->test(exact, primitive, hit)) expected.push_back(hit);
        }
        std::sort(expected.begin(), expected.end());
        hits += expected.size();

        const Query query;
        std::vector<PrimitiveHit> all;
        AllCollector all_collector(ray, query, all);
        EXPECT_FALSE(test_primitives(*primitives, exact, list.data(), list.size(), all_collector));
        std::sort(all.begin(), all.end());
        EXPECT_TRUE(std::equal(all.begin(), all.end(), expected.begin(), expected.end(), same_hit)) << "all, ray " << i;
        ClosestCollector closest(ray, query);
        EXPECT_FALSE(test_primitives(*primitives, exact, list.data(), list.size(), closest));
        EXPECT_TRUE(same_hit(closest.best(), expected.empty() ? PrimitiveHit{} : expected.front()))
            << "closest, ray " << i;
        AnyCollector any(ray, query);
        EXPECT_EQ(test_primitives(*primitives, exact, list.data(), list.size(), any), !expected.empty());
        EXPECT_EQ(any.found(), !expected.empty()) << "any, ray " << i;
        if (testing::Test::HasFailure()) break;
    }
    return hits;
}

std::size_t compare(const std::vector<Case>& cases, std::size_t together) {
    return compare(cases, primitives_of(cases).get(), together);
}

// The cases' triangles in meshes of one layout, the first of which has `in_first`.
class LaidOut {
public:
    LaidOut(const std::vector<Case>& cases, const Layout& layout, std::size_t in_first) {
        add(cases, 0, in_first, layout);
        if (in_first < cases.size()) add(cases, in_first, cases.size(), layout);
        std::vector<std::shared_ptr<const TriangleMesh>> shared;
        for (const auto& mesh : meshes_) shared.push_back(mesh->shared());
        primitives_ = std::make_unique<Primitives>(shared);
    }
    const Primitives* primitives() const { return primitives_.get(); }

private:
    // From the last corner to the first, so that the last vertex is among those of the first triangle.
    void add(const std::vector<Case>& cases, std::size_t begin, std::size_t end, const Layout& layout) {
        std::vector<Vec3> vertices;
        std::vector<std::uint64_t> indices;
        for (std::size_t i = end; i-- > begin;)
            for (const Vec3& corner : cases[i].corners) vertices.push_back(corner);
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t k = 0; k < 3; ++k) indices.push_back(3 * (end - 1 - i) + k);
        meshes_.push_back(std::make_unique<LaidOutMesh>(vertices, indices, layout));
    }

    std::vector<std::unique_ptr<LaidOutMesh>> meshes_;
    std::unique_ptr<Primitives> primitives_;
};

class Maker {
public:
    double number() { return uniform_(engine_); }
    Vec3 vector() { return {number(), number(), number()}; }

    // A ray that passes a point of the triangle's plane, often one inside.
    Case make(double scale, double size, const Vec3& far) {
        Case c;
        const Vec3 middle = scale * vector();
        for (Vec3& corner : c.corners) corner = far + middle + size * vector();
        const double u = std::abs(number()) * 0.6;
        const double v = std::abs(number()) * 0.6;
        const Vec3 target = (1.0 - u - v) * c.corners[0] + u * c.corners[1] + v * c.corners[2];
        c.ray.origin = far + 2.0 * scale * vector();
        c.ray.direction = target - c.ray.origin;
        return c;
    }

private:
    std::mt19937_64 engine_{7};
    std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

TEST(PrimitiveTest, AnswersAsForOneTriangle) {
    Maker maker;
    std::vector<Case> cases;
    for (int i = 0; i < 4000; ++i) cases.push_back(maker.make(1.0, 0.1, Vec3(0.0)));
    on_every_target([&] {
        for (const std::size_t together : {1u, 2u, 3u, 4u, 7u, 8u, 9u, 17u}) EXPECT_GT(compare(cases, together), 2000u);
    });
}

TEST(PrimitiveTest, ReadsEveryLayoutOfOneMeshAndOfTwo) {
    Maker maker;
    std::vector<Case> cases;
    for (int i = 0; i < 600; ++i) cases.push_back(maker.make(1.0, 0.1, Vec3(0.0)));
    for (const Layout& layout : every_layout()) {
        SCOPED_TRACE(layout.name);
        for (const std::size_t in_first : {cases.size(), std::size_t{301}}) {
            const LaidOut laid_out(cases, layout, in_first);
            on_every_target([&] {
                for (const std::size_t together : {3u, 5u, 8u, 11u})
                    EXPECT_GT(compare(cases, laid_out.primitives(), together), 300u);
            });
        }
    }
}

TEST(PrimitiveTest, AnswersAsForOneTriangleAtAnySizeAndLength) {
    Maker maker;
    std::vector<Case> cases;
    for (const double scale : {1e-30, 1e-3, 1e6, 1e30}) {
        for (const double size : {1e-9, 1e-3, 1.0}) {
            for (const double length : {1e-290, 1e-20, 1.0, 1e20, 1e300}) {
                for (int i = 0; i < 60; ++i) {
                    cases.push_back(maker.make(scale, scale * size, Vec3(i % 3 == 0 ? 1e3 * scale : 0.0)));
                    const double largest = max_component(magnitudes(cases.back().ray.direction));
                    cases.back().ray.direction *= length / largest;
                }
            }
        }
    }
    on_every_target([&] { EXPECT_GT(compare(cases, 8), cases.size() / 4); });
}

TEST(PrimitiveTest, KeepsToTheInterval) {
    Maker maker;
    std::vector<Case> cases;
    for (int i = 0; i < 8000; ++i) {
        cases.push_back(maker.make(1.0, 0.3, Vec3(0.0)));
        Ray& ray = cases.back().ray;
        ray.tmin = 1.0 + 0.2 * maker.number();
        ray.tmax = 1.0 + 0.2 * maker.number();
        if (i % 4 == 0) ray.tmin = -std::numeric_limits<double>::infinity();
        if (i % 4 == 1) ray.tmax = std::numeric_limits<double>::infinity();
        if (i % 4 == 2) ray.tmin = ray.tmax = 1.0; // the hit, as near as can be said
        if (ray.tmin > ray.tmax) std::swap(ray.tmin, ray.tmax);
    }
    on_every_target([&] { EXPECT_GT(compare(cases, 5), 1000u); });
}

// On edges and corners, in the plane, from the surface, with components of direction that are none, and with coordinates out of range.
TEST(PrimitiveTest, AnswersWhatIsHardAsForOneTriangle) {
    Maker maker;
    std::vector<Case> cases;
    for (int i = 0; i < 2000; ++i) {
        Case c = maker.make(1.0, 0.5, Vec3(0.0));
        const Corners& p = c.corners;
        switch (i % 8) {
            case 0:
                c.ray.direction = p[static_cast<std::size_t>(i / 8 % 3)] - c.ray.origin;
                break;
            case 1:
                c.ray.direction = 0.5 * (p[0] + p[1]) - c.ray.origin;
                break;
            case 2:
                c.ray.origin = p[0] + (p[1] - p[2]);
                c.ray.direction = p[2] - p[1];
                break;
            case 3:
                c.ray.origin = (p[0] + p[1] + p[2]) / 3.0;
                c.ray.direction = maker.vector();
                break;
            case 4:
                c.ray.direction = Vec3(0.0, 0.0, maker.number() < 0.0 ? -1.0 : 1e-310);
                break;
            case 5:
                c.ray.direction.x = 1e-250 * c.ray.direction.x;
                break;
            case 6:
                for (Vec3& corner : c.corners) corner *= i % 16 < 8 ? 1e200 : 1e-200;
                c.ray.origin *= i % 16 < 8 ? 1e200 : 1e-200;
                break;
            default:
                c.corners[2] = c.corners[1];
                break;
        }
        cases.push_back(c);
    }
    on_every_target([&] {
        for (const std::size_t together : {1u, 3u, 8u, 11u}) EXPECT_GT(compare(cases, together), 200u);
    });
}

TEST(PrimitiveTest, SkipsPrimitivesThatTheQueryPassesThrough) {
    Maker maker;
    std::vector<Case> cases;
    for (int i = 0; i < 8; ++i) cases.push_back(maker.make(1.0, 0.5, Vec3(0.0)));
    const std::unique_ptr<Primitives> primitives = primitives_of(cases);
    std::vector<std::uint32_t> list(cases.size());
    std::iota(list.begin(), list.end(), 0u);
    on_every_target([&] {
        for (const Case& c : cases) {
            const ExactRay exact(c.ray);
            const Query query;
            ClosestCollector closest(c.ray, query);
            test_primitives(*primitives, exact, list.data(), list.size(), closest);
            ASSERT_TRUE(closest.best().is_hit());
            const std::uint32_t skipped = closest.best().primitive;
            const Query skips{{&skipped, &skipped + 1}};
            ClosestCollector second(c.ray, skips);
            test_primitives(*primitives, exact, list.data(), list.size(), second);
            EXPECT_NE(second.best().primitive, skipped);
            AnyCollector any(c.ray, skips);
            test_primitives(*primitives, exact, &skipped, 1, any);
            EXPECT_FALSE(any.found());
        }
    });
}

TEST(PrimitiveTest, OfNoneIsNoTrouble) {
    Maker maker;
    const std::vector<Case> one{maker.make(1.0, 0.5, Vec3(0.0))};
    const std::unique_ptr<Primitives> primitives = primitives_of(one);
    const Query query;
    ClosestCollector closest(one[0].ray, query);
    EXPECT_FALSE(test_primitives(*primitives, ExactRay(one[0].ray), nullptr, 0, closest));
    EXPECT_FALSE(closest.best().is_hit());
}

} // namespace
} // namespace raywise
