// Pieces that scenes are put together from.
#pragma once

#include "scenes/scenes.h"

namespace raywise::workloads {

// The point at `part` (0 ... 1) of a turn on the unit circle, by a polynomial: sine and cosine of the standard library
// differ between platforms in the last bit.
Vec2 on_circle(double part);

// Any two directions square to a unit vector and to each other.
struct Frame {
    Vec3 x, y, z;
    explicit Frame(const Vec3& z_direction);
    Vec3 operator*(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
};

std::uint32_t add_vertex(Mesh& mesh, const Vec3& p);
void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c);

// Twelve triangles; facing outwards, or inwards for a room.
void add_box(Mesh& mesh, const Box& box, bool inwards = false);

// A sphere of rings and segments with about that many triangles: at least 8. Returns how many it got, never more
// than wanted unless wanted is below 8. radius_at: the distance of the surface in a unit direction.
template <class RadiusAt>
std::uint64_t add_ball(Mesh& mesh, const Vec3& centre, std::uint64_t wanted, RadiusAt radius_at);
std::uint64_t add_sphere(Mesh& mesh, const Vec3& centre, double radius, std::uint64_t wanted);

// Smooth noise in [0, 1], and its sum over octaves, each half as strong and twice as fine, in [0, 1].
double noise(const Vec3& p, std::uint64_t seed);
double fractal_noise(Vec3 p, int octaves, std::uint64_t seed);

// --- how add_ball does it ---

struct BallShape {
    std::uint32_t rings;    // circles of vertices between the poles
    std::uint32_t segments; // vertices per circle
};
BallShape ball_shape(std::uint64_t wanted);
void connect_ball(Mesh& mesh, std::uint32_t first_vertex, const BallShape& shape);

template <class RadiusAt>
std::uint64_t add_ball(Mesh& mesh, const Vec3& centre, std::uint64_t wanted, RadiusAt radius_at) {
    const BallShape shape = ball_shape(wanted);
    const Vec3 up(0.0, 0.0, 1.0);
    const std::uint32_t first = add_vertex(mesh, centre - up * radius_at(-up));
    for (std::uint32_t ring = 1; ring <= shape.rings; ++ring) {
        const Vec2 polar = on_circle(0.5 * ring / (shape.rings + 1.0)); // from the lower pole to the upper
        for (std::uint32_t segment = 0; segment < shape.segments; ++segment) {
            const Vec2 around = on_circle(static_cast<double>(segment) / shape.segments);
            const Vec3 direction(polar.y * around.x, polar.y * around.y, -polar.x);
            add_vertex(mesh, centre + direction * radius_at(direction));
        }
    }
    add_vertex(mesh, centre + up * radius_at(up));
    connect_ball(mesh, first, shape);
    return std::uint64_t{shape.rings} * shape.segments * 2;
}

} // namespace raywise::workloads
