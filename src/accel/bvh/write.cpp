#include "accel/bvh/write.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/bvh/write.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "geometry/corner_lines-inl.h"

#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

static_assert(listed_at_once == triangle_block_size);

// A line of a block.
using FloatLine = float __attribute__((vector_size(triangle_block_size * sizeof(float))));
using DoubleLine = double __attribute__((vector_size(triangle_block_size * sizeof(double))));
template <class T>
using Line = std::conditional_t<std::is_same_v<T, float>, FloatLine, DoubleLine>;

// Half of it, or a point.
template <class T>
using LineLanes = std::conditional_t<std::is_same_v<T, float>, Lanes, DoubleLanes>;

// x y z of the exact corners; the fourth lanes are zero.
template <class T>
struct ExactBox {
    LineLanes<T> lower = LineLanes<T>{} + std::numeric_limits<T>::infinity();
    LineLanes<T> upper = LineLanes<T>{} - std::numeric_limits<T>::infinity();

    HWY_INLINE void extend(const LineLanes<T>& low, const LineLanes<T>& high) {
        lower = low < lower ? low : lower;
        upper = high > upper ? high : upper;
    }
};

// Out of x, y and z of four points each: x y z of two, and of the two others.
template <class Vector>
HWY_INLINE void to_points(const Vector (&lines)[3], Vector (&points)[4]) {
    const Vector xy01 = __builtin_shufflevector(lines[0], lines[1], 0, 4, 1, 5);
    const Vector xy23 = __builtin_shufflevector(lines[0], lines[1], 2, 6, 3, 7);
    const Vector z = __builtin_shufflevector(lines[2], Vector{}, 0, 4, 1, 4);
    const Vector z23 = __builtin_shufflevector(lines[2], Vector{}, 2, 4, 3, 4);
    points[0] = __builtin_shufflevector(xy01, z, 0, 1, 4, 5);
    points[1] = __builtin_shufflevector(xy01, z, 2, 3, 6, 7);
    points[2] = __builtin_shufflevector(xy23, z23, 0, 1, 4, 5);
    points[3] = __builtin_shufflevector(xy23, z23, 2, 3, 6, 7);
}

// Around the corners of eight triangles in lines.
template <class T>
HWY_INLINE void extend(ExactBox<T>& box, const T* lines) {
    LineLanes<T> low[3];
    LineLanes<T> high[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Line<T> corners[3];
        for (std::size_t k = 0; k < 3; ++k)
            std::memcpy(&corners[k], lines + (3 * k + axis) * corner_block, sizeof corners[k]);
        Line<T> lower = corners[0] < corners[1] ? corners[0] : corners[1];
        Line<T> upper = corners[0] > corners[1] ? corners[0] : corners[1];
        lower = lower < corners[2] ? lower : corners[2];
        upper = upper > corners[2] ? upper : corners[2];
        const LineLanes<T> lower_half = __builtin_shufflevector(lower, lower, 0, 1, 2, 3);
        const LineLanes<T> lower_rest = __builtin_shufflevector(lower, lower, 4, 5, 6, 7);
        const LineLanes<T> upper_half = __builtin_shufflevector(upper, upper, 0, 1, 2, 3);
        const LineLanes<T> upper_rest = __builtin_shufflevector(upper, upper, 4, 5, 6, 7);
        low[axis] = lower_half < lower_rest ? lower_half : lower_rest;
        high[axis] = upper_half > upper_rest ? upper_half : upper_rest;
    }
    LineLanes<T> lowest[4];
    LineLanes<T> highest[4];
    to_points(low, lowest);
    to_points(high, highest);
    for (std::size_t i = 0; i < 4; ++i) box.extend(lowest[i], highest[i]);
}

// A block of n triangles out of lines of eight. Most lines are written whole: the block holds what is written beyond their ends, and what
// comes next covers it.
template <class T>
HWY_INLINE void write_lines(const T* lines, const std::uint32_t* ids, std::uint32_t n, std::byte* block) {
    constexpr std::uint32_t half = triangle_block_size / 2;
    constexpr std::uint32_t fewest = half; // 8 n + 8 <= 10 n
    T* const numbers = reinterpret_cast<T*>(block);
    if (HWY_LIKELY(n >= fewest)) {
        for (std::size_t line = 0; line < 9; ++line)
            std::memcpy(numbers + line * n, lines + line * corner_block, triangle_block_size * sizeof(T));
    } else {
        for (std::size_t line = 0; line < 9; ++line) std::copy_n(lines + line * corner_block, n, numbers + line * n);
    }
    if (std::is_same_v<T, float> && HWY_LIKELY(n >= fewest)) {
        std::memcpy(numbers + 9 * n, ids, half * sizeof *ids);
        std::memcpy(numbers + 9 * n + (n - half), ids + (n - half), half * sizeof *ids);
    } else {
        for (std::uint32_t i = 0; i < n; ++i) write_block_id<T>(block, n, i, ids[i]);
    }
}

// A block of n triangles, of one mesh whose vertices are rows of T.
template <class T>
HWY_INLINE void write_listed(const MeshCursor& cursor, const std::uint32_t* ids, std::uint32_t n, std::byte* block,
                             ExactBox<T>& box) {
    std::uint32_t triangles[triangle_block_size]; // the last one again in the place of those that are not there
    for (std::uint32_t i = 0; i < triangle_block_size; ++i) triangles[i] = cursor.triangle(ids[std::min(i, n - 1)]);
    HWY_ALIGN T lines[corner_block_numbers];
    gather_listed(cursor.mesh().arrays(), triangles, lines);
    extend(box, lines);
    write_lines(lines, ids, n, block);
}

template <class T>
HWY_INLINE void write_one_by_one(MeshCursor& cursor, const std::uint32_t* ids, std::uint32_t n, std::byte* block,
                                 ExactBox<T>& box) {
    for (std::uint32_t i = 0; i < n; ++i) {
        cursor.move_to(ids[i]);
        const Corners corners = cursor.mesh().corners(cursor.triangle(ids[i]));
        T numbers[3][3];
        for (std::size_t k = 0; k < 3; ++k) {
            LineLanes<T> point{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                numbers[k][axis] = static_cast<T>(corners[k][static_cast<glm::length_t>(axis)]);
                point[axis] = numbers[k][axis];
            }
            box.extend(point, point);
        }
        write_block_triangle(block, n, i, numbers, ids[i]);
    }
}

template <class T>
HWY_INLINE bool is_listed_in_lanes(const MeshCursor& cursor, const std::uint32_t* ids, std::uint32_t n) {
    const TriangleMesh& mesh = cursor.mesh();
    bool result = mesh.arrays().vertices.has_rows() && mesh.is_float32() == std::is_same_v<T, float>;
    for (std::uint32_t i = 0; i < triangle_block_size; ++i) result &= cursor.contains(ids[std::min(i, n - 1)]);
    return result;
}

template <class T>
HWY_INLINE LeafWriter::Leaf write_leaf_of(WideBvh& bvh, MeshCursor& cursor, std::uint32_t first,
                                          const std::uint32_t* leaf, std::uint32_t count) {
    ExactBox<T> box;
    std::byte* const blocks = bvh.blocks.data() + TriangleBlock<T>::bytes_per_triangle * first;
    for (std::uint32_t begin = 0; begin < count; begin += triangle_block_size) {
        const std::uint32_t* const ids = leaf + begin;
        const std::uint32_t n = std::min(triangle_block_size, count - begin);
        std::byte* const block = blocks + TriangleBlock<T>::bytes_per_triangle * begin;
        cursor.move_to(ids[0]);
        if (HWY_LIKELY(is_listed_in_lanes<T>(cursor, ids, n))) {
            write_listed(cursor, ids, n, block, box);
        } else {
            write_one_by_one(cursor, ids, n, block, box);
        }
    }
    const SceneFrame& frame = bvh.frame;
    DoubleLanes center;
    std::memcpy(&center, frame.center4(), sizeof center);
    DoubleLanes lower = __builtin_convertvector(box.lower, DoubleLanes) - center;
    DoubleLanes upper = __builtin_convertvector(box.upper, DoubleLanes) - center;
    if (frame.center() != Vec3(0.0)) { // as SceneFrame::relative
        lower -= 0x1p-52 * (lower < 0.0 ? -lower : lower);
        upper += 0x1p-52 * (upper < 0.0 ? -upper : upper);
    }
    const DoubleLanes farthest = -lower > upper ? -lower : upper;
    const double distance = larger(farthest[0], larger(farthest[1], farthest[2]));
    const double scale = frame.scale();
    const Bounds around{round_down(lower * scale), round_up(upper * scale)};
    const DoubleLanes size =
        __builtin_convertvector(around.upper, DoubleLanes) - __builtin_convertvector(around.lower, DoubleLanes);
    const double extent = larger(size[0], larger(size[1], size[2]));
    return {NodeRef::leaf(first, count, distance), leaf_box(around, extent), extent};
}

void prefetch_corners(MeshCursor& cursor, const std::uint32_t* primitives, std::uint32_t count) {
    for (std::uint32_t begin = 0; begin < count;) {
        cursor.move_to(primitives[begin]);
        const TriangleArrays& arrays = cursor.mesh().arrays();
        begin = with_indices(arrays.indices, [&](const auto& index) HWY_ATTR {
            std::uint32_t i = begin;
            for (; i < count && cursor.contains(primitives[i]); ++i) {
                const std::uint32_t triangle = cursor.triangle(primitives[i]);
                for (std::uint64_t corner = 0; corner < 3; ++corner) {
                    const auto vertex = static_cast<std::ptrdiff_t>(index(triangle, corner));
                    __builtin_prefetch(arrays.vertices.data + vertex * arrays.vertices.stride);
                }
            }
            return i;
        });
    }
}

LeafWriter::Leaf write_leaf(WideBvh& bvh, MeshCursor& cursor, std::uint32_t first, const std::uint32_t* leaf,
                            std::uint32_t count) {
    return bvh.is_float64 ? write_leaf_of<double>(bvh, cursor, first, leaf, count)
                          : write_leaf_of<float>(bvh, cursor, first, leaf, count);
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(prefetch_corners);
HWY_EXPORT(write_leaf);

void make_blocks(WideBvh& bvh, const Primitives& primitives, std::size_t triangles) {
    const auto& meshes = primitives.meshes();
    bvh.is_float64 = !std::all_of(meshes.begin(), meshes.end(), [](const auto& mesh) { return mesh->is_float32(); });
    const std::size_t bytes = bvh.bytes_per_triangle() * triangles;
    bvh.blocks = PageArray<std::byte>(bytes + triangle_block_padding);
    std::fill_n(bvh.blocks.data() + bytes, triangle_block_padding, std::byte{});
}

LeafWriter::LeafWriter(WideBvh& bvh, const Primitives& primitives) : bvh_(bvh), cursor_(primitives) {}

void LeafWriter::prefetch(const std::uint32_t* primitives, std::uint32_t count) {
    HWY_DYNAMIC_DISPATCH(prefetch_corners)(cursor_, primitives, count);
}

LeafWriter::Leaf LeafWriter::write(std::uint32_t first, const std::uint32_t* leaf, std::uint32_t count) {
    return HWY_DYNAMIC_DISPATCH(write_leaf)(bvh_, cursor_, first, leaf, count);
}

} // namespace raywise
#endif
