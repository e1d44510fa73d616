// The rule for all hits against the judge, and what it promises of closed meshes.
#include "geometry/crossings.h"

#include "accel/accel.h"
#include "oracle/judge.h"
#include "oracle/rays.h"
#include "oracle/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace raywise::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

class Scan {
public:
    explicit Scan(const Scene& scene) : primitives_(primitives_of(scene)) {}

    // Every hit, sorted; edges and corners as often as there are triangles at them.
    std::vector<PrimitiveHit> touches(const Ray& ray) const {
        const ExactRay exact(ray);
        std::vector<PrimitiveHit> hits;
        for (std::uint32_t i = 0; i < primitives_.count(); ++i) {
            PrimitiveHit hit;
            if (primitives_.test(exact, i, hit)) hits.push_back(hit);
        }
        std::sort(hits.begin(), hits.end());
        return hits;
    }
    std::vector<PrimitiveHit> crossings(const Ray& ray) const {
        std::vector<PrimitiveHit> hits = touches(ray);
        keep_crossings(ExactRay(ray), primitives_, hits);
        return hits;
    }

private:
    Primitives primitives_;
};

std::vector<std::uint32_t> ids(const std::vector<PrimitiveHit>& hits) {
    std::vector<std::uint32_t> all;
    for (const PrimitiveHit& hit : hits) all.push_back(hit.primitive);
    return all;
}

std::vector<std::uint32_t> crossings_by_the_judge(const Scene& scene, const Ray& ray,
                                                  const std::vector<PrimitiveHit>& touches) {
    std::vector<std::uint32_t> kept;
    for (const PrimitiveHit& hit : touches) {
        if (hit.primitive == touches.front().primitive ||
            meets_when_nudged(scene, ray, touches.front().primitive, hit.primitive))
            kept.push_back(hit.primitive);
    }
    return kept;
}

TEST(Crossings, AgreeWithTheJudge) {
    std::size_t taken_out = 0;
    for (const Scene& scene : hard_scenes()) {
        const Scan scan(scene);
        std::vector<Ray> rays = hard_rays(scene, 8, 61);
        for (const Ray& ray : leak_rays(scene.triangles.empty() ? cube() : scene, 12, 62)) rays.push_back(ray);
        for (const Ray& ray : rays) {
            const std::vector<PrimitiveHit> touches = scan.touches(ray);
            const std::vector<PrimitiveHit> crossings = scan.crossings(ray);
            ASSERT_EQ(touches.empty(), crossings.empty());
            if (touches.empty()) continue;
            EXPECT_EQ(crossings.front().primitive, touches.front().primitive);
            EXPECT_EQ(ids(crossings), crossings_by_the_judge(scene, ray, touches)) << scene.name;
            taken_out += touches.size() - crossings.size();
        }
    }
    EXPECT_GT(taken_out, 1000u);
}

std::vector<Scene> closed_scenes() {
    return {tetrahedron(),
            cube(),
            icosphere(0),
            icosphere(3),
            transformed(cube(), 1e-20, Vec3(0.0), true),
            transformed(icosphere(2), 1e20, Vec3(0.0), true),
            transformed(icosphere(2), 1.0, Vec3(5e6, 3e5, 100.0), false)};
}

// From outside, exactly through corners, the middles of edges, along edges, in the planes of faces and along axes.
TEST(Crossings, AreEvenFromOutsideAClosedMesh) {
    std::size_t rays = 0;
    std::size_t hits = 0;
    for (const Scene& scene : closed_scenes()) {
        const Scan scan(scene);
        Box box;
        for (const Vec3& v : scene.vertices) box.extend(v);
        const double size = max_component(box.size());
        std::vector<Vec3> targets = scene.vertices;
        for (const auto& t : scene.triangles) {
            targets.push_back(0.5 * (scene.vertices[t[0]] + scene.vertices[t[1]]));
            targets.push_back(0.25 * scene.vertices[t[0]] + 0.75 * scene.vertices[t[2]]);
        }
        for (const Vec3& target : targets) {
            for (const Vec3& from : {Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, -2), Vec3(2, 2, 0), Vec3(-2, 2, 2),
                                     Vec3(4, -1, 2), Vec3(0.5, 0.25, 8)}) {
                const Vec3 origin = target + size * from;
                if (origin.x >= box.lower.x && origin.y >= box.lower.y && origin.z >= box.lower.z &&
                    origin.x <= box.upper.x && origin.y <= box.upper.y && origin.z <= box.upper.z)
                    continue;
                const Ray ray{origin, 0.0, target - origin, infinity};
                const std::size_t count = scan.crossings(ray).size();
                EXPECT_EQ(count % 2, 0u) << scene.name << ": " << count << " hits";
                ++rays;
                hits += count;
            }
        }
    }
    EXPECT_GT(rays, 10000u);
    EXPECT_GT(hits, rays);
}

TEST(Crossings, AreOneFromInsideAConvexMesh) {
    for (const Scene& scene : closed_scenes()) {
        const Scan scan(scene);
        for (const Ray& ray : leak_rays(scene, 150, 63)) {
            // A point inside looks through its own side of the mesh only.
            if (scan.touches({ray.origin, -infinity, ray.direction, infinity}).size() < 2) continue;
            EXPECT_EQ(scan.crossings(ray).size(), 1u) << scene.name;
        }
    }
}

TEST(Crossings, FindWhatIsOnlyTouched) {
    // Down along a vertical edge of the cube, and along one of its sides: in at the top, out at the bottom.
    const Scene scene = cube();
    const Scan scan(scene);
    for (const Vec3& origin : {Vec3(1, 1, 5), Vec3(-1, 1, 5), Vec3(1, 0, 5), Vec3(0.25, -1, 5), Vec3(-1, -1, 5)}) {
        const Ray ray{origin, 0.0, {0, 0, -1}, infinity};
        const std::vector<PrimitiveHit> hits = scan.crossings(ray);
        ASSERT_EQ(hits.size(), 2u);
        EXPECT_EQ(hits[0].t, 4.0);
        EXPECT_EQ(hits[1].t, 6.0);
    }
    // A corner touched from the side, with nothing behind it.
    EXPECT_EQ(scan.crossings({{2, 0, 1}, 0.0, {-1, 1, 0}, infinity}).size(), 2u);
}

TEST(Crossings, KeepDuplicates) {
    // Each copy is a surface of its own.
    const Scan scan(stacked_squares(5));
    EXPECT_EQ(scan.crossings({{0.25, 0.25, 0}, 0.0, {0, 0, 1}, infinity}).size(), 5u) << "on the diagonal";
    EXPECT_EQ(scan.crossings({{1, 1, 0}, 0.0, {0, 0, 1}, infinity}).size(), 5u) << "through a corner";
    EXPECT_EQ(scan.crossings({{0.5, -0.25, 0}, 0.0, {0, 0, 1}, infinity}).size(), 5u) << "inside";
}

} // namespace
} // namespace raywise::oracle
