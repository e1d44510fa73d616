// The "balls" of Haines's Standard Procedural Databases (1987), tessellated: each sphere carries nine of a third of its
// size.
#include "scenes/random.h"
#include "scenes/shapes.h"

namespace raywise::workloads {
namespace {

constexpr int children = 9;

// What a sphere should have at least to look like one.
constexpr std::uint64_t fewest_triangles = 24;

struct Ball {
    Vec3 centre;
    double radius;
    Vec3 up;
};

// Six around the equator and three above, as seen from where the sphere sits on its parent.
std::vector<Ball> carried_by(const Ball& ball, double turn) {
    std::vector<Ball> result;
    const Frame frame(ball.up);
    for (int i = 0; i < children; ++i) {
        const bool at_equator = i < 6;
        const Vec2 around = on_circle(turn + (at_equator ? i / 6.0 : (i - 6) / 3.0 + 1.0 / 12.0));
        const Vec3 local = at_equator ? Vec3(around, 0.0) : Vec3(around * 0.5, 0.8660254037844386);
        const Vec3 direction = frame * local;
        const double radius = ball.radius / 3.0;
        result.push_back({ball.centre + direction * (ball.radius + radius), radius, direction});
    }
    return result;
}

} // namespace

Mesh make_sphereflake(std::uint64_t triangles, std::uint64_t seed);

Mesh make_sphereflake(std::uint64_t triangles, std::uint64_t seed) {
    Random random(seed);
    std::vector<Ball> balls = {{Vec3(0.0), 1.0, Vec3(0.0, 0.0, 1.0)}};
    // Generation after generation while there are triangles enough for the next.
    for (std::size_t parent = 0, end = 1; (balls.size() + (end - parent) * children) * fewest_triangles <= triangles;
         end = balls.size()) {
        for (; parent < end; ++parent) {
            const std::vector<Ball> next = carried_by(balls[parent], random.uniform());
            balls.insert(balls.end(), next.begin(), next.end());
        }
    }
    Mesh mesh;
    // What one sphere leaves over goes to the next.
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const std::uint64_t left = triangles > mesh.triangle_count() ? triangles - mesh.triangle_count() : 0;
        add_sphere(mesh, balls[i].centre, balls[i].radius, left / (balls.size() - i));
    }
    return mesh;
}

} // namespace raywise::workloads
