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

    HWY_INLINE hn::VFromD<Places> middle() const {
        const auto half = hn::Set(Places(), 0.5f);
        return hn::Add(hn::Mul(half, lower), hn::Mul(half, upper));
    }
};

// Spread.
HWY_INLINE CellVector cells(hn::VFromD<Places> middle, int axis, const MortonGrid& grid) {
    const Places d;
    const auto position =
        hn::Mul(hn::Sub(hn::Mul(middle, hn::Set(d, grid.unit()[axis])), hn::Set(d, grid.lower()[axis])),
                hn::Set(d, grid.scale()[axis]));
    constexpr int last_cell = (1 << MortonGrid::bits_per_axis) - 1;
    const auto inside = hn::Min(hn::Max(position, hn::Zero(d)), hn::Set(d, static_cast<float>(last_cell)));
    return spread(hn::BitCast(Cells(), hn::ConvertTo(hn::RebindToSigned<Places>(), inside)));
}

HWY_INLINE CellVector codes(hn::VFromD<Places> x, hn::VFromD<Places> y, hn::VFromD<Places> z, const MortonGrid& grid) {
    return hn::Or(cells(x, 0, grid), hn::Or(hn::ShiftLeft<1>(cells(y, 1, grid)), hn::ShiftLeft<2>(cells(z, 2, grid))));
}

// The codes of the triangles whose lines begin there.
HWY_INLINE CellVector codes(const float* lines, const MortonGrid& grid, const SizeLimits& sizes) {
    const Span x(lines, 0);
    const Span y(lines, 1);
    const Span z(lines, 2);
    const auto extent =
        hn::Max(hn::Sub(x.upper, x.lower), hn::Max(hn::Sub(y.upper, y.lower), hn::Sub(z.upper, z.lower)));
    CellVector code = codes(x.middle(), y.middle(), z.middle(), grid);
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

// Whether they are triangles of one mesh of float32 rows.
HWY_INLINE bool reads_listed(const MeshCursor& cursor, const SceneFrame& frame,
                             const std::uint32_t (&listed)[middles_at_once]) {
    const TriangleMesh& mesh = cursor.mesh();
    bool result = mesh.arrays().vertices.has_rows() && mesh.is_float32() && frame.float_scale() != 0.0f;
    for (const std::uint32_t primitive : listed) result &= cursor.contains(primitive);
    return result;
}

void write_middles_kernel(const Primitives& primitives, const SceneFrame& frame, const MortonKey* keys,
                          std::uint32_t count, float* lines) {
    static_assert(middles_at_once == corner_block && middles_at_once % listed_at_once == 0);
    const Places d;
    const auto scale = hn::Set(d, frame.float_scale());
    MeshCursor cursor(primitives);
    for (std::uint32_t first = 0; first < count; first += middles_at_once, lines += 3 * middles_at_once) {
        std::uint32_t listed[middles_at_once];
        for (std::uint32_t i = 0; i < middles_at_once; ++i) listed[i] = keys[std::min(first + i, count - 1)].index;
        cursor.move_to(listed[0]);
        if (reads_listed(cursor, frame, listed)) {
            for (std::uint32_t& each : listed) each = cursor.triangle(each);
            HWY_ALIGN float corners[corner_block_numbers];
            for (std::uint32_t i = 0; i < middles_at_once; i += listed_at_once)
                gather_listed(cursor.mesh().arrays(), listed + i, corners + i);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                for (std::uint32_t i = 0; i < middles_at_once; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
                    const auto middle = Span(corners + i, axis).middle();
                    hn::StoreU(hn::Mul(middle, scale), d, lines + axis * middles_at_once + i);
                }
            }
        } else {
            for (std::uint32_t i = 0; i < middles_at_once; ++i) {
                const Vec3 middle = frame.to_frame(primitives.box(listed[i]).center());
                for (std::uint32_t axis = 0; axis < 3; ++axis) {
                    const auto number = static_cast<float>(middle[static_cast<glm::length_t>(axis)]);
                    lines[axis * middles_at_once + i] = number;
                }
            }
        }
    }
}

MortonGrid grid_around(const float* lines, std::uint32_t count) {
    const Places d;
    Bounds bounds = Bounds::none();
    for (int axis = 0; axis < 3; ++axis) {
        const float* const line = lines + static_cast<std::uint32_t>(axis) * middles_at_once;
        auto lower = hn::LoadU(d, line);
        auto upper = lower;
        for (std::uint32_t first = 0; first < count; first += middles_at_once) {
            for (std::uint32_t i = 0; i < middles_at_once; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
                const auto here = hn::LoadU(d, line + std::size_t{3} * first + i);
                lower = hn::Min(lower, here);
                upper = hn::Max(upper, here);
            }
        }
        bounds.lower[axis] = hn::GetLane(hn::MinOfLanes(d, lower));
        bounds.upper[axis] = hn::GetLane(hn::MaxOfLanes(d, upper));
    }
    return MortonGrid(bounds);
}

bool write_codes_kernel(const float* lines, std::uint32_t count, MortonKey* keys) {
    const Places d;
    const MortonGrid grid = grid_around(lines, count);
    if (!grid.divides()) return false;
    for (std::uint32_t first = 0; first < count; first += middles_at_once, lines += 3 * middles_at_once) {
        HWY_ALIGN std::uint32_t codes_here[middles_at_once];
        for (std::uint32_t i = 0; i < middles_at_once; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
            const auto x = hn::LoadU(d, lines + i);
            const auto y = hn::LoadU(d, lines + middles_at_once + i);
            const auto z = hn::LoadU(d, lines + 2 * middles_at_once + i);
            hn::StoreU(codes(x, y, z, grid), Cells(), codes_here + i);
        }
        const std::uint32_t end = std::min(count - first, middles_at_once);
        for (std::uint32_t i = 0; i < end; ++i) keys[first + i].code = codes_here[i];
    }
    return true;
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(write_keys_kernel);
HWY_EXPORT(write_middles_kernel);
HWY_EXPORT(write_codes_kernel);

void write_morton_keys(const Primitives& primitives, std::uint32_t first, std::uint32_t end, const SceneFrame& frame,
                       const MortonGrid& grid, const SizeLimits& sizes, MortonKey* keys) {
    HWY_DYNAMIC_DISPATCH(write_keys_kernel)(primitives, first, end, frame, grid, sizes, keys);
}

void write_middles(const Primitives& primitives, const SceneFrame& frame, const MortonKey* keys, std::uint32_t count,
                   float* lines) {
    HWY_DYNAMIC_DISPATCH(write_middles_kernel)(primitives, frame, keys, count, lines);
}

bool write_codes(const float* lines, std::uint32_t count, MortonKey* keys) {
    return HWY_DYNAMIC_DISPATCH(write_codes_kernel)(lines, count, keys);
}

} // namespace raywise
#endif
