#include "accel/grid/cell_pairs.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/grid/cell_pairs.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "geometry/corner_lines-inl.h"
#include "geometry/triangle_box_overlap.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

// So many triangles at a time stay in the first-level cache; and what has just been written is not read at once, in wider registers,
// which would wait for it.
constexpr std::uint32_t tile = 256;

// Triangles whose pairs are written together: first for the cell nearest to the origin, then for each of the seven around it. The same
// for every width of vectors, so that lists are in the same order.
constexpr std::uint32_t group = corner_block;

// Places of the first and the last cell along each axis; of a triangle that is in none, the last lies before the first.
struct GroupRanges {
    HWY_ALIGN std::int32_t lower[3][group];
    HWY_ALIGN std::int32_t upper[3][group];
};

// The lattice in T. A position is off by a rounding of the difference, of cells_per_unit, of their product and of the slack's addition:
// together less than 2^-22 of the cells along the axis in float32, as long as the lower bound is a number of float32. The
// slack is twice that and overlap_slack.
template <class T>
struct Places {
    explicit Places(const CellLattice& lattice) {
        for (std::size_t a = 0; a < 3; ++a) {
            const auto axis = static_cast<glm::length_t>(a);
            const double count = lattice.resolution[a];
            lower[a] = static_cast<T>(lattice.bounds.lower[axis]);
            cells_per_unit[a] = static_cast<T>(lattice.cells_per_unit[axis]);
            slack[a] = static_cast<T>(overlap_slack + (std::is_same_v<T, float> ? 0x1p-21 * count : 0.0));
            last[a] = static_cast<T>(count - 1.0);
        }
    }
    T lower[3];
    T cells_per_unit[3];
    T slack[3];
    T last[3];
};

// Whether float32 tells the places of a mesh's triangles well enough.
bool places_in_float32(const CellLattice& lattice) {
    bool enough = true;
    for (std::size_t a = 0; a < 3; ++a) {
        const double lower = lattice.bounds.lower[static_cast<glm::length_t>(a)];
        const double size = lattice.bounds.size()[static_cast<glm::length_t>(a)];
        enough = enough && static_cast<double>(static_cast<float>(lower)) == lower &&
                 lattice.resolution[a] <= 1u << 14 && (size == 0.0 || (size > 0x1p-90 && size < 0x1p90));
    }
    return enough;
}

// Of the triangles whose lines begin at `lines`; NaN stands for one that is in no cell.
template <class T>
HWY_INLINE void find_ranges(const T* lines, const Places<T>& places, GroupRanges& ranges) {
    const hn::CappedTag<T, group> d;
    const hn::Rebind<std::int32_t, decltype(d)> whole;
    const auto to_whole = [&](auto place) HWY_ATTR {
        if constexpr (std::is_same_v<T, float>) {
            return hn::ConvertTo(whole, place);
        } else {
            return hn::DemoteTo(whole, place);
        }
    };
    for (std::size_t lane = 0; lane < group; lane += hn::Lanes(d)) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const T* const line = lines + axis * corner_block + lane;
            const auto a = hn::Load(d, line);
            const auto b = hn::Load(d, line + 3 * corner_block);
            const auto c = hn::Load(d, line + 6 * corner_block);
            const auto origin = hn::Set(d, places.lower[axis]);
            const auto scale = hn::Set(d, places.cells_per_unit[axis]);
            const auto slack = hn::Set(d, places.slack[axis]);
            const auto last = hn::Set(d, places.last[axis]);
            const auto low = hn::Mul(hn::Sub(hn::Min(hn::Min(a, b), c), origin), scale);
            const auto high = hn::Mul(hn::Sub(hn::Max(hn::Max(a, b), c), origin), scale);
            const auto is_number = hn::Eq(a, a);
            const auto first_place = hn::Min(hn::Max(hn::Sub(low, slack), hn::Zero(d)), last);
            const auto last_place = hn::Min(hn::Max(hn::Add(high, slack), hn::Zero(d)), last);
            hn::Store(to_whole(hn::IfThenElseZero(is_number, first_place)), whole, ranges.lower[axis] + lane);
            hn::Store(to_whole(hn::IfThenElse(is_number, last_place, hn::Set(d, T{-1}))), whole,
                      ranges.upper[axis] + lane);
        }
    }
}

// What a vector of places adds to the cells' numbers.
template <class D>
HWY_INLINE hn::VFromD<D> numbers_of(D d, hn::VFromD<D> place, const AxisNumbers& axis) {
    const auto brick = hn::ShiftRightSame(place, static_cast<int>(axis.brick_shift));
    const auto in_brick = hn::And(place, hn::Set(d, axis.brick_mask()));
    return hn::Add(hn::Mul(brick, hn::Set(d, axis.brick_step)),
                   hn::ShiftLeftSame(in_brick, static_cast<int>(axis.cell_shift)));
}

// Pairs of a group of triangles that reach over at most two cells along each axis. Returns the others, as bits.
HWY_INLINE std::uint32_t add_small(const GroupRanges& ranges, const CellLattice& lattice, std::uint32_t first,
                                   CellPairs& pairs) {
    using D = hn::CappedTag<std::uint32_t, group>;
    using V = hn::VFromD<D>;
    const D d;
    const hn::Rebind<std::int32_t, D> whole;
    constexpr std::size_t lanes = hn::MaxLanes(D());
    constexpr std::size_t vectors = group / lanes;

    HWY_ALIGN std::uint32_t numbers[3][2][group];
    HWY_ALIGN std::uint32_t reach[3][group]; // all bits set where there is a second cell along the axis
    HWY_ALIGN std::uint32_t small[group];
    std::uint32_t large = 0;
    for (std::size_t v = 0; v < vectors; ++v) {
        auto most = hn::Zero(whole);
        auto least = hn::Zero(whole);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto low = hn::Load(whole, ranges.lower[axis] + v * lanes);
            const auto high = hn::Load(whole, ranges.upper[axis] + v * lanes);
            const auto extent = hn::Sub(high, low);
            most = hn::Max(most, extent);
            least = hn::Min(least, extent);
            hn::Store(numbers_of(d, hn::BitCast(d, low), lattice.numbers[axis]), d, numbers[axis][0] + v * lanes);
            hn::Store(numbers_of(d, hn::BitCast(d, high), lattice.numbers[axis]), d, numbers[axis][1] + v * lanes);
            hn::Store(hn::VecFromMask(d, hn::RebindMask(d, hn::Gt(extent, hn::Zero(whole)))), d,
                      reach[axis] + v * lanes);
        }
        const auto is_somewhere = hn::Gt(least, hn::Set(whole, -1));
        const auto is_small = hn::And(is_somewhere, hn::Lt(most, hn::Set(whole, 2)));
        hn::Store(hn::VecFromMask(d, hn::RebindMask(d, is_small)), d, small + v * lanes);
        const auto is_large = hn::And(is_somewhere, hn::Gt(most, hn::Set(whole, 1)));
        if (HWY_UNLIKELY(!hn::AllFalse(whole, is_large))) {
            std::uint8_t bits[8] = {};
            hn::StoreMaskBits(whole, is_large, bits);
            large |= (bits[0] | std::uint32_t{bits[1]} << 8) << (v * lanes);
        }
    }

    const CellPairs::Room room = pairs.make_room(8 * group);
    std::size_t count = 0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const std::size_t x = corner & 1;
        const std::size_t y = corner >> 1 & 1;
        const std::size_t z = corner >> 2;
        for (std::size_t v = 0; v < vectors; ++v) {
            const std::size_t lane = v * lanes;
            V taken = hn::Load(d, small + lane);
            if (x != 0) taken = hn::And(taken, hn::Load(d, reach[0] + lane));
            if (y != 0) taken = hn::And(taken, hn::Load(d, reach[1] + lane));
            if (z != 0) taken = hn::And(taken, hn::Load(d, reach[2] + lane));
            const auto mask = hn::MaskFromVec(taken);
            const V number = hn::Add(hn::Add(hn::Load(d, numbers[0][x] + lane), hn::Load(d, numbers[1][y] + lane)),
                                     hn::Load(d, numbers[2][z] + lane));
            const V primitive = hn::Iota(d, first + static_cast<std::uint32_t>(lane));
            hn::StoreU(hn::Compress(number, mask), d, room.cells + count);
            hn::StoreU(hn::Compress(primitive, mask), d, room.primitives + count);
            count += hn::CountTrue(d, mask);
        }
    }
    pairs.add(count);
    return large;
}

template <class T>
Corners corners_in_cells(const T* lines, std::size_t lane, const CellLattice& lattice) {
    const T* const first = lane_of(lines, lane);
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<glm::length_t>(axis);
            const double coordinate = first[(3 * k + axis) * corner_block];
            corners[k][a] = (coordinate - lattice.bounds.lower[a]) * lattice.cells_per_unit[a];
        }
    }
    return corners;
}

// One triangle, cell by cell.
void add_one(const Corners& corners, const CellLattice& lattice, bool exact, std::uint32_t primitive, std::size_t most,
             CellPairs& pairs) {
    const CellRange range = bounding_cells(corners, lattice.resolution);
    const auto add = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
        const CellPairs::Room room = pairs.make_room(1);
        *room.cells =
            lattice.number(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z));
        *room.primitives = primitive;
        pairs.add(pairs.size() <= most ? 1 : 0); // beyond that nobody looks at them
    };
    if (exact) {
        for_each_overlapped_cell(corners, range, add);
        return;
    }
    for (std::int32_t z = range.lower[2]; z <= range.upper[2] && pairs.size() <= most; ++z) {
        for (std::int32_t y = range.lower[1]; y <= range.upper[1] && pairs.size() <= most; ++y) {
            for (std::int32_t x = range.lower[0]; x <= range.upper[0]; ++x) add(x, y, z);
        }
    }
}

template <class T>
void find_pairs_of_mesh(const Primitives& primitives, const TriangleMesh& mesh, const PrimitiveId& from,
                        std::uint32_t count, std::uint32_t name, const CellLattice& lattice, OverlapTest overlap_test,
                        std::size_t most, CellPairs& pairs) {
    HWY_ALIGN T lines[tile / corner_block * corner_block_numbers];
    const Places<T> places(lattice);
    GroupRanges ranges;
    const bool all_hittable = primitives.hittable_count() == primitives.count();
    for (std::uint32_t begin = 0; begin < count && pairs.size() <= most; begin += tile) {
        const std::uint32_t here = std::min(tile, count - begin);
        gather_mesh(mesh, from.primitive + begin, from.primitive + begin + here, {}, lines, 0);
        fill_lanes(lines, here, corner_blocks_for(here) * corner_block); // they are in no cell
        if (!all_hittable) {
            const std::uint32_t first = primitives.number({from.geometry, from.primitive + begin});
            for (std::uint32_t i = 0; i < here; ++i) {
                if (!primitives.is_hittable(first + i)) fill_lanes(lines, i, i + 1);
            }
        }
        for (std::uint32_t i = 0; i < here; i += group) {
            std::uint32_t rest = 0xFFFFu;
            if (overlap_test != OverlapTest::all) {
                find_ranges(lane_of(lines, i), places, ranges);
                rest = add_small(ranges, lattice, name + begin + i, pairs);
            }
            for (; HWY_UNLIKELY(rest != 0); rest &= rest - 1) {
                const std::uint32_t triangle = i + static_cast<std::uint32_t>(__builtin_ctz(rest));
                const Corners corners = corners_in_cells(lines, triangle, lattice);
                if (std::isnan(corners[0].x)) continue;
                add_one(corners, lattice, overlap_test != OverlapTest::none, name + begin + triangle, most, pairs);
            }
        }
    }
}

void find_cell_pairs_kernel(const Primitives& primitives, std::uint32_t first, std::uint32_t end,
                            const CellLattice& lattice, OverlapTest overlap_test, std::size_t most, CellPairs& pairs) {
    const bool in_float32 = places_in_float32(lattice);
    for (std::uint32_t i = first; i < end;) {
        const PrimitiveId id = primitives.locate(i);
        const TriangleMesh& mesh = *primitives.meshes()[id.geometry];
        const std::uint32_t here = std::min(end - i, mesh.triangle_count() - id.primitive);
        if (mesh.is_float32() && in_float32) {
            find_pairs_of_mesh<float>(primitives, mesh, id, here, i - first, lattice, overlap_test, most, pairs);
        } else {
            find_pairs_of_mesh<double>(primitives, mesh, id, here, i - first, lattice, overlap_test, most, pairs);
        }
        i += here;
    }
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(find_cell_pairs_kernel);

void find_cell_pairs(const Primitives& primitives, std::uint32_t first, std::uint32_t end, const CellLattice& lattice,
                     OverlapTest overlap_test, std::size_t most, CellPairs& pairs) {
    HWY_DYNAMIC_DISPATCH(find_cell_pairs_kernel)(primitives, first, end, lattice, overlap_test, most, pairs);
}

void CellPairs::grow(std::size_t least) {
    const std::size_t capacity = std::max(least, 2 * cells_.size());
    PageArray<std::uint32_t> cells(capacity);
    PageArray<std::uint32_t> primitives(capacity);
    std::copy(cells_.data(), cells_.data() + size_, cells.data());
    std::copy(primitives_.data(), primitives_.data() + size_, primitives.data());
    cells_ = std::move(cells);
    primitives_ = std::move(primitives);
}

} // namespace raywise
#endif
