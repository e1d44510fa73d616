// A scan by outcodes (outcode_ray.h): a pass over the vertices notes on which sides of the rays each lies, a few bits for each ray; a pass over
// the triangles puts the notes of their corners together. Both read the caller's arrays one after the other, and what the second jumps
// about in is a byte a vertex for one ray, four or eight for as many rays as a register has lanes. So a vertex is sheared once for all of
// its triangles, and a triangle looked at once for all rays.
//
// For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
#if defined(RAYWISE_ACCEL_SCAN_OUTCODES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_ACCEL_SCAN_OUTCODES_INL_H_
#undef RAYWISE_ACCEL_SCAN_OUTCODES_INL_H_
#else
#define RAYWISE_ACCEL_SCAN_OUTCODES_INL_H_
#endif

#include "accel/scan/outcode_ray.h"
#include "geometry/corner_lines-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// ---- Reading vertices, in coordinates that the rays take.

// Packed float32 that only needs scaling, which is left to the rays.
struct PackedVertices {
    const std::byte* data;

    HWY_INLINE void read(std::uint64_t vertex, float* p) const {
        for (std::uint64_t axis = 0; axis < 3; ++axis) std::memcpy(p + axis, data + 12 * vertex + 4 * axis, 4);
    }
};

template <class Coordinate>
struct RowVertices {
    VertexRows rows;
    CornerFrame frame;

    HWY_INLINE void read(std::uint64_t vertex, float* p) const {
        Coordinate row[3];
        std::memcpy(row, rows[vertex], sizeof row);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double center = frame.center[static_cast<glm::length_t>(axis)];
            p[axis] = static_cast<float>((static_cast<double>(row[axis]) - center) * frame.scale);
        }
    }
};

// Of any layout.
struct StridedVertices {
    const StridedArray* array;
    CornerFrame frame;

    HWY_INLINE void read(std::uint64_t vertex, float* p) const {
        const Vec3 v = (array->vec3(vertex) - frame.center) * frame.scale;
        for (glm::length_t axis = 0; axis < 3; ++axis) p[axis] = static_cast<float>(v[axis]);
    }
};

// Calls visit(vertices, scale): scale is what is left to the rays.
template <class Visit>
HWY_INLINE void with_vertices(const StridedArray& array, const CornerFrame& frame, const Visit& visit) {
    const VertexRows rows{array.data, array.stride};
    if (array.is_packed() && array.scalar == Scalar::float32 && scales_only(frame)) {
        visit(PackedVertices{array.data}, static_cast<float>(frame.scale));
    } else if (!array.has_rows()) {
        visit(StridedVertices{&array, frame}, 1.0f);
    } else if (array.scalar == Scalar::float32) {
        visit(RowVertices<float>{rows, frame}, 1.0f);
    } else {
        visit(RowVertices<double>{rows, frame}, 1.0f);
    }
}

// ---- One ray: a byte for each vertex, with a bit for each side. Vertices are in the lanes.

struct OneRayCode {
    using Code = std::uint8_t;
    static constexpr std::size_t rays = 1;

    // Whether the corners of a triangle, whose codes have these bits in common, may be around the ray.
    static HWY_INLINE std::uint32_t near(Code common) { return common == 0 ? 1 : 0; }

    template <class Vertices>
    static HWY_INLINE void note(const OutcodeRay* ray, const Vertices& vertices, std::uint64_t count, Code* codes) {
        const hn::CappedTag<float, 16> d;
        const hn::Rebind<std::uint8_t, decltype(d)> bytes;
        const std::size_t lanes = hn::Lanes(d);
        const Sides<decltype(d)> sides(*ray);
        std::uint64_t v = 0;
#if HWY_TARGET != HWY_SCALAR
        if constexpr (std::is_same_v<Vertices, PackedVertices>) {
            for (; v + lanes <= count; v += lanes) {
                hn::Vec<decltype(d)> x, y, z;
                hn::LoadInterleaved3(d, reinterpret_cast<const float*>(vertices.data + 12 * v), x, y, z);
                hn::StoreU(hn::DemoteTo(bytes, sides(x, y, z)), bytes, codes + v);
            }
        }
#endif
        HWY_ALIGN float lines[3][hn::MaxLanes(decltype(d)())] = {};
        for (; v < count; v += lanes) {
            for (std::size_t i = 0; i < std::min<std::uint64_t>(lanes, count - v); ++i) {
                float p[3];
                vertices.read(v + i, p);
                for (std::size_t axis = 0; axis < 3; ++axis) lines[axis][i] = p[axis];
            }
            const auto code = sides(hn::Load(d, lines[0]), hn::Load(d, lines[1]), hn::Load(d, lines[2]));
            hn::StoreU(hn::DemoteTo(bytes, code), bytes, codes + v);
        }
    }

private:
    // On which sides of a ray vertices are.
    template <class D>
    struct Sides {
        using Vector = hn::Vec<D>;
        using Bits = hn::RebindToSigned<D>;

        HWY_INLINE explicit Sides(const OutcodeRay& ray)
            : xx(hn::Set(D(), ray.x[0])),
              xy(hn::Set(D(), ray.x[1])),
              xz(hn::Set(D(), ray.x[2])),
              yx(hn::Set(D(), ray.y[0])),
              yy(hn::Set(D(), ray.y[1])),
              yz(hn::Set(D(), ray.y[2])),
              offset_x(hn::Set(D(), ray.offset_x)),
              offset_y(hn::Set(D(), ray.offset_y)),
              error(hn::Set(D(), ray.error)),
              minus_error(hn::Neg(error)) {}

        HWY_INLINE hn::Vec<Bits> operator()(Vector px, Vector py, Vector pz) const {
            const Vector x = hn::MulAdd(xx, px, hn::MulAdd(xy, py, hn::MulSub(xz, pz, offset_x)));
            const Vector y = hn::MulAdd(yx, px, hn::MulAdd(yy, py, hn::MulSub(yz, pz, offset_y)));
            return hn::Or(hn::Or(side(hn::Gt(x, error), 1), side(hn::Lt(x, minus_error), 2)),
                          hn::Or(side(hn::Gt(y, error), 4), side(hn::Lt(y, minus_error), 8)));
        }

        template <class Mask>
        static HWY_INLINE hn::Vec<Bits> side(Mask mask, int bit) {
            return hn::IfThenElseZero(hn::RebindMask(Bits(), mask), hn::Set(Bits(), bit));
        }

        Vector xx, xy, xz;
        Vector yx, yy, yz;
        Vector offset_x;
        Vector offset_y;
        Vector error;
        Vector minus_error;
    };
};

// ---- Many rays: four groups of bits for each vertex, one for each side, with a bit for each ray. Rays are in the lanes.

template <std::size_t most_lanes>
struct ManyRaysCode {
    using D = hn::CappedTag<float, most_lanes>;
    static constexpr std::size_t rays = hn::MaxLanes(D());
    using Code = std::conditional_t<(rays > 8), std::uint64_t, std::uint32_t>;
    static constexpr std::size_t side_bytes = sizeof(Code) / 4;
    static constexpr std::size_t side_bits = 8 * side_bytes;

    static HWY_INLINE std::uint32_t near(Code common) {
        common |= common >> 2 * side_bits;
        common |= common >> side_bits;
        return ~static_cast<std::uint32_t>(common); // of which the first bits mean something
    }

    template <class Vertices>
    static HWY_INLINE void note(const OutcodeRay* group, const Vertices& vertices, std::uint64_t count, Code* codes) {
        const D d;
        HWY_ALIGN float lines[9][rays];
        for (std::size_t i = 0; i < rays; ++i) {
            const OutcodeRay& ray = group[i];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                lines[axis][i] = ray.x[axis];
                lines[3 + axis][i] = ray.y[axis];
            }
            lines[6][i] = ray.offset_x;
            lines[7][i] = ray.offset_y;
            lines[8][i] = ray.error;
        }
        const auto xx = hn::Load(d, lines[0]);
        const auto xy = hn::Load(d, lines[1]);
        const auto xz = hn::Load(d, lines[2]);
        const auto yx = hn::Load(d, lines[3]);
        const auto yy = hn::Load(d, lines[4]);
        const auto yz = hn::Load(d, lines[5]);
        const auto offset_x = hn::Load(d, lines[6]);
        const auto offset_y = hn::Load(d, lines[7]);
        const auto error = hn::Load(d, lines[8]);
        const auto minus_error = hn::Neg(error);
        for (std::uint64_t v = 0; v < count; ++v) {
            float p[3];
            vertices.read(v, p);
            const auto px = hn::Set(d, p[0]);
            const auto py = hn::Set(d, p[1]);
            const auto pz = hn::Set(d, p[2]);
            const auto x = hn::MulAdd(xx, px, hn::MulAdd(xy, py, hn::MulSub(xz, pz, offset_x)));
            const auto y = hn::MulAdd(yx, px, hn::MulAdd(yy, py, hn::MulSub(yz, pz, offset_y)));
            auto* const out = reinterpret_cast<std::uint8_t*>(codes + v);
            hn::StoreMaskBits(d, hn::Gt(x, error), out);
            hn::StoreMaskBits(d, hn::Lt(x, minus_error), out + side_bytes);
            hn::StoreMaskBits(d, hn::Gt(y, error), out + 2 * side_bytes);
            hn::StoreMaskBits(d, hn::Lt(y, minus_error), out + 3 * side_bytes);
        }
    }
};

// ---- Memory for the codes of a mesh.

class CodeMemory {
public:
    // Null where there is none to be had.
    std::byte* take(std::size_t bytes) {
        if (bytes <= sizeof few_) return few_;
        many_.reset(new (std::nothrow) std::byte[bytes]);
        return many_.get();
    }

private:
    alignas(64) std::byte few_[4096];
    std::unique_ptr<std::byte[]> many_;
};

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
