#include "oracle/rays.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace raywise::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Frame {
    Vec3 center{0.0};
    double radius = 1.0;
};

Frame frame_of(const Scene& scene) {
    Box box;
    for (const Vec3& v : scene.vertices) box.extend(v);
    if (box.empty()) return {};
    const double radius = 0.75 * max_component(box.size());
    return {box.center(), radius > 0.0 ? radius : 1.0};
}

class Maker {
public:
    Maker(const Scene& scene, unsigned seed) : scene_(scene), frame_(frame_of(scene)), random_(seed) {}

    const Frame& frame() const { return frame_; }
    bool has_triangles() const { return !scene_.triangles.empty(); }

    double number(double low, double high) {
        return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
    }
    int below(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }

    Vec3 in_cube() {
        const double x = number(-1.0, 1.0);
        const double y = number(-1.0, 1.0);
        return {x, y, number(-1.0, 1.0)};
    }
    Vec3 around() { return frame_.center + 1.2 * frame_.radius * in_cube(); }
    Vec3 vertex() { return scene_.vertices[static_cast<std::size_t>(below(static_cast<int>(scene_.vertices.size())))]; }
    Corners triangle() {
        const auto& t = scene_.triangles[static_cast<std::size_t>(below(static_cast<int>(scene_.triangles.size())))];
        return {scene_.vertices[t[0]], scene_.vertices[t[1]], scene_.vertices[t[2]]};
    }
    Vec3 on_edge() {
        const Corners c = triangle();
        const double s = 0.25 * (1 + below(3)); // quarters: mostly without rounding
        return (1.0 - s) * c[0] + s * c[1];
    }
    Vec3 on_triangle() {
        const Corners c = triangle();
        return 0.25 * c[0] + 0.25 * c[1] + 0.5 * c[2];
    }

private:
    const Scene& scene_;
    Frame frame_;
    std::mt19937_64 random_;
};

Ray towards(const Vec3& origin, const Vec3& target) { return {origin, 0.0, target - origin, infinity}; }

// A point that differs from p by steps of a power of two, so that p - origin is exact.
Vec3 stepped_from(Maker& make, const Vec3& p) {
    const int exponent = std::ilogb(make.frame().radius) - 6;
    Vec3 offset;
    for (int axis = 0; axis < 3; ++axis) offset[axis] = std::ldexp(make.below(257) - 128, exponent);
    if (offset == Vec3(0.0)) offset.x = std::ldexp(1.0, exponent);
    return p + offset;
}

// Structures are asked no others.
std::vector<Ray> traceable(std::vector<Ray> rays) {
    rays.erase(std::remove_if(rays.begin(), rays.end(), [](const Ray& ray) { return !ray.is_traceable(); }),
               rays.end());
    return rays;
}

} // namespace

std::vector<Ray> random_rays(const Scene& scene, int count, unsigned seed) {
    Maker make(scene, seed);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        const Vec3 origin = make.around();
        rays.push_back(towards(origin, make.around()));
    }
    return rays;
}

std::vector<Ray> hard_rays(const Scene& scene, int count, unsigned seed) {
    Maker make(scene, seed);
    const double radius = make.frame().radius;
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        // Along axes, with zeros of both signs; in axis planes.
        Ray ray{make.has_triangles() && i % 2 == 0 ? make.vertex() : make.around(), -infinity,
                Vec3(i % 3 == 0 ? -0.0 : 0.0), infinity};
        ray.direction[i % 3] = i % 4 < 2 ? 1.0 : -1.0;
        rays.push_back(ray);
        ray.direction[(i + 1) % 3] = make.number(-1.0, 1.0);
        rays.push_back(ray);
        ray.tmin = 0.0;
        ray.origin[i % 3] -= 4.0 * radius * ray.direction[i % 3];
        rays.push_back(ray);
        if (!make.has_triangles()) continue;

        // Exactly through vertices, edges and triangles.
        for (const Vec3& target : {make.vertex(), make.on_edge(), make.on_triangle()}) {
            rays.push_back(towards(stepped_from(make, target), target));
            rays.push_back(towards(make.around(), target));
            // One that ends there, one that begins there, and one that starts there.
            Ray limited = towards(stepped_from(make, target), target);
            limited.tmax = 1.0;
            rays.push_back(limited);
            limited.tmin = 1.0;
            limited.tmax = infinity;
            rays.push_back(limited);
            rays.push_back({target, 0.0, make.in_cube(), infinity});
            rays.push_back({target, 0.0, stepped_from(make, target) - target, infinity});
        }
        // Along an edge, in a triangle's plane, and almost.
        const Corners c = make.triangle();
        if (c[0] != c[1]) {
            rays.push_back({c[0], -infinity, c[1] - c[0], infinity});
            rays.push_back({c[0] - (c[1] - c[0]), 0.0, c[1] - c[0], infinity});
            rays.push_back({c[2], -infinity, c[1] - c[0], infinity});
            rays.push_back({0.5 * c[1] + 0.5 * c[2], -infinity,
                            (c[1] - c[0]) * (1.0 + 0x1p-40) + 0x1p-30 * radius * make.in_cube(), infinity});
        }
        // Very short and very long directions, from far away, with intervals before and behind.
        Ray extreme = towards(make.around(), make.on_triangle());
        const int exponent = make.below(500) - 250;
        for (int axis = 0; axis < 3; ++axis) extreme.direction[axis] = std::ldexp(extreme.direction[axis], exponent);
        rays.push_back(extreme);
        Ray far =
            towards(make.frame().center + std::ldexp(radius, 10 + make.below(20)) * make.in_cube(), make.on_triangle());
        rays.push_back(far);
        Ray backwards = random_rays(scene, 1, seed + static_cast<unsigned>(i)).front();
        backwards.tmin = -infinity;
        backwards.tmax = make.number(-1.0, 1.0);
        rays.push_back(backwards);
        backwards.tmin = make.number(-2.0, 0.0);
        backwards.tmax = backwards.tmin;
        rays.push_back(backwards);
        // Nearly along an axis, down to the smallest numbers there are.
        Ray steep{make.on_triangle(), -infinity, Vec3(0.0), infinity};
        steep.direction[i % 3] = 1.0;
        steep.direction[(i + 1) % 3] = std::ldexp(make.number(-1.0, 1.0), -make.below(200));
        steep.direction[(i + 2) % 3] = std::ldexp(make.number(-1.0, 1.0), -make.below(60));
        rays.push_back(steep);
        // The same with a direction so short that its smaller parts have no inverse in float32.
        const int shorter = make.below(140);
        for (int axis = 0; axis < 3; ++axis) steep.direction[axis] = std::ldexp(steep.direction[axis], -shorter);
        rays.push_back(steep);
    }
    return traceable(std::move(rays));
}

std::vector<Ray> rays_from_afar(const Scene& scene, double times, int count, unsigned seed) {
    Maker make(scene, seed);
    std::vector<Ray> rays;
    if (!make.has_triangles()) return rays;
    const double distance = times * make.frame().radius;
    for (int i = 0; i < count; ++i) {
        for (const Vec3& target : {make.vertex(), make.on_edge(), make.on_triangle(), make.around()}) {
            const Vec3 away = distance * make.in_cube();
            rays.push_back(towards(target + away, target));
            rays.push_back({target + away, 0.0, -away / distance, infinity});
            // Straight along an axis the target is met, however far away that is.
            Ray straight{target, 0.0, Vec3(0.0), infinity};
            straight.direction[i % 3] = i % 2 == 0 ? 1.0 : -1.0;
            straight.origin -= distance * straight.direction;
            rays.push_back(straight);
            straight.tmax = distance;
            rays.push_back(straight);
        }
    }
    return traceable(std::move(rays));
}

std::vector<Ray> rays_from_close_by(const Scene& scene, int count, unsigned seed) {
    Maker make(scene, seed);
    std::vector<Ray> rays;
    if (!make.has_triangles()) return rays;
    for (int i = 0; i < count; ++i) {
        const Corners c = make.triangle();
        const Vec3 edges = larger(magnitudes(c[1] - c[0]), magnitudes(c[2] - c[0]));
        const Vec3 origin = c[0] + 4.0 * max_component(edges) * make.in_cube();
        rays.push_back(towards(origin, c[1]));
        rays.push_back(towards(origin, 0.25 * c[0] + 0.75 * c[2]));
        rays.push_back(towards(origin, 0.25 * c[0] + 0.25 * c[1] + 0.5 * c[2]));
        rays.push_back({origin, 0.0, make.in_cube(), infinity});
    }
    return traceable(std::move(rays));
}

std::vector<Ray> leak_rays(const Scene& scene, int count, unsigned seed) {
    Maker make(scene, seed);
    const Vec3 inside = make.frame().center;
    const double step = make.frame().radius * 0x1p-52;
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        for (const Vec3& target : {make.vertex(), make.on_edge()}) {
            rays.push_back(towards(inside, target));
            rays.push_back(towards(inside, target + step * make.in_cube()));
            rays.push_back(towards(inside + 0.1 * make.frame().radius * make.in_cube(), target));
        }
    }
    return traceable(std::move(rays));
}

} // namespace raywise::oracle
