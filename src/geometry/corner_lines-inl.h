// Triangles' corners out of the caller's arrays, turned into lines of x, y and z that vector registers can take in.
//
// For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
#if defined(RAYWISE_GEOMETRY_CORNER_LINES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_GEOMETRY_CORNER_LINES_INL_H_
#undef RAYWISE_GEOMETRY_CORNER_LINES_INL_H_
#else
#define RAYWISE_GEOMETRY_CORNER_LINES_INL_H_
#endif

#include "geometry/corner_lines.h"
#include "geometry/triangle_mesh.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Vertices of float32 whose components lie side by side.
struct VertexRows {
    const std::byte* data;
    std::ptrdiff_t stride;
    std::uint64_t last; // the last vertex

    template <bool packed>
    HWY_INLINE const std::byte* row(std::uint64_t vertex) const {
        return data + static_cast<std::ptrdiff_t>(vertex) * (packed ? 12 : stride);
    }
};

struct NoIndices {
    HWY_INLINE std::uint64_t operator()(std::uint64_t triangle, std::uint64_t corner) const {
        return 3 * triangle + corner;
    }
};

template <class T>
struct Indices {
    const std::byte* data;
    std::ptrdiff_t stride;
    std::ptrdiff_t component_stride;

    HWY_INLINE std::uint64_t operator()(std::uint64_t triangle, std::uint64_t corner) const {
        T index;
        std::memcpy(&index,
                    data + static_cast<std::ptrdiff_t>(triangle) * stride +
                        static_cast<std::ptrdiff_t>(corner) * component_stride,
                    sizeof index);
        return index;
    }
};

#if HWY_TARGET == HWY_SCALAR

// Corners of four triangles from `first`, to the lines from `lines`.
template <bool packed, class Index>
HWY_INLINE void gather_four(const VertexRows& vertices, const Index& index, std::uint64_t first, float scale,
                            float* HWY_RESTRICT lines) {
    for (std::uint64_t corner = 0; corner < 3; ++corner) {
        for (std::uint64_t i = 0; i < 4; ++i) {
            float row[3];
            std::memcpy(row, vertices.row<packed>(index(first + i, corner)), sizeof row);
            for (std::uint64_t axis = 0; axis < 3; ++axis)
                lines[(3 * corner + axis) * corner_block + i] = scale * row[axis];
        }
    }
}

#else

using Row = hn::FixedTag<float, 4>;

// A vertex and one number more. Packed: four numbers at once, the fourth of the next vertex; the last one has none behind it.
template <bool packed>
HWY_INLINE hn::VFromD<Row> load_row(const VertexRows& vertices, std::uint64_t vertex) {
    const hn::Repartition<std::uint8_t, Row> bytes; // the caller's arrays need not be aligned
    const hn::Half<decltype(bytes)> half;
    const hn::Half<decltype(half)> quarter;
    const auto* const row = reinterpret_cast<const std::uint8_t*>(vertices.row<packed>(vertex));
    if (packed && HWY_LIKELY(vertex != vertices.last)) return hn::BitCast(Row(), hn::LoadU(bytes, row));
    const auto z = hn::ZeroExtendVector(half, hn::LoadU(quarter, row + 8));
    return hn::BitCast(Row(), hn::Combine(bytes, z, hn::LoadU(half, row)));
}

// Corners of four triangles from `first`, to the lines from `lines`.
template <bool packed, class Index>
HWY_INLINE void gather_four(const VertexRows& vertices, const Index& index, std::uint64_t first, float scale,
                            float* HWY_RESTRICT lines) {
    const Row row;
    const auto factor = hn::Set(row, scale);
    for (std::uint64_t corner = 0; corner < 3; ++corner) {
        const auto a = load_row<packed>(vertices, index(first, corner));
        const auto b = load_row<packed>(vertices, index(first + 1, corner));
        const auto c = load_row<packed>(vertices, index(first + 2, corner));
        const auto d = load_row<packed>(vertices, index(first + 3, corner));
        const auto xy_ab = hn::InterleaveLower(row, a, b); // xa xb ya yb
        const auto xy_cd = hn::InterleaveLower(row, c, d);
        const auto z_ab = hn::InterleaveUpper(row, a, b); // za zb . .
        const auto z_cd = hn::InterleaveUpper(row, c, d);
        float* const line = lines + 3 * corner * corner_block;
        hn::StoreU(hn::Mul(hn::ConcatLowerLower(row, xy_cd, xy_ab), factor), row, line);
        hn::StoreU(hn::Mul(hn::ConcatUpperUpper(row, xy_cd, xy_ab), factor), row, line + corner_block);
        hn::StoreU(hn::Mul(hn::ConcatLowerLower(row, z_cd, z_ab), factor), row, line + 2 * corner_block);
    }
}

#endif

inline float* lane_of(float* blocks, std::size_t lane) {
    return blocks + lane / corner_block * corner_block_floats + lane % corner_block;
}

// Triangle by triangle, whatever the layout. Those that are invalid have no corners: NaN stands for them.
inline void gather_one(const TriangleMesh& mesh, std::uint32_t triangle, const CornerFrame& frame, float* lane) {
    const bool valid = mesh.is_valid(triangle);
    const Corners corners = valid ? mesh.corners(triangle) : Corners{};
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<glm::length_t>(axis);
            lane[(3 * k + axis) * corner_block] =
                valid ? static_cast<float>((corners[k][a] - frame.center[a]) * frame.scale)
                      : std::numeric_limits<float>::quiet_NaN();
        }
    }
}

// Fours from `first` on as long as they are below `end`; returns the first that is left.
template <bool packed, class Index>
HWY_INLINE std::uint32_t gather_fours(const VertexRows& vertices, const Index& index, std::uint32_t first,
                                      std::uint32_t end, float scale, float* HWY_RESTRICT blocks, std::size_t lane) {
    for (; end - first >= 4; first += 4, lane += 4)
        gather_four<packed>(vertices, index, first, scale, lane_of(blocks, lane));
    return first;
}

template <bool packed>
HWY_INLINE std::uint32_t gather_fours_of(const TriangleArrays& arrays, const VertexRows& vertices, std::uint32_t first,
                                         std::uint32_t end, float scale, float* HWY_RESTRICT blocks, std::size_t lane) {
    const StridedArray& i = arrays.indices;
    if (i.data == nullptr) return gather_fours<packed>(vertices, NoIndices(), first, end, scale, blocks, lane);
    if (i.scalar == Scalar::uint32) {
        const Indices<std::uint32_t> index{i.data, i.stride, i.component_stride};
        return gather_fours<packed>(vertices, index, first, end, scale, blocks, lane);
    }
    const Indices<std::uint64_t> index{i.data, i.stride, i.component_stride};
    return gather_fours<packed>(vertices, index, first, end, scale, blocks, lane);
}

// Whether a mesh can be read in fours: float32 that needs no more than scaling.
inline bool reads_in_fours(const TriangleMesh& mesh, const CornerFrame& frame) {
    const StridedArray& vertices = mesh.arrays().vertices;
    return vertices.scalar == Scalar::float32 && vertices.has_rows() && mesh.invalid_count() == 0 &&
           frame.center == Vec3(0.0) && frame.scale >= 0x1p-100 && frame.scale <= 0x1p100;
}

// The corners of a mesh's triangles first ... end - 1, to the lanes from `lane` on.
inline void gather_mesh(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t end, const CornerFrame& frame,
                        float* blocks, std::size_t lane) {
    const std::size_t begin_lane = lane - first;
    const auto one = [&](std::uint32_t i) { gather_one(mesh, i, frame, lane_of(blocks, begin_lane + i)); };
    if (reads_in_fours(mesh, frame)) {
        for (; first < end && (begin_lane + first) % 4 != 0; ++first) one(first); // so that no four is in two blocks
        const TriangleArrays& arrays = mesh.arrays();
        const VertexRows vertices{arrays.vertices.data, arrays.vertices.stride, arrays.vertex_count - 1};
        const auto scale = static_cast<float>(frame.scale);
        first = arrays.vertices.is_packed()
                    ? gather_fours_of<true>(arrays, vertices, first, end, scale, blocks, begin_lane + first)
                    : gather_fours_of<false>(arrays, vertices, first, end, scale, blocks, begin_lane + first);
    }
    for (; first < end; ++first) one(first);
}

// NaN for lanes that stand for no triangle.
inline void fill_lanes(float* blocks, std::size_t lane, std::size_t end) {
    for (; lane < end; ++lane) {
        for (std::size_t line = 0; line < 9; ++line)
            lane_of(blocks, lane)[line * corner_block] = std::numeric_limits<float>::quiet_NaN();
    }
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
