#include "accel/bvh/build/morton_keys.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/bvh/build/morton_keys.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "geometry/corner_lines-inl.h"
#include "geometry/mesh_cursor.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

// So many triangles at a time stay in the first-level cache.
constexpr std::uint32_t tile = 256;

using Places = hn::CappedTag<float, corner_block>;
using Cells = hn::RebindToUnsigned<Places>;
using CellVector = hn::VFromD<Cells>;

// Spreads the lowest ten bits so that two zeros follow each, as MortonGrid does.
HWY_INLINE CellVector spread(CellVector x) {
    const Cells d;
    x = hn::And(hn::Or(x, hn::ShiftLeft<16>(x)), hn::Set(d, 0x030000FFu));
    x = hn::And(hn::Or(x, hn::ShiftLeft<8>(x)), hn::Set(d, 0x0300F00Fu));
    x = hn::And(hn::Or(x, hn::ShiftLeft<4>(x)), hn::Set(d, 0x030C30C3u));
    return hn::And(hn::Or(x, hn::ShiftLeft<2>(x)), hn::Set(d, 0x09249249u));
}

// The boxes of the triangles whose lines begin there, along one axis.
struct Span {
    hn::VFromD<Places> lower;
    hn::VFromD<Places> upper;

    HWY_INLINE Span(const float* lines, std::size_t axis) {
        const Places d;
        const auto a = hn::Load(d, lines + axis * corner_block);
        const auto b = hn::Load(d, lines + (3 + axis) * corner_block);
        const auto c = hn::Load(d, lines + (6 + axis) * corner_block);
        lower = hn::Min(a, hn::Min(b, c));
        upper = hn::Max(a, hn::Max(b, c));
    }
};

// Of the middles of the boxes, spread.
HWY_INLINE CellVector cells(const Span& span, int axis, const MortonGrid& grid) {
    const Places d;
    const auto half = hn::Set(d, 0.5f);
    const auto middle = hn::Add(hn::Mul(half, span.lower), hn::Mul(half, span.upper));
    const auto position =
        hn::Mul(hn::Sub(hn::Mul(middle, hn::Set(d, grid.unit()[axis])), hn::Set(d, grid.lower()[axis])),
                hn::Set(d, grid.scale()[axis]));
    constexpr int last_cell = (1 << MortonGrid::bits_per_axis) - 1;
    const auto inside = hn::Min(hn::Max(position, hn::Zero(d)), hn::Set(d, static_cast<float>(last_cell)));
    return spread(hn::BitCast(Cells(), hn::ConvertTo(hn::RebindToSigned<Places>(), inside)));
}

// The codes of the triangles whose lines begin there.
HWY_INLINE CellVector codes(const float* lines, const MortonGrid& grid, const SizeLimits& sizes) {
    const Span x(lines, 0);
    const Span y(lines, 1);
    const Span z(lines, 2);
    const auto extent =
        hn::Max(hn::Sub(x.upper, x.lower), hn::Max(hn::Sub(y.upper, y.lower), hn::Sub(z.upper, z.lower)));
    CellVector code =
        hn::Or(cells(x, 0, grid), hn::Or(hn::ShiftLeft<1>(cells(y, 1, grid)), hn::ShiftLeft<2>(cells(z, 2, grid))));
    const CellVector one_class = hn::Set(Cells(), 1u << (3 * MortonGrid::bits_per_axis));
    for (const float limit : sizes.limits) {
        const auto larger = hn::RebindMask(Cells(), hn::Gt(extent, hn::Set(Places(), limit)));
        code = hn::Add(code, hn::IfThenElseZero(larger, one_class));
    }
    return code;
}

void write_keys_kernel(const Primitives& primitives, std::uint32_t first, std::uint32_t end, const SceneFrame& frame,
                       const MortonGrid& grid, const SizeLimits& sizes, MortonKey* keys) {
    const CornerFrame corner_frame{frame.center(), frame.scale()};
    const bool all_hittable = primitives.hittable_count() == primitives.count();
    HWY_ALIGN float lines[tile / corner_block * corner_block_numbers];
    HWY_ALIGN std::uint32_t codes_of_tile[tile];
    MeshCursor cursor(primitives);
    while (first < end) {
        cursor.move_to(first);
        const std::uint32_t count = std::min({tile, end - first, cursor.end() - first});
        const std::uint32_t triangle = cursor.triangle(first);
        gather_mesh(cursor.mesh(), triangle, triangle + count, corner_frame, lines, 0);
        for (std::uint32_t i = 0; i < count; i += static_cast<std::uint32_t>(hn::Lanes(Places())))
            hn::Store(codes(lane_of(lines, i), grid, sizes), Cells(), codes_of_tile + i);
        for (std::uint32_t i = 0; i < count; ++i) {
            if (all_hittable || primitives.is_hittable(first + i)) *keys++ = {codes_of_tile[i], first + i};
        }
        first += count;
    }
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(write_keys_kernel);

void write_morton_keys(const Primitives& primitives, std::uint32_t first, std::uint32_t end, const SceneFrame& frame,
                       const MortonGrid& grid, const SizeLimits& sizes, MortonKey* keys) {
    HWY_DYNAMIC_DISPATCH(write_keys_kernel)(primitives, first, end, frame, grid, sizes, keys);
}

} // namespace raywise
#endif
