#include "accel/projected/projected_bvh.h"

#include "accel/bvh_testing.h"

#include <cmath>

namespace raywise {
namespace {

using namespace bvh_testing;

ViewFrame around(const Vec3& origin) { return {ViewFrame::Kind::point, origin, Vec3(0.0), 0.0}; }
ViewFrame towards(const Vec3& origin, const Vec3& target, double half_angle) {
    return {ViewFrame::Kind::point, origin, target - origin, half_angle};
}
ViewFrame along(const Vec3& direction) { return {ViewFrame::Kind::direction, Vec3(0.0), direction, 0.0}; }

// Rays a view is made for, from a point of the scene or towards it. In double or with all numbers rounded to float32.
Ray view_ray(const ViewFrame& view, const Vec3& point, double size, Random& random) {
    Ray ray;
    if (view.kind == ViewFrame::Kind::direction) {
        const double sign = random.integer(0, 1) == 0 ? 1.0 : -1.0;
        ray.direction = sign * random.uniform(0.1, 10.0) * view.direction;
        ray.origin = point;
        if (random.integer(0, 1) == 0) {
            ray.origin -= (3.0 * size / std::sqrt(glm::dot(ray.direction, ray.direction))) * ray.direction;
        }
    } else {
        switch (random.integer(0, 3)) {
            case 0: // camera
            case 1:
                ray = ray_between(view.origin, point);
                break;
            case 2: // shadow ray from the point to the light
                ray = ray_between(point, view.origin, 1.0);
                break;
            default: // the same with a unit direction, and from a little beside the surface
                ray = ray_between(point + 1e-3 * random.direction() * size, view.origin);
                ray.tmax = std::sqrt(glm::dot(ray.direction, ray.direction));
                if (ray.tmax > 0.0) ray.direction /= ray.tmax;
        }
    }
    if (random.integer(0, 3) == 0) {
        ray.direction = through_float(ray.direction);
        if (random.integer(0, 1) == 0) ray.origin = through_float(ray.origin);
    }
    return ray;
}

struct Counts {
    int hits = 0;
    int projected = 0;
    int rays = 0;
};

// The schemes that project, for rays the view is made for and for any others.
Counts expect_same_answers(const Triangles& triangles, const ViewFrame& view, int rays, unsigned seed) {
    Scene scene(triangles);
    Counts counts;
    for (const ProjectionScheme scheme : {ProjectionScheme::rectangles, ProjectionScheme::combined}) {
        const ProjectedBvh bvh(scene.input(view), scheme);
        Random random(seed);
        const Box& bounds = scene.bounds();
        for (int i = 0; i < rays && !testing::Test::HasFailure(); ++i) {
            const bool unrelated = i % 4 == 3;
            const Ray ray = unrelated ? any_ray(triangles, bounds, random)
                                      : view_ray(view, interesting_point(triangles, bounds, random),
                                                 max_component(bounds.size()), random);
            const bool hit = i % 4 == 0 ? expect_same_with_intervals(scene, bvh, ray) : expect_same(scene, bvh, ray);
            if (unrelated || !ray.is_traceable()) continue;
            ++counts.rays;
            counts.hits += hit ? 1 : 0;
            counts.projected += bvh.uses_projection(ExactRay(ray)) ? 1 : 0;
        }
    }
    return counts;
}

// Views of all kinds: from within the scene, from on it, from beside it, from far away.
std::vector<ViewFrame> views_of(const Triangles& triangles, const Box& bounds, unsigned seed) {
    Random random(seed);
    const Vec3 center = bounds.center();
    const double size = max_component(bounds.size());
    const Corners& some = triangles[triangles.size() / 2];
    std::vector<ViewFrame> views;
    for (const Vec3& eye :
         {center, some[0], 0.5 * some[0] + 0.5 * some[1],
          (1.0 / 3.0) * some[0] + (1.0 / 3.0) * some[1] + (1.0 / 3.0) * some[2],
          some[0] + 1e-7 * size * random.direction(), bounds.lower, center + 2.0 * size * random.direction(),
          center + 1e4 * size * random.direction(), center + 1e9 * size * random.direction(),
          through_float(center + size * random.direction())}) {
        views.push_back(around(eye));
        views.push_back(towards(eye, center + 0.1 * size * random.direction(), 0.5));
        views.push_back(towards(eye, center + size * random.direction(), 1.5));
    }
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 direction(0.0);
        direction[axis] = axis == 1 ? -1.0 : 1.0;
        views.push_back(along(direction));
    }
    views.push_back(along(random.direction()));
    views.push_back(along(1e-20 * random.direction()));
    return views;
}

Counts expect_same_answers_in_all_views(const Triangles& triangles, int rays, unsigned seed) {
    Scene scene(triangles);
    Counts counts;
    for (const ViewFrame& view : views_of(triangles, scene.bounds(), seed)) {
        if (testing::Test::HasFailure()) break;
        const Counts some = expect_same_answers(triangles, view, rays, ++seed);
        counts.hits += some.hits;
        counts.projected += some.projected;
        counts.rays += some.rays;
    }
    EXPECT_GT(counts.hits, counts.rays / 10);
    return counts;
}

TEST(ProjectedBvh, NothingToHit) {
    for (const Triangles& triangles : {Triangles{}, Triangles{{Vec3(0.0), Vec3(1.0), Vec3(2.0)}}}) {
        Scene scene(triangles);
        for (const ViewFrame& view : {around(Vec3(0.0)), towards(Vec3(0.0), Vec3(1.0), 0.5), along(Vec3(1.0))}) {
            const ProjectedBvh bvh(scene.input(view));
            expect_same(scene, bvh, {Vec3(0.0), 0.0, Vec3(1.0), infinity});
        }
    }
}

TEST(ProjectedBvh, WithoutAView) {
    const Triangles triangles = soup(300, 0.2, 1);
    Scene scene(triangles);
    const ProjectedBvh bvh(scene.input());
    EXPECT_EQ(bvh.plane_count(), 0u);
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const Ray ray = any_ray(triangles, scene.bounds(), random);
        expect_same_with_intervals(scene, bvh, ray);
        EXPECT_FALSE(bvh.uses_projection(ExactRay(ray)));
    }
}

TEST(ProjectedBvh, BoxesOnly) {
    const Triangles triangles = soup(300, 0.2, 1);
    Scene scene(triangles);
    const Vec3 eye(0.1, 0.2, 3.0);
    const ProjectedBvh bvh(scene.input(around(eye)), ProjectionScheme::boxes);
    EXPECT_EQ(bvh.plane_count(), 0u);
    Random random(2);
    for (int i = 0; i < 200; ++i) expect_same_with_intervals(scene, bvh, ray_between(eye, random.in_cube()));
}

TEST(ProjectedBvh, ViewsThatCannotBeUsed) {
    const Triangles triangles = soup(100, 0.2, 3);
    Scene scene(triangles);
    Random random(4);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const ViewFrame& view : {around(Vec3(nan)), around(Vec3(1e300)), along(Vec3(0.0)), along(Vec3(infinity)),
                                  towards(Vec3(0.0), Vec3(1.0), nan), towards(Vec3(0.0), Vec3(1.0), -1.0),
                                  towards(Vec3(0.0), Vec3(1.0), 7.0)}) {
        const ProjectedBvh bvh(scene.input(view));
        for (int i = 0; i < 50; ++i) expect_same(scene, bvh, any_ray(triangles, scene.bounds(), random));
        for (int i = 0; i < 50; ++i) expect_same(scene, bvh, {Vec3(0.0), 0.0, random.direction(), infinity});
    }
}

TEST(ProjectedBvh, OneTriangle) {
    expect_same_answers_in_all_views({{Vec3(0.0, 0.0, 1.0), Vec3(1.0, 0.0, 1.5), Vec3(0.0, 1.0, 2.0)}}, 60, 5);
}

TEST(ProjectedBvh, SmallSoups) {
    expect_same_answers_in_all_views(soup(40, 0.05, 6), 100, 6);
    expect_same_answers_in_all_views(soup(40, 1.0, 7), 100, 7);
    expect_same_answers_in_all_views(soup(500, 0.1, 8), 60, 8);
}

TEST(ProjectedBvh, LargeSoup) { expect_same_answers_in_all_views(soup(5000, 0.05, 9), 12, 9); }

TEST(ProjectedBvh, ClosedSurfaceFromInsideAndOutside) { expect_same_answers_in_all_views(ball(16, 1.0), 60, 10); }

TEST(ProjectedBvh, GridOfBoxes) { expect_same_answers_in_all_views(grid_of_boxes(3), 80, 11); }

TEST(ProjectedBvh, FlatScenes) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const double height : {0.0, 1.0}) expect_same_answers_in_all_views(flat(6, axis, height), 40, 12);
    }
}

TEST(ProjectedBvh, FloorBelowTheLight) {
    // Two triangles that run under the light and straddle four of its planes, and something on them.
    Triangles triangles;
    add_quad(triangles, Vec3(-100.0, -5.0, -100.0), Vec3(200.0, 0.0, 0.0), Vec3(0.0, 0.0, 200.0));
    const Triangles things = soup(300, 0.3, 13, 4.0, Vec3(0.0, -2.0, 0.0));
    triangles.insert(triangles.end(), things.begin(), things.end());
    for (const Vec3& light :
         {Vec3(0.0), Vec3(0.0, 3.0, 0.0), Vec3(0.0, -5.0, 0.0), Vec3(50.0, -4.999, 1.0), Vec3(99.0, 5.0, 99.0)}) {
        expect_same_answers(triangles, around(light), 300, 14);
        expect_same_answers(triangles, towards(light, Vec3(0.0, -5.0, 0.0), 1.2), 300, 15);
    }
}

TEST(ProjectedBvh, TrianglesThatTouchTheEye) {
    // All share the eye as a corner, have it on an edge, in the middle, or pass it within rounding.
    Random random(16);
    const Vec3 eye(0.3, -0.2, 0.7);
    Triangles triangles;
    for (int i = 0; i < 60; ++i) {
        const Vec3 a = random.in_cube();
        const Vec3 b = random.in_cube();
        triangles.push_back({eye, eye + a, eye + b});
        triangles.push_back({eye - a, eye + a, eye + b});
        triangles.push_back({eye - a - b, eye + a, eye + b});
        const double beside = std::ldexp(1.0, -10 - random.integer(0, 45));
        triangles.push_back({eye + beside * random.direction(), eye + a, eye + b});
        const Vec3 shift = beside * random.direction();
        triangles.push_back({eye + shift - a - b, eye + shift + a, eye + shift + b});
    }
    expect_same_answers(triangles, around(eye), 300, 17);
    for (int i = 0; i < 10; ++i) {
        expect_same_answers(triangles, towards(eye, eye + random.direction(), 0.9), 40, 18 + static_cast<unsigned>(i));
        expect_same_answers(triangles, around(eye + std::ldexp(1.0, -15 - 3 * i) * random.direction()), 40, 19);
    }
}

TEST(ProjectedBvh, FineDetailCloseToTheLight) {
    // Rays of float32 numbers miss the light by about 2^-25, which close to the light is a large angle.
    Random random(30);
    const Vec3 light = through_float(Vec3(0.3, -0.2, 0.7));
    Triangles triangles = soup(20, 0.3, 31, 1.0, light + Vec3(2.5, 0.0, 0.0));
    for (int exponent = 4; exponent <= 18; ++exponent) {
        for (int i = 0; i < 20; ++i) {
            const double distance = std::ldexp(random.uniform(0.5, 1.0), -exponent);
            const Vec3 middle = light + distance * random.direction();
            const double size = distance * std::ldexp(1.0, -random.integer(4, 10));
            triangles.push_back(
                {middle + random.in_cube(size), middle + random.in_cube(size), middle + random.in_cube(size)});
        }
    }
    Scene scene(triangles);
    const ProjectedBvh bvh(scene.input(around(light)));
    int hits = 0;
    int projected = 0;
    const int rays = 6000;
    for (int i = 0; i < rays && !testing::Test::HasFailure(); ++i) {
        const Corners& c =
            triangles[static_cast<std::size_t>(random.integer(20, static_cast<int>(triangles.size()) - 1))];
        const double weight = random.uniform(-0.1, 1.1); // about an edge: that is where the ray may pass on either side
        const Vec3 target = weight * c[0] + (1.0 - weight) * c[1] + random.uniform(-0.05, 0.1) * (c[2] - c[0]);
        const Vec3 away = target - light;
        const Vec3 origin = through_float(light + random.uniform(0.5, 3.0) / max_component(glm::abs(away)) * away);
        // A unit direction: the difference alone often needs no rounding.
        const double distance = std::sqrt(glm::dot(light - origin, light - origin));
        const Ray ray{origin, 0.0, through_float((light - origin) / distance), distance};
        hits += expect_same(scene, bvh, ray) ? 1 : 0;
        projected += bvh.uses_projection(ExactRay(ray)) ? 1 : 0;
    }
    EXPECT_GT(hits, rays / 4);
    EXPECT_GT(projected, rays / 2);
}

TEST(ProjectedBvh, DegenerateAndDuplicateTriangles) {
    Triangles triangles = soup(100, 0.4, 20);
    triangles.insert(triangles.end(), triangles.begin(), triangles.begin() + 50);
    for (std::size_t i = 0; i < triangles.size(); i += 5) triangles[i][2] = triangles[i][0];
    expect_same_answers_in_all_views(triangles, 60, 20);
}

TEST(ProjectedBvh, IdenticalTriangles) {
    Scene scene(Triangles(100000, {Vec3(0.0), Vec3(1.0, 0.0, 0.5), Vec3(0.0, 1.0, 0.5)}));
    const Vec3 eye(0.25, 0.25, -1.0);
    const ProjectedBvh bvh(scene.input(around(eye)));
    expect_same(scene, bvh, {eye, 0.0, Vec3(0.0, 0.0, 1.0), infinity});
    expect_same(scene, bvh, {eye, 0.0, Vec3(3.0, 0.0, 1.0), infinity});
}

TEST(ProjectedBvh, AllScales) {
    for (const double scale : {1e-30, 1e-8, 1e8, 1e30, 1e38})
        expect_same_answers_in_all_views(soup(100, 0.3, 21, scale), 20, 21);
}

TEST(ProjectedBvh, FarFromTheOriginOfCoordinates) {
    expect_same_answers_in_all_views(soup(200, 0.2, 22, 1e-3, Vec3(5e6, -5e6, 5e6)), 40, 22);
    expect_same_answers_in_all_views(soup(200, 0.2, 23, 10.0, Vec3(1e16)), 20, 23);
}

TEST(ProjectedBvh, ViewRaysAreProjected) {
    // Every camera ray, every shadow ray whose numbers are the caller's double or float32, every parallel ray.
    const Triangles triangles = soup(2000, 0.05, 24);
    Scene scene(triangles);
    Random random(25);
    const Vec3 eye(2.0, 3.0, 1.5);
    const Vec3 sun = random.direction();
    const ProjectedBvh cube(scene.input(around(eye)));
    const ProjectedBvh inside(scene.input(around(Vec3(0.1, 0.2, 0.3))));
    const ProjectedBvh camera(scene.input(towards(eye, Vec3(0.0), 0.7)));
    const ProjectedBvh parallel(scene.input(along(sun)));
    EXPECT_EQ(cube.plane_count(), 6u);
    EXPECT_EQ(camera.plane_count(), 1u);
    EXPECT_EQ(parallel.plane_count(), 1u);
    const auto projects = [&](const ProjectedBvh& bvh, const Ray& ray) { return bvh.uses_projection(ExactRay(ray)); };
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p = random.in_cube();
        EXPECT_TRUE(projects(cube, ray_between(eye, p)));
        EXPECT_TRUE(projects(camera, ray_between(eye, p)));
        EXPECT_TRUE(projects(inside, ray_between(Vec3(0.1, 0.2, 0.3), p)));
        EXPECT_TRUE(projects(cube, ray_between(p, eye, 1.0)));
        EXPECT_TRUE(projects(camera, ray_between(p, eye, 1.0)));
        EXPECT_TRUE(projects(inside, ray_between(p, Vec3(0.1, 0.2, 0.3), 1.0)));
        EXPECT_TRUE(projects(parallel, {p, 0.0, 3.0 * sun, infinity}));
        EXPECT_TRUE(projects(parallel, {p, 0.0, -sun, infinity}));
        EXPECT_TRUE(projects(cube, {through_float(p), 0.0, through_float(eye - through_float(p)), 1.0}));
        EXPECT_TRUE(projects(camera, {through_float(p), 0.0, through_float(eye - through_float(p)), 1.0}));
        EXPECT_TRUE(projects(parallel, {p, 0.0, through_float(sun), infinity}));
        // And none that only look like them.
        EXPECT_FALSE(projects(cube, ray_between(eye + Vec3(0.01), p)));
        EXPECT_FALSE(projects(camera, ray_between(eye, 2.0 * eye - p)));
        EXPECT_FALSE(projects(cube, {eye, -1.0, p - eye, infinity}));
        EXPECT_FALSE(projects(inside, ray_between(p, Vec3(0.1, 0.2, 0.3), 2.0)));
        EXPECT_FALSE(projects(parallel, {p, 0.0, sun + Vec3(0.01), infinity}));
    }
}

// Counts the primitives that are tested.
struct CountingCollector {
    ClosestCollector closest;
    std::size_t tested = 0;

    double limit() const { return closest.limit(); }
};

bool test_primitives(const Primitives& primitives, const ExactRay& ray, const std::uint32_t* list, std::size_t count,
                     CountingCollector& collector) {
    collector.tested += count;
    return raywise::test_primitives(primitives, ray, list, count, collector.closest);
}

TEST(ProjectedBvh, VisitsFewTriangles) {
    // Pruned by depth, and no more planes than needed: a closest hit looks at a handful of triangles.
    const Triangles triangles = ball(60, 1.0);
    Scene scene(triangles);
    Random random(26);
    const Vec3 eye(3.0, 0.5, 0.2);
    const ProjectedBvh bvh(scene.input(around(eye)));
    const std::size_t rays = 1000;
    std::size_t total = 0;
    for (std::size_t i = 0; i < rays; ++i) {
        const Ray ray = ray_between(eye, 0.7 * random.direction());
        const Query query;
        CountingCollector counter{ClosestCollector(ray, query)};
        bvh.traverse(ExactRay(ray), counter);
        EXPECT_TRUE(counter.closest.best().is_hit());
        total += counter.tested;
    }
    EXPECT_LT(total, 12 * rays);
    EXPECT_LT(bvh.bytes(), 200 * triangles.size());
}

TEST(ProjectedBvh, CancelsWhileProjecting) {
    Scene scene(soup(20000, 0.02, 27));
    const Parallel parallel(2);
    Progress progress([](double, const char* stage) { return std::string(stage) == "projection"; });
    try {
        const ProjectedBvh bvh({scene.primitives(), {}, around(Vec3(0.0)), parallel, progress});
        FAIL() << "not cancelled";
    } catch (const Error& error) {
        EXPECT_EQ(error.status(), Status::ERROR_CANCELLED);
    }
}

} // namespace
} // namespace raywise
