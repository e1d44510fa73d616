// Triangles' corners out of the caller's arrays, turned into lines of x, y and z (corner_lines.h).
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

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Of triangle `lane` among those whose blocks begin at `blocks`: the first of nine numbers that are corner_block apart.
template <class T>
HWY_INLINE T* lane_of(T* blocks, std::size_t lane) {
    return blocks + lane / corner_block * corner_block_numbers + lane % corner_block;
}

inline constexpr std::uint32_t listed_at_once = 8;

// Whether float32 coordinates get into a frame without leaving float32.
inline bool scales_only(const CornerFrame& frame) {
    return frame.center == Vec3(0.0) && frame.scale >= 0x1p-100 && frame.scale <= 0x1p100;
}

// ---- Reading the caller's arrays. They need not be aligned.

// Vertices whose components lie side by side.
struct VertexRows {
    const std::byte* data;
    std::ptrdiff_t stride;

    HWY_INLINE const std::byte* operator[](std::uint64_t vertex) const {
        return data + static_cast<std::ptrdiff_t>(vertex) * stride;
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

// uint32 side by side, as they usually are.
struct PackedIndices {
    const std::byte* data;

    HWY_INLINE std::uint64_t operator()(std::uint64_t triangle, std::uint64_t corner) const {
        std::uint32_t index;
        std::memcpy(&index, data + 12 * triangle + 4 * corner, sizeof index);
        return index;
    }
};

#if HWY_TARGET == HWY_SCALAR

// The four triangles from `first`, one number after the other.
inline constexpr std::uint32_t group_size = 4;

template <class Coordinate, class Index, class Out>
HWY_INLINE void gather_group(const VertexRows& vertices, const Index& index, std::uint64_t first,
                             const CornerFrame& frame, Out* HWY_RESTRICT lines) {
    for (std::uint64_t corner = 0; corner < 3; ++corner) {
        for (std::uint64_t i = 0; i < group_size; ++i) {
            Coordinate row[3];
            std::memcpy(row, vertices[index(first + i, corner)], sizeof row);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double center = frame.center[static_cast<glm::length_t>(axis)];
                lines[(3 * corner + axis) * corner_block + i] =
                    static_cast<Out>((static_cast<double>(row[axis]) - center) * frame.scale);
            }
        }
    }
}

#else

template <class T>
using PairTag = hn::FixedTag<T, 2>;

// x and y of a vertex.
template <class Coordinate>
HWY_INLINE hn::VFromD<PairTag<double>> load_pair(const std::byte* row) {
    const PairTag<Coordinate> d;
    const hn::Repartition<std::uint8_t, PairTag<Coordinate>> bytes;
    const auto pair = hn::BitCast(d, hn::LoadU(bytes, reinterpret_cast<const std::uint8_t*>(row)));
    if constexpr (std::is_same_v<Coordinate, double>) {
        return pair;
    } else {
        return hn::PromoteTo(PairTag<double>(), pair);
    }
}

// z of a vertex, twice.
template <class Coordinate>
HWY_INLINE hn::VFromD<PairTag<double>> load_third(const std::byte* row) {
    Coordinate z;
    std::memcpy(&z, row + 2 * sizeof z, sizeof z);
    return hn::Set(PairTag<double>(), static_cast<double>(z));
}

template <class Out>
HWY_INLINE void store_pair(hn::VFromD<PairTag<double>> pair, double center, double scale, Out* line) {
    const PairTag<double> d;
    const auto moved = hn::Mul(hn::Sub(pair, hn::Set(d, center)), hn::Set(d, scale));
    if constexpr (std::is_same_v<Out, double>) {
        hn::StoreU(moved, d, line);
    } else {
        const PairTag<float> narrow;
        hn::StoreU(hn::DemoteTo(narrow, moved), narrow, line);
    }
}

// The four triangles from `first`, in float64, two by two.
inline constexpr std::uint32_t group_size = 4;

template <class Coordinate, class Index, class Out>
HWY_INLINE void gather_group(const VertexRows& vertices, const Index& index, std::uint64_t first,
                             const CornerFrame& frame, Out* HWY_RESTRICT lines) {
    const PairTag<double> d;
    for (std::uint64_t corner = 0; corner < 3; ++corner) {
        for (std::uint64_t i = 0; i < group_size; i += 2) {
            const std::byte* const a = vertices[index(first + i, corner)];
            const std::byte* const b = vertices[index(first + i + 1, corner)];
            const auto xy_a = load_pair<Coordinate>(a);
            const auto xy_b = load_pair<Coordinate>(b);
            const auto z = hn::InterleaveLower(d, load_third<Coordinate>(a), load_third<Coordinate>(b));
            Out* const line = lines + 3 * corner * corner_block + i;
            store_pair(hn::InterleaveLower(d, xy_a, xy_b), frame.center.x, frame.scale, line);
            store_pair(hn::InterleaveUpper(d, xy_a, xy_b), frame.center.y, frame.scale, line + corner_block);
            store_pair(z, frame.center.z, frame.scale, line + 2 * corner_block);
        }
    }
}

// ---- The usual case, packed float32 that needs no more than scaling, by whole rows: four numbers, the last of which is the next
// vertex's. The last vertex has none behind it.

using RowTag = hn::CappedTag<float, 8>; // one row or two
inline constexpr std::size_t rows_at_once = hn::MaxLanes(RowTag()) / 4;
inline constexpr std::uint32_t row_group_size = 4 * rows_at_once;
inline constexpr std::uint32_t stretch_size = 256; // triangles that are looked through for the last vertex at once

struct PackedRows {
    const std::byte* data;
    std::uint64_t last; // the last vertex

    template <bool may_be_last>
    HWY_INLINE hn::VFromD<hn::FixedTag<float, 4>> load(std::uint64_t vertex) const {
        const hn::FixedTag<float, 4> row;
        const hn::FixedTag<std::uint8_t, 16> bytes;
        const auto* const address = reinterpret_cast<const std::uint8_t*>(data + 12 * vertex);
        if (may_be_last && HWY_UNLIKELY(vertex == last)) {
            const hn::Half<decltype(bytes)> half;
            const hn::Half<decltype(half)> quarter;
            const auto z = hn::ZeroExtendVector(half, hn::LoadU(quarter, address + 8));
            return hn::BitCast(row, hn::Combine(bytes, z, hn::LoadU(half, address)));
        }
        return hn::BitCast(row, hn::LoadU(bytes, address));
    }
};

// Of the corner of a triangle, and of the one four triangles further on.
template <bool may_be_last, class Index>
HWY_INLINE hn::VFromD<RowTag> load_rows(const PackedRows& vertices, const Index& index, std::uint64_t triangle,
                                        std::uint64_t corner) {
    if constexpr (rows_at_once == 2) {
        return hn::Combine(RowTag(), vertices.load<may_be_last>(index(triangle + 4, corner)),
                           vertices.load<may_be_last>(index(triangle, corner)));
    } else {
        return vertices.load<may_be_last>(index(triangle, corner));
    }
}

template <bool may_be_last, class Index>
HWY_INLINE void gather_row_group(const PackedRows& vertices, const Index& index, std::uint64_t first,
                                 hn::VFromD<RowTag> scale, float* HWY_RESTRICT lines) {
    const RowTag d;
    const hn::Repartition<std::uint64_t, RowTag> wide;
    for (std::uint64_t corner = 0; corner < 3; ++corner) {
        const auto p = load_rows<may_be_last>(vertices, index, first, corner);
        const auto q = load_rows<may_be_last>(vertices, index, first + 1, corner);
        const auto r = load_rows<may_be_last>(vertices, index, first + 2, corner);
        const auto s = load_rows<may_be_last>(vertices, index, first + 3, corner);
        const auto xy_pq = hn::BitCast(wide, hn::InterleaveLower(d, p, q)); // xp xq yp yq
        const auto xy_rs = hn::BitCast(wide, hn::InterleaveLower(d, r, s));
        const auto z_pq = hn::BitCast(wide, hn::InterleaveUpper(d, p, q)); // zp zq . .
        const auto z_rs = hn::BitCast(wide, hn::InterleaveUpper(d, r, s));
        float* const line = lines + 3 * corner * corner_block;
        hn::StoreU(hn::Mul(hn::BitCast(d, hn::InterleaveLower(wide, xy_pq, xy_rs)), scale), d, line);
        hn::StoreU(hn::Mul(hn::BitCast(d, hn::InterleaveUpper(wide, xy_pq, xy_rs)), scale), d, line + corner_block);
        hn::StoreU(hn::Mul(hn::BitCast(d, hn::InterleaveLower(wide, z_pq, z_rs)), scale), d, line + 2 * corner_block);
    }
}

// Whether one of the triangles first ... end - 1 has that vertex.
HWY_INLINE bool has_vertex(const NoIndices&, std::uint32_t first, std::uint32_t end, std::uint64_t vertex) {
    return vertex >= std::uint64_t{3} * first && vertex < std::uint64_t{3} * end;
}

template <class T>
HWY_INLINE bool has_vertex(const Indices<T>& index, std::uint32_t first, std::uint32_t end, std::uint64_t vertex) {
    bool has = false;
    for (std::uint64_t i = first; i < end; ++i) {
        for (std::uint64_t corner = 0; corner < 3; ++corner) has |= index(i, corner) == vertex;
    }
    return has;
}

HWY_INLINE bool has_vertex(const PackedIndices& index, std::uint32_t first, std::uint32_t end, std::uint64_t vertex) {
    const hn::ScalableTag<std::uint32_t> d;
    const hn::Repartition<std::uint8_t, decltype(d)> bytes;
    const auto wanted = hn::Set(d, static_cast<std::uint32_t>(vertex));
    const std::byte* const begin = index.data + std::uint64_t{12} * first;
    const std::size_t count = std::size_t{3} * (end - first);
    std::size_t i = 0;
    auto has = hn::Ne(wanted, wanted);
    for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
        const auto* const address = reinterpret_cast<const std::uint8_t*>(begin + 4 * i);
        has = hn::Or(has, hn::Eq(hn::BitCast(d, hn::LoadU(bytes, address)), wanted));
    }
    bool rest = false;
    for (; i < count; ++i) {
        std::uint32_t number;
        std::memcpy(&number, begin + 4 * i, sizeof number);
        rest |= number == vertex;
    }
    return rest || !hn::AllFalse(d, has);
}

#endif

// ---- Meshes.

// Whether a mesh is read in groups; otherwise triangle by triangle.
inline bool reads_in_groups(const TriangleMesh& mesh) {
    return mesh.arrays().vertices.has_rows() && mesh.invalid_count() == 0;
}

// Groups from `first` on as long as they are below `end`, to the lanes from `lane` on, which is a multiple of the group's size; returns
// the first triangle that is left.
template <class Coordinate, class Index, class Out>
HWY_INLINE std::uint32_t gather_groups(const TriangleArrays& arrays, const Index& index, std::uint32_t first,
                                       std::uint32_t end, const CornerFrame& frame, Out* HWY_RESTRICT blocks,
                                       std::size_t lane) {
    const VertexRows vertices{arrays.vertices.data, arrays.vertices.stride};
#if HWY_TARGET != HWY_SCALAR
    if constexpr (std::is_same_v<Coordinate, float> && std::is_same_v<Out, float>) {
        if (arrays.vertices.is_packed() && scales_only(frame) && lane % row_group_size == 0) {
            const PackedRows rows{arrays.vertices.data, arrays.vertex_count - 1};
            const auto scale = hn::Set(RowTag(), static_cast<float>(frame.scale));
            while (end - first >= row_group_size) {
                const std::uint32_t whole = (end - first) / row_group_size * row_group_size;
                const std::uint32_t stretch_end = first + std::min(stretch_size, whole);
                if (has_vertex(index, first, stretch_end, rows.last)) {
                    for (; first < stretch_end; first += row_group_size, lane += row_group_size)
                        gather_row_group<true>(rows, index, first, scale, lane_of(blocks, lane));
                } else {
                    for (; first < stretch_end; first += row_group_size, lane += row_group_size)
                        gather_row_group<false>(rows, index, first, scale, lane_of(blocks, lane));
                }
            }
        }
    }
#endif
    for (; end - first >= group_size; first += group_size, lane += group_size)
        gather_group<Coordinate>(vertices, index, first, frame, lane_of(blocks, lane));
    return first;
}

// Calls visit(index) with what tells the vertices of a triangle.
template <class Visit>
HWY_INLINE auto with_indices(const StridedArray& i, const Visit& visit) {
    if (i.data == nullptr) return visit(NoIndices());
    if (i.scalar == Scalar::uint32) {
        if (i.is_packed()) return visit(PackedIndices{i.data});
        return visit(Indices<std::uint32_t>{i.data, i.stride, i.component_stride});
    }
    return visit(Indices<std::uint64_t>{i.data, i.stride, i.component_stride});
}

template <class Coordinate, class Out>
HWY_INLINE std::uint32_t gather_groups_of(const TriangleArrays& arrays, std::uint32_t first, std::uint32_t end,
                                          const CornerFrame& frame, Out* HWY_RESTRICT blocks, std::size_t lane) {
    return with_indices(arrays.indices, [&](const auto& index) HWY_ATTR {
        return gather_groups<Coordinate>(arrays, index, first, end, frame, blocks, lane);
    });
}

// Whatever the layout. Triangles that are invalid have no corners: NaN stands for them.
template <class Out>
inline void gather_one(const TriangleMesh& mesh, std::uint32_t triangle, const CornerFrame& frame, Out* lane) {
    const bool valid = mesh.is_valid(triangle);
    const Corners corners = valid ? mesh.corners(triangle) : Corners{};
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<glm::length_t>(axis);
            const double number = (corners[k][a] - frame.center[a]) * frame.scale;
            lane[(3 * k + axis) * corner_block] =
                valid ? static_cast<Out>(number) : std::numeric_limits<Out>::quiet_NaN();
        }
    }
}

// The corners of a mesh's triangles first ... end - 1, to the lanes from `lane` on.
template <class Out>
inline void gather_mesh(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t end, const CornerFrame& frame,
                        Out* blocks, std::size_t lane) {
    const auto one = [&] {
        gather_one(mesh, first, frame, lane_of(blocks, lane));
        ++first;
        ++lane;
    };
    if (reads_in_groups(mesh)) {
        while (first < end && lane % corner_block != 0) one(); // so that no group is in two blocks
        const std::uint32_t begin = first;
        first = mesh.arrays().vertices.scalar == Scalar::float32
                    ? gather_groups_of<float>(mesh.arrays(), first, end, frame, blocks, lane)
                    : gather_groups_of<double>(mesh.arrays(), first, end, frame, blocks, lane);
        lane += first - begin;
    }
    while (first < end) one();
}

// Triangles in a list, in its order.
template <class Index>
struct ListedIndices {
    Index index;
    const std::uint32_t* list;

    HWY_INLINE std::uint64_t operator()(std::uint64_t i, std::uint64_t corner) const { return index(list[i], corner); }
};

// The corners of eight listed triangles of a mesh whose vertices are rows of T, as they are, to the first lanes of a block.
template <class T>
HWY_INLINE void gather_listed(const TriangleArrays& arrays, const std::uint32_t* list, T* HWY_RESTRICT lines) {
    with_indices(arrays.indices, [&](const auto& index) HWY_ATTR {
        const ListedIndices<std::remove_cv_t<std::remove_reference_t<decltype(index)>>> listed{index, list};
#if HWY_TARGET != HWY_SCALAR
        if constexpr (std::is_same_v<T, float>) {
            if (arrays.vertices.is_packed()) {
                const PackedRows rows{arrays.vertices.data, arrays.vertex_count - 1};
                for (std::uint32_t first = 0; first < listed_at_once; first += row_group_size)
                    gather_row_group<true>(rows, listed, first, hn::Set(RowTag(), 1.0f), lines + first);
                return;
            }
        }
#endif
        const VertexRows vertices{arrays.vertices.data, arrays.vertices.stride};
        for (std::uint32_t first = 0; first < listed_at_once; first += group_size)
            gather_group<T>(vertices, listed, first, CornerFrame{}, lines + first);
    });
}

// NaN for lanes that stand for no triangle.
template <class Out>
inline void fill_lanes(Out* blocks, std::size_t lane, std::size_t end) {
    for (; lane < end; ++lane) {
        for (std::size_t line = 0; line < 9; ++line)
            lane_of(blocks, lane)[line * corner_block] = std::numeric_limits<Out>::quiet_NaN();
    }
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
