#include "rays/rays.h"
#include "rays/visible_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

namespace raywise::workloads {
namespace {

double length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

// A tracer for the sphere around a mesh instead of the mesh.
ClosestHits tracer_of(const Sphere& sphere) {
    return [sphere](const Rays& rays) {
        std::vector<SurfacePoint> points;
        for (std::uint64_t i = 0; i < rays.size(); ++i) {
            const Vec3 o = rays.origin_of(i) - sphere.centre, d = rays.direction_of(i);
            const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - sphere.radius * sphere.radius;
            const double root = b * b - a * c;
            const double t = root < 0.0 ? INFINITY : (-b - std::sqrt(root)) / a;
            points.push_back({t, root < 0.0 ? Vec3(0.0) : (o + d * t) / sphere.radius});
        }
        return points;
    };
}

class RaysOfAMesh : public testing::Test {
protected:
    RayRequest request(std::uint64_t count) const { return {mesh_, count, 42, tracer_of(ball_)}; }
    const Mesh mesh_ = scene_named("bumpy_sphere")->make(500, 1);
    const Sphere sphere_ = bounding_sphere(mesh_);
    const Sphere ball_{sphere_.centre, 0.5 * sphere_.radius}; // what the tracer sees: smaller than the image
};

TEST(RayDistributions, AreTheFourOfTheInterfaceInItsOrder) {
    ASSERT_EQ(ray_distributions().size(), 4u);
    const char* names[] = {"random", "camera", "shadow", "diffuse"};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_STREQ(ray_distributions()[i].name, names[i]);
        EXPECT_EQ(ray_distributions()[i].any_hit, i == 2);
    }
}

TEST_F(RaysOfAMesh, AreAsManyAsWanted) {
    for (const RayDistribution& distribution : ray_distributions()) {
        for (const std::uint64_t count : {0u, 1u, 7u, 1000u, 4096u}) {
            const Rays rays = distribution.make(request(count));
            EXPECT_EQ(rays.size(), count) << distribution.name;
            EXPECT_EQ(rays.origin.size(), 3 * count);
            EXPECT_EQ(rays.direction.size(), 3 * count);
            EXPECT_EQ(rays.tmax.size(), count);
        }
    }
}

TEST_F(RaysOfAMesh, AreValidAndRepeatable) {
    for (const RayDistribution& distribution : ray_distributions()) {
        const Rays rays = distribution.make(request(500));
        for (std::uint64_t i = 0; i < rays.size(); ++i) {
            EXPECT_TRUE(is_finite(rays.origin_of(i)) && is_finite(rays.direction_of(i)));
            EXPECT_GT(length(rays.direction_of(i)), 0.0);
            EXPECT_LT(rays.tmin[i], rays.tmax[i]);
        }
        const Rays again = distribution.make(request(500));
        EXPECT_EQ(rays.origin, again.origin);
        EXPECT_EQ(rays.direction, again.direction);
    }
}

TEST_F(RaysOfAMesh, RandomOnesAreChordsOfTheBoundingSphere) {
    const Rays rays = random_rays(request(20000));
    double sum = 0.0;
    for (std::uint64_t i = 0; i < rays.size(); ++i) {
        const Vec3 from = rays.origin_of(i), to = from + rays.direction_of(i);
        EXPECT_NEAR(length(from - sphere_.centre), sphere_.radius, 1e-9);
        EXPECT_NEAR(length(to - sphere_.centre), sphere_.radius, 1e-9);
        sum += length(to - from) / sphere_.radius;
    }
    EXPECT_NEAR(sum / 20000.0, 4.0 / 3.0, 0.02); // the mean chord between two random points of a sphere
}

TEST_F(RaysOfAMesh, CameraOnesShareTheEyeAndFrameTheScene) {
    const Rays rays = camera_rays(request(4800)); // 80 by 60
    const Camera camera = camera_of(mesh_);
    const Vec3 forward = glm::normalize(camera.target - camera.eye);
    double widest = 0.0;
    for (std::uint64_t i = 0; i < rays.size(); ++i) {
        EXPECT_EQ(rays.origin_of(i), camera.eye);
        widest = std::max(widest, std::acos(glm::dot(forward, glm::normalize(rays.direction_of(i)))));
    }
    EXPECT_GT(length(camera.eye - sphere_.centre), sphere_.radius);
    const double radius_seen = std::asin(sphere_.radius / length(camera.eye - sphere_.centre));
    EXPECT_NEAR(radius_seen, camera.vertical_angle / 2.0, 0.01);
    EXPECT_GT(widest, radius_seen);
    EXPECT_LT(widest, 1.5);
    // Row by row: neighbours are close, the first ray is above left of the last.
    EXPECT_LT(length(rays.direction_of(1) - rays.direction_of(0)), 0.02);
    EXPECT_GT(rays.direction_of(0).z, rays.direction_of(4799).z);
}

TEST_F(RaysOfAMesh, ShadowOnesStartOnTheSurfaceAndEndAtTheLight) {
    const Vec3 light = light_of(mesh_);
    const Rays rays = shadow_rays(request(1000));
    for (std::uint64_t i = 0; i < rays.size(); ++i) {
        EXPECT_NEAR(length(rays.origin_of(i) - ball_.centre), ball_.radius, 1e-9);
        EXPECT_NEAR(length(rays.origin_of(i) + rays.direction_of(i) - light), 0.0, 1e-9);
        EXPECT_GT(rays.tmin[i], 0.0);
        EXPECT_LT(rays.tmax[i], 1.0);
    }
}

TEST_F(RaysOfAMesh, DiffuseOnesFollowTheCosine) {
    const std::uint64_t count = 20000;
    const Rays rays = diffuse_rays(request(count));
    double sum = 0.0, sum_of_squares = 0.0;
    for (std::uint64_t i = 0; i < count; ++i) {
        const Vec3 normal = (rays.origin_of(i) - ball_.centre) / ball_.radius; // the eye is outside
        const double cosine = glm::dot(normal, rays.direction_of(i));
        EXPECT_NEAR(length(rays.direction_of(i)), 1.0, 1e-12);
        EXPECT_GE(cosine, -1e-9);
        sum += cosine;
        sum_of_squares += cosine * cosine;
    }
    EXPECT_NEAR(sum / static_cast<double>(count), 2.0 / 3.0, 0.01);
    EXPECT_NEAR(sum_of_squares / static_cast<double>(count), 0.5, 0.01);
}

TEST_F(RaysOfAMesh, SurfaceOnesCoverAllThatIsSeen) {
    const VisiblePoints points = visible_points(request(1000));
    const Vec3 eye = camera_of(mesh_).eye;
    double lowest = INFINITY, highest = -INFINITY;
    for (std::size_t i = 0; i < points.position.size(); ++i) {
        EXPECT_LT(glm::dot(points.normal[i], points.position[i] - eye), 1e-9); // towards the camera
        lowest = std::min(lowest, points.position[i].z);
        highest = std::max(highest, points.position[i].z);
    }
    EXPECT_GT(highest - lowest, 1.5 * ball_.radius);
}

TEST_F(RaysOfAMesh, NothingInViewMeansNoSurfaceRays) {
    RayRequest empty = request(100);
    empty.closest = [](const Rays& rays) { return std::vector<SurfacePoint>(rays.size(), {INFINITY, Vec3(0.0)}); };
    EXPECT_EQ(shadow_rays(empty).size(), 0u);
    EXPECT_EQ(diffuse_rays(empty).size(), 0u);
}

TEST_F(RaysOfAMesh, SurfaceOnesNeedATracer) {
    RayRequest without = request(100);
    without.closest = {};
    EXPECT_THROW(shadow_rays(without), std::invalid_argument);
    EXPECT_EQ(camera_rays(without).size(), 100u);
}

TEST(Cameras, AreInsideWhereTheSceneSaysSo) {
    const Mesh room = scene_named("interior")->make(2000, 1);
    const Camera camera = camera_of(room);
    const Box box = room.bounds();
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GT(camera.eye[axis], box.lower[axis]);
        EXPECT_LT(camera.eye[axis], box.upper[axis]);
        EXPECT_LT(light_of(room)[axis], box.upper[axis]);
    }
}

} // namespace
} // namespace raywise::workloads
