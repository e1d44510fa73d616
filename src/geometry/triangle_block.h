// Blocks of triangles: the layout that leaves keep their triangles in and that test_triangle_block (triangle_block-inl.h) reads.
#pragma once

#include "base/page_array.h"
#include "geometry/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace raywise {

// As many triangles as the widest registers hold float64.
inline constexpr std::uint32_t triangle_block_size = 8;

// n <= 8 triangles: nine lines of coordinates, x y z of the first corners, then of the second and the third, and a line of primitive
// ids, each in a place as large as a coordinate. T is float or double, as the coordinates were given: nothing is rounded, moved
// or scaled. In leaves lines are n long, blocks follow each other without gaps, and behind the last one triangle_block_padding bytes may be
// read.
template <class T>
struct TriangleBlock {
    static constexpr std::size_t bytes_per_triangle = 10 * sizeof(T);

    TriangleBlock(const std::byte* block, std::uint32_t triangles) : TriangleBlock(block, triangles, triangles) {}
    // line_length: at least n.
    TriangleBlock(const std::byte* block, std::uint32_t triangles, std::uint32_t line_length)
        : data(block), n(triangles), pitch(line_length) {}

    const std::byte* data;
    std::uint32_t n;
    std::uint32_t pitch; // coordinates from line to line

    const T* line(std::size_t corner, std::size_t axis) const {
        return reinterpret_cast<const T*>(data) + (3 * corner + axis) * pitch;
    }
    std::uint32_t id(std::uint32_t i) const {
        std::uint32_t result;
        std::memcpy(&result, data + sizeof(T) * (9 * pitch + i), sizeof result);
        return result;
    }
    Corners corners(std::uint32_t i) const { return {corner(0, i), corner(1, i), corner(2, i)}; }

private:
    Vec3 corner(std::size_t k, std::uint32_t i) const {
        return {static_cast<double>(line(k, 0)[i]), static_cast<double>(line(k, 1)[i]),
                static_cast<double>(line(k, 2)[i])};
    }
};

inline constexpr std::size_t triangle_block_padding = triangle_block_size * sizeof(double);

inline constexpr std::size_t block_bytes_per_triangle(bool is_float64) {
    return is_float64 ? TriangleBlock<double>::bytes_per_triangle : TriangleBlock<float>::bytes_per_triangle;
}

// Room for blocks of so many bytes, and the padding behind them.
inline PageArray<std::byte> room_for_blocks(std::size_t bytes) {
    PageArray<std::byte> blocks(bytes + triangle_block_padding);
    std::memset(blocks.data() + bytes, 0, triangle_block_padding);
    return blocks;
}

template <class T>
void write_block_id(std::byte* block, std::uint32_t pitch, std::uint32_t i, std::uint32_t id) {
    std::byte* const place = block + sizeof(T) * (9 * pitch + i);
    std::memset(place, 0, sizeof(T));
    std::memcpy(place, &id, sizeof id);
}

// Writes triangle i of a block of n.
template <class T>
void write_block_triangle(std::byte* block, std::uint32_t n, std::uint32_t i, const T (&corners)[3][3],
                          std::uint32_t id) {
    T* lines = reinterpret_cast<T*>(block) + i;
    for (const auto& corner : corners) {
        for (const T coordinate : corner) {
            *lines = coordinate;
            lines += n;
        }
    }
    write_block_id<T>(block, n, i, id);
}

} // namespace raywise
