// The edges of a block's triangles as a ray sees them, in float64 lanes: the first steps of triangle_test.h, by the same operations in the same
// order. What they prove is for those who ask (triangle_block-inl.h).
//
// For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
#if defined(RAYWISE_GEOMETRY_BLOCK_EDGES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_GEOMETRY_BLOCK_EDGES_INL_H_
#undef RAYWISE_GEOMETRY_BLOCK_EDGES_INL_H_
#else
#define RAYWISE_GEOMETRY_BLOCK_EDGES_INL_H_
#endif

#include "geometry/triangle_block.h"
#include "ray/exact_ray.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using TriangleLanes = hn::CappedTag<double, triangle_block_size>;
using TriangleVector = hn::VFromD<TriangleLanes>;
inline constexpr std::uint32_t triangle_lanes = hn::MaxLanes(TriangleLanes());

// A ray in all lanes, for as many blocks as it meets.
class BlockRay {
public:
    HWY_INLINE explicit BlockRay(const ExactRay& exact)
        : ray(exact),
          x(static_cast<std::size_t>(exact.x_axis)),
          y(static_cast<std::size_t>(exact.y_axis)),
          z(static_cast<std::size_t>(exact.major_axis)),
          origin_x(hn::Set(TriangleLanes(), exact.axis_origin.x)),
          origin_y(hn::Set(TriangleLanes(), exact.axis_origin.y)),
          origin_z(hn::Set(TriangleLanes(), exact.axis_origin.z)),
          shear_x(hn::Set(TriangleLanes(), exact.shear_x)),
          shear_y(hn::Set(TriangleLanes(), exact.shear_y)) {}

    const ExactRay& ray;
    std::size_t x, y, z; // axes
    TriangleVector origin_x, origin_y, origin_z;
    TriangleVector shear_x, shear_y;
};

// One corner of each triangle, relative to the origin and sheared; z along the major axis.
struct BlockCorner {
    TriangleVector x, y, z;
};

HWY_INLINE TriangleVector load_coordinates(const double* line) { return hn::LoadU(TriangleLanes(), line); }
HWY_INLINE TriangleVector load_coordinates(const float* line) {
    return hn::PromoteTo(TriangleLanes(), hn::LoadU(hn::Rebind<float, TriangleLanes>(), line));
}

// The corners of a block's triangles from `lane` on.
struct BlockTriangles {
    BlockCorner a, b, c;
};

template <class T>
HWY_INLINE BlockTriangles block_triangles(const BlockRay& ray, const TriangleBlock<T>& block, std::uint32_t lane) {
    // One product for each axis, not for each line.
    const T* const x = block.line(0, ray.x) + lane;
    const T* const y = block.line(0, ray.y) + lane;
    const T* const z = block.line(0, ray.z) + lane;
    const std::size_t next = std::size_t{3} * block.pitch;
    const auto corner = [&](std::size_t line) HWY_ATTR {
        const TriangleVector dx = hn::Sub(load_coordinates(x + line), ray.origin_x);
        const TriangleVector dy = hn::Sub(load_coordinates(y + line), ray.origin_y);
        const TriangleVector dz = hn::Sub(load_coordinates(z + line), ray.origin_z);
        return BlockCorner{hn::Sub(dx, hn::Mul(ray.shear_x, dz)), hn::Sub(dy, hn::Mul(ray.shear_y, dz)), dz};
    };
    return {corner(0), corner(next), corner(2 * next)};
}

HWY_INLINE TriangleVector block_edge(const BlockCorner& p, const BlockCorner& q) {
    return hn::Sub(hn::Mul(p.x, q.y), hn::Mul(p.y, q.x));
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
