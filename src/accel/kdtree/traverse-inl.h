// The walk itself. For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
//
// Why it cannot lose a hit. Let P be the point where the exact ray meets a primitive, at the exact distance s. The builder sees to it that, from
// the root down, the primitive is always on a side of the plane that P belongs to; points on the plane belong to both. That leads to one leaf.
// The walk reaches it: a cell is left out only where a plane it lies beyond is entered later than another is left, or outside of the interval
// that hits may lie in, by more than all of that may be off by:
// - Distances of planes are those of ray/traversal_ray.h, moved outwards in the same way; what is relative to a distance is in the comparison.
// - A hit's reported distance is the exact one but for 2^-28.6 E, E the largest extent of a primitive, and one relative to the distance
//   (ray/cell_ray.h): exits are later by 2^-27 E, KdTreelets::hit_error, which stands for both ends of the interval, and its own end too.
// - A component of the direction below 2^-120 is taken for that, which moves a point by less than 2^-113, and coordinates below the normal
//   numbers round by less than that: planes are taken for as far as 2^-112 on both sides.
#if defined(RAYWISE_ACCEL_KDTREE_TRAVERSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_ACCEL_KDTREE_TRAVERSE_INL_H_
#undef RAYWISE_ACCEL_KDTREE_TRAVERSE_INL_H_
#else
#define RAYWISE_ACCEL_KDTREE_TRAVERSE_INL_H_
#endif

#include "accel/collectors.h"
#include "accel/kdtree/treelets.h"
#include "geometry/triangle_block-inl.h"
#include "ray/traversal_ray-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

inline constexpr float kd_unbounded = std::numeric_limits<float>::infinity();

// A part of a ray.
struct KdInterval {
    float near;
    float far;

    HWY_INLINE bool is_possible() const { return near <= far + TraversalRay::box_slack * std::fabs(far); }
};

// What a ray makes of planes across each axis.
struct KdAxes {
    float inverse[3];
    float entry_offset[3];
    float exit_offset[3];

    HWY_INLINE KdAxes(const TraversalRay& ray, float hit_error) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float least = 0x1p-112f * std::fabs(ray.inverse[axis]);
            inverse[axis] = ray.inverse[axis];
            entry_offset[axis] = ray.entry_offset[axis] + least;
            exit_offset[axis] = ray.exit_offset[axis] - least - hit_error;
        }
    }

    HWY_INLINE KdInterval within(const BoxF& bounds, KdInterval interval) const {
        for (int axis = 0; axis < 3; ++axis) {
            const bool is_backwards = std::signbit(inverse[axis]);
            const float entered = is_backwards ? bounds.upper[axis] : bounds.lower[axis];
            const float left = is_backwards ? bounds.lower[axis] : bounds.upper[axis];
            interval.near = std::max(interval.near, entered * inverse[axis] - entry_offset[axis]);
            interval.far = std::min(interval.far, left * inverse[axis] - exit_offset[axis]);
        }
        return interval;
    }
};

// Where a ray enters and leaves the cells of a treelet.
struct KdCells {
    alignas(32) float near[treelet_cells];
    alignas(32) float far[treelet_cells];
};

using TreeletLanes = hn::CappedTag<float, treelet_cells>;

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL

// All cells at once, each with its plane on every level.
class TreeletTest {
public:
    HWY_INLINE explicit TreeletTest(const KdAxes& axes) {
        const TreeletLanes d;
        const Vector inverse = by_axis(axes.inverse);
        const Vector entry_offset = by_axis(axes.entry_offset);
        const Vector exit_offset = by_axis(axes.exit_offset);
        // Cells above a plane in their own order, for a ray that runs backwards in the other: which of them it enters through the plane.
        const auto is_above = hn::Not(hn::FirstN(d, 4));
        const auto enters = hn::Xor(hn::Lt(inverse, hn::Zero(d)), is_above);
        entry_inverse_ = hn::IfThenElseZero(enters, inverse);
        entry_offset_ = hn::IfThenElse(enters, entry_offset, hn::Set(d, kd_unbounded));
        exit_inverse_ = hn::IfThenZeroElse(enters, inverse);
        exit_offset_ = hn::IfThenElse(enters, hn::Set(d, -kd_unbounded), exit_offset);
    }

    // Which cells the part of the ray may pass, as bits.
    HWY_INLINE std::uint32_t operator()(const KdTreelet& treelet, KdInterval part, KdCells& cells) const {
        const TreeletLanes d;
        const auto shape = hn::Set(Indices(), treelet.shape);
        const auto split = hn::Load(d, treelet.split);
        const Level root = level<0>(shape, split);
        const Level middle = level<1>(shape, split);
        const Level last = level<2>(shape, split);
        const auto near = hn::Max(hn::Max(root.near, middle.near), hn::Max(last.near, hn::Set(d, part.near)));
        const auto far = hn::Min(hn::Min(root.far, middle.far), hn::Min(last.far, hn::Set(d, part.far)));
        hn::Store(near, d, cells.near);
        hn::Store(far, d, cells.far);
        const auto passes = hn::Le(near, hn::MulAdd(hn::Abs(far), hn::Set(d, TraversalRay::box_slack), far));
        std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(d, passes, bytes);
        return bytes[0] & treelet.present();
    }

private:
    using Vector = hn::VFromD<TreeletLanes>;
    using Indices = hn::RebindToUnsigned<TreeletLanes>;
    struct Level {
        Vector near;
        Vector far;
    };

    // Twice x y z and anything. Numbers are read one by one, as they have been written: a wider read would wait for them to reach the cache (a
    // store-forwarding stall).
    static HWY_INLINE Vector by_axis(const float* numbers) {
        const TreeletLanes d;
        alignas(32) static constexpr float axes[treelet_cells] = {0, 1, 2, 0, 0, 1, 2, 0};
        const Vector axis = hn::Load(d, axes);
        const Vector xy =
            hn::IfThenElse(hn::Eq(axis, hn::Set(d, 1.0f)), hn::Set(d, numbers[1]), hn::Set(d, numbers[0]));
        return hn::IfThenElse(hn::Eq(axis, hn::Set(d, 2.0f)), hn::Set(d, numbers[2]), xy);
    }

    // The planes of one level as each cell sees them.
    template <int number>
    HWY_INLINE Level level(hn::VFromD<Indices> shape, Vector split) const {
        const TreeletLanes d;
        const Indices du;
        alignas(32) static constexpr std::uint32_t planes[treelet_levels][treelet_cells] = {
            {0, 0, 0, 0, 0, 0, 0, 0}, {1, 1, 1, 1, 2, 2, 2, 2}, {3, 3, 4, 4, 5, 5, 6, 6}};
        alignas(32) static constexpr std::uint32_t shifts[treelet_levels][treelet_cells] = {
            {0, 0, 0, 0, 0, 0, 0, 0}, {2, 2, 2, 2, 4, 4, 4, 4}, {6, 6, 8, 8, 10, 10, 12, 12}};
        alignas(32) static constexpr std::uint32_t above[treelet_levels][treelet_cells] = {
            {0, 0, 0, 0, 4, 4, 4, 4}, {0, 0, 4, 4, 0, 0, 4, 4}, {0, 4, 0, 4, 0, 4, 0, 4}};
        const auto axis = hn::And(hn::Shr(shape, hn::Load(du, shifts[number])), hn::Set(du, 3));
        const auto side = hn::IndicesFromVec(d, hn::Or(axis, hn::Load(du, above[number])));
        const auto plane = hn::TableLookupLanes(split, hn::IndicesFromVec(d, hn::Load(du, planes[number])));
        return {
            hn::MulSub(plane, hn::TableLookupLanes(entry_inverse_, side), hn::TableLookupLanes(entry_offset_, side)),
            hn::MulSub(plane, hn::TableLookupLanes(exit_inverse_, side), hn::TableLookupLanes(exit_offset_, side))};
    }

    // By axis, for cells below a plane and for those above: what entering or leaving through it makes of a plane; nothing that bounds where
    // the cell is not entered or left through it.
    Vector entry_inverse_;
    Vector entry_offset_;
    Vector exit_inverse_;
    Vector exit_offset_;
};

#else

// Plane by plane, where registers hold fewer than eight.
class TreeletTest {
public:
    HWY_INLINE explicit TreeletTest(const KdAxes& axes) : axes_(axes) {}

    HWY_INLINE std::uint32_t operator()(const KdTreelet& treelet, KdInterval part, KdCells& cells) const {
        std::uint32_t bits = 0;
        visit(treelet, 0, part, cells, bits);
        return bits & treelet.present();
    }

private:
    void visit(const KdTreelet& treelet, std::uint32_t place, KdInterval part, KdCells& cells,
               std::uint32_t& bits) const {
        if (!part.is_possible()) return;
        if (place >= treelet_planes) {
            const std::uint32_t cell = place - treelet_planes;
            cells.near[cell] = part.near;
            cells.far[cell] = part.far;
            bits |= 1u << cell;
            return;
        }
        const auto axis = static_cast<std::size_t>(treelet.axis(place));
        const float t = treelet.split[place] * axes_.inverse[axis];
        const std::uint32_t first = 2 * place + 1 + (std::signbit(axes_.inverse[axis]) ? 1u : 0u);
        const std::uint32_t second = 4 * place + 3 - first;
        visit(treelet, first, {part.near, std::min(part.far, t - axes_.exit_offset[axis])}, cells, bits);
        visit(treelet, second, {std::max(part.near, t - axes_.entry_offset[axis]), part.far}, cells, bits);
    }

    const KdAxes axes_;
};

#endif

// A ray on its way: what culls, and what decides, which is made when the first leaf is met. T: of the tree's triangles.
template <class T, class AnyRay, class Collector>
struct TracedKdRay {
    using Coordinate = T;

    const KdTreelets& tree;
    const AnyRay& ray; // the caller's
    const RayTime& time;
    Collector& collector;
    float last; // behind which no hit is of use any more
    std::optional<ExactRay> exact{};

    // Hands the hits with a leaf's triangles to the collector. Returns whether it wants no more. A function of its own, so that what a ray
    // needs for triangles does not take registers from what it needs for planes.
    HWY_NOINLINE bool test_leaf(KdLink link) {
        const std::byte* const leaf = tree.leaves.data() + link.offset();
        KdLeafHead head;
        std::memcpy(&head, leaf, sizeof head);
        if (!exact) exact.emplace(widened(ray), time.length);
        const double limit = collector.limit();
        const double distance = static_cast<double>(head.distance) + time.origin_distance;
        if (HWY_UNLIKELY(head.count > triangle_block_size)) {
            if (test_large_leaf(leaf + sizeof head, head.count, distance)) return true;
        } else if (test_block(leaf + sizeof head, head.count, distance)) {
            return true;
        }
        if (collector.limit() < limit) last = time.last(collector.limit()) + tree.hit_error;
        return false;
    }

    HWY_INLINE bool test_block(const std::byte* block, std::uint32_t n, double distance) {
        return test_triangle_block(BlockRay(*exact), TriangleBlock<T>(block, n), distance, collector);
    }

    // Not in test_leaf: for a loop a BlockRay would have to lie in memory.
    HWY_NOINLINE bool test_large_leaf(const std::byte* blocks, std::uint32_t count, double distance) {
        for (std::uint32_t begin = 0; begin < count; begin += triangle_block_size) {
            const std::uint32_t n = std::min(triangle_block_size, count - begin);
            if (test_block(blocks + TriangleBlock<T>::bytes_per_triangle * begin, n, distance)) return true;
        }
        return false;
    }
};

struct KdWaiting {
    KdLink link;
    KdInterval part;
};

HWY_INLINE void prefetch_cell(const KdTreelets& tree, KdLink link) {
    if (link.is_leaf()) {
        const std::byte* const leaf = tree.leaves.data() + link.offset();
        for (std::size_t line = 0; line < 4 * 64; line += 64) __builtin_prefetch(leaf + line);
    } else {
        __builtin_prefetch(tree.treelets.data() + link.index());
    }
}

template <class Traced>
HWY_INLINE void walk_kd_tree(Traced& traced, const KdAxes& axes, KdInterval part) {
    constexpr bool in_order = std::remove_reference_t<decltype(traced.collector)>::wants_nearest_first;
    const KdTreelets& tree = traced.tree;
    const TreeletTest treelet_test(axes);

    // Each treelet leaves at most seven behind, and may end after its first plane.
    KdWaiting stack[(treelet_cells - 1) * most_kd_levels + 1];
    KdWaiting* top = stack;
    KdLink current = KdLink::treelet(0);
    for (;;) {
        if (HWY_LIKELY(!current.is_leaf())) {
            const KdTreelet& treelet = tree.treelets.data()[current.index()];
            KdCells cells;
            std::uint32_t bits = treelet_test(treelet, part, cells);
            if (HWY_LIKELY(bits != 0)) {
                std::uint32_t next = static_cast<std::uint32_t>(__builtin_ctz(bits));
                bits &= bits - 1;
                if (bits != 0) {
                    // The nearest is next; the others wait, the farthest at the bottom.
                    KdWaiting* const bottom = top;
                    do {
                        std::uint32_t other = static_cast<std::uint32_t>(__builtin_ctz(bits));
                        bits &= bits - 1;
                        if (in_order && cells.near[other] < cells.near[next]) std::swap(other, next);
                        KdWaiting* place = top++;
                        if (in_order) {
                            for (; place > bottom && place[-1].part.near < cells.near[other]; --place)
                                *place = place[-1];
                        }
                        *place = {treelet.cell[other], {cells.near[other], cells.far[other]}};
                        prefetch_cell(tree, treelet.cell[other]);
                    } while (bits != 0);
                }
                current = treelet.cell[next];
                part = {cells.near[next], cells.far[next]};
                continue;
            }
        } else if (traced.test_leaf(current)) {
            return;
        }
        // What waits may lie beyond a hit found since.
        do {
            if (top == stack) return;
            --top;
            part = {top->part.near, std::min(top->part.far, traced.last)};
        } while (in_order && !part.is_possible());
        current = top->link;
    }
}

template <class T, class AnyRay, class Collector>
HWY_INLINE void trace_kd_tree(const KdTreelets& tree, const AnyRay& ray, Collector& collector) {
    TraversalRay traversal;
    RayTime time;
    if (HWY_UNLIKELY(set_up_ray(ray, tree.frame, traversal, time) != RaySetup::ready)) return;
    const KdAxes axes(traversal, tree.hit_error);
    const float last = traversal.last + tree.hit_error;
    const KdInterval part = axes.within(tree.bounds, {traversal.first, last});
    if (!part.is_possible()) return;
    TracedKdRay<T, AnyRay, Collector> traced{tree, ray, time, collector, last};
    walk_kd_tree(traced, axes, part);
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
