#include "accel/grid/cell_blocks.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/grid/cell_blocks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/primitive_test-inl.h"
#include "geometry/triangle_block.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

// What blocks are made of is fetched ahead, in two steps: the order of cells is not that of the mesh.
class Ahead {
public:
    Ahead(const Primitives& primitives, const std::uint32_t* references, std::uint64_t end)
        : references_(references), end_(end) {
        if (primitives.meshes().size() == 1) arrays_ = &primitives.meshes().front()->arrays();
    }

    HWY_INLINE void fetch(std::uint64_t reference) const {
        if (arrays_ == nullptr) return;
        const StridedArray& indices = arrays_->indices;
        if (indices.data != nullptr && reference + indices_ahead < end_)
            hwy::Prefetch(indices.data + references_[reference + indices_ahead] * indices.stride);
        if (reference + vertices_ahead >= end_) return;
        const std::uint64_t triangle = references_[reference + vertices_ahead];
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint64_t vertex = indices.data != nullptr ? indices.index(triangle, corner)
                                                                 : 3 * triangle + static_cast<std::uint64_t>(corner);
            hwy::Prefetch(arrays_->vertices.data + static_cast<std::ptrdiff_t>(vertex) * arrays_->vertices.stride);
        }
    }

private:
    static constexpr std::uint64_t indices_ahead = 48; // references
    static constexpr std::uint64_t vertices_ahead = 24;

    const TriangleArrays* arrays_ = nullptr;
    const std::uint32_t* references_;
    std::uint64_t end_;
};

// A line of a block. whole: what lies behind it is written later, and may be written over now.
template <class T>
HWY_INLINE void write_line(T* line, const T* numbers, std::uint32_t n, bool whole) {
    std::memcpy(line, numbers, (whole ? triangle_block_size : n) * sizeof(T));
}

// The block of n primitives, at most eight. Returns false where they have to be read one by one.
template <class T>
HWY_INLINE bool write_block(const Primitives& primitives, const std::uint32_t* list, std::uint32_t n, bool whole,
                            std::byte* block) {
    std::uint32_t ids[triangle_block_size]; // the last one again in the place of those that are not there
    for (std::uint32_t i = 0; i < triangle_block_size; ++i) ids[i] = list[std::min(i, n - 1)];
    const ListedTriangles of_mesh(primitives, ids);
    if (!of_mesh.has_rows || of_mesh.mesh.is_float32() != std::is_same_v<T, float>) return false;
    HWY_ALIGN T lines[9 * corner_block];
    gather_listed(of_mesh.mesh.arrays(), of_mesh.triangles, lines);
    T* const target = reinterpret_cast<T*>(block);
    for (std::size_t line = 0; line < 9; ++line) write_line(target + line * n, lines + line * corner_block, n, whole);
    for (std::uint32_t i = 0; i < n; ++i) write_block_id<T>(block, n, i, list[i]);
    return true;
}

template <class T>
void write_blocks(const Primitives& primitives, const GridLists& lists, std::uint64_t first, std::uint64_t end,
                  std::byte* blocks) {
    const std::uint32_t* const references = lists.references.data();
    const std::uint64_t last = lists.offset(end);
    const Ahead ahead(primitives, references, last);
    for (std::uint64_t cell = first; cell < end; ++cell) {
        if ((lists.occupied[cell / cells_per_brick] >> (cell % cells_per_brick) & 1u) == 0) continue;
        const std::uint64_t cell_end = lists.offset(cell + 1);
        for (std::uint64_t i = lists.offset(cell); i < cell_end; i += triangle_block_size) {
            const auto n = static_cast<std::uint32_t>(std::min<std::uint64_t>(triangle_block_size, cell_end - i));
            for (std::uint32_t k = 0; k < n; ++k) ahead.fetch(i + k);
            std::byte* const block = blocks + i * TriangleBlock<T>::bytes_per_triangle;
            // A line of eight reaches seven numbers beyond a block's last line of coordinates, at most.
            const bool whole = last - i >= 2 * triangle_block_size;
            if (write_block<T>(primitives, references + i, n, whole, block)) continue;
            for (std::uint32_t k = 0; k < n; ++k) {
                const Corners corners = primitives.corners(references[i + k]);
                T numbers[3][3];
                for (std::size_t corner = 0; corner < 3; ++corner) {
                    for (std::size_t axis = 0; axis < 3; ++axis)
                        numbers[corner][axis] = static_cast<T>(corners[corner][static_cast<glm::length_t>(axis)]);
                }
                write_block_triangle(block, n, k, numbers, references[i + k]);
            }
        }
    }
}

void write_blocks_kernel(const Primitives& primitives, const GridLists& lists, std::uint64_t first, std::uint64_t end,
                         std::byte* blocks) {
    if (lists.blocks_are_float64) {
        write_blocks<double>(primitives, lists, first, end, blocks);
    } else {
        write_blocks<float>(primitives, lists, first, end, blocks);
    }
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(write_blocks_kernel);

void write_cell_blocks(const Primitives& primitives, const Parallel& parallel, const ProgressPart& progress,
                       GridLists& lists) {
    constexpr std::uint64_t bricks_per_task = 256;
    lists.blocks_are_float64 = !primitives.is_float32();
    PageArray<std::byte> blocks =
        room_for_blocks(lists.references.size() * block_bytes_per_triangle(lists.blocks_are_float64));
    const std::uint64_t bricks = lists.occupied.size();
    const std::uint64_t tasks = (bricks + bricks_per_task - 1) / bricks_per_task;
    std::atomic<std::uint64_t> done{0};
    parallel.for_each(tasks, [&](std::uint64_t task) {
        const std::uint64_t end = std::min(bricks, (task + 1) * bricks_per_task);
        HWY_DYNAMIC_DISPATCH(write_blocks_kernel)
        (primitives, lists, task * bricks_per_task * cells_per_brick, end * cells_per_brick, blocks.data());
        progress.report(static_cast<double>(++done) / static_cast<double>(tasks), "grid: corners");
    });
    lists.blocks = std::move(blocks);
    lists.references = PageArray<std::uint32_t>();
}

bool fits_blocks(const BuildInput& input, std::uint64_t bytes, std::uint64_t references) {
    constexpr std::uint64_t most_for_each = 12;
    if (references > most_for_each * input.primitives.hittable_count()) return false;
    if (input.memory_limit == 0) return true;
    return bytes + references * block_bytes_per_triangle(!input.primitives.is_float32()) <= input.memory_limit;
}

} // namespace raywise
#endif
