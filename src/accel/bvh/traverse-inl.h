// The traversal itself. For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
#if defined(RAYWISE_ACCEL_BVH_TRAVERSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_ACCEL_BVH_TRAVERSE_INL_H_
#undef RAYWISE_ACCEL_BVH_TRAVERSE_INL_H_
#else
#define RAYWISE_ACCEL_BVH_TRAVERSE_INL_H_
#endif

#include "accel/bvh/binary_tree.h"
#include "accel/bvh/node.h"
#include "accel/collectors.h"
#include "geometry/triangle_block-inl.h"
#include "ray/traversal_ray.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Eight lanes, in as many registers as that takes.
using BoxLanes = hn::CappedTag<float, wide_bvh_width>;
using BoxVector = hn::VFromD<BoxLanes>;
inline constexpr std::size_t box_lanes = hn::MaxLanes(BoxLanes());

// Whether a ray that enters at `entry` and leaves at `exit` may meet a box. See ray/traversal_ray.h.
template <class D, class V = hn::VFromD<D>>
HWY_INLINE auto may_meet(D d, V entry, V exit) {
    return hn::Le(entry, hn::MulAdd(hn::Abs(exit), hn::Set(d, TraversalRay::box_slack), exit));
}

// The boxes of a node against a ray: the slab test (Kay and Kajiya 1986).
class BoxTest {
public:
    HWY_INLINE explicit BoxTest(const TraversalRay& ray) : first_(hn::Set(BoxLanes(), ray.first)) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            inverse_[axis] = hn::Set(BoxLanes(), ray.inverse[axis]);
            entry_offset_[axis] = hn::Set(BoxLanes(), ray.entry_offset[axis]);
            exit_offset_[axis] = hn::Set(BoxLanes(), ray.exit_offset[axis]);
            entry_line_[axis] = (2 * axis + ((ray.octant >> axis) & 1u)) * line;
        }
    }

    // Which children may hold a hit up to `last`, as bits; where the ray enters each goes to `entries`.
    HWY_INLINE std::uint32_t operator()(const WideNode& node, float last, float* entries) const {
        const BoxLanes d;
        const char* const planes = reinterpret_cast<const char*>(node.planes);
        std::uint32_t bits = 0;
        for (std::size_t lane = 0; lane < wide_bvh_width; lane += box_lanes) {
            BoxVector entry = first_;
            BoxVector exit = hn::Set(d, last);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const BoxVector entry_plane = load(planes + entry_line_[axis], lane);
                const BoxVector exit_plane = load(planes + (entry_line_[axis] ^ line), lane);
                entry = hn::Max(entry, hn::MulSub(entry_plane, inverse_[axis], entry_offset_[axis]));
                exit = hn::Min(exit, hn::MulSub(exit_plane, inverse_[axis], exit_offset_[axis]));
            }
            hn::Store(entry, d, entries + lane);
            std::uint8_t bytes[8] = {};
            hn::StoreMaskBits(d, may_meet(d, entry, exit), bytes);
            bits |= std::uint32_t{bytes[0]} << lane;
        }
        return bits;
    }

private:
    static constexpr std::size_t line = wide_bvh_width * sizeof(float);

    static HWY_INLINE BoxVector load(const char* planes, std::size_t lane) {
        return hn::Load(BoxLanes(), reinterpret_cast<const float*>(planes) + lane);
    }

    BoxVector inverse_[3];
    BoxVector entry_offset_[3];
    BoxVector exit_offset_[3];
    BoxVector first_;
    std::size_t entry_line_[3]; // in bytes
};

HWY_INLINE std::uint32_t lowest_bit(std::uint32_t bits) { return static_cast<std::uint32_t>(__builtin_ctz(bits)); }

template <class T>
HWY_INLINE void prefetch(const WideBvh& bvh, NodeRef reference) {
    const std::size_t index = reference.index();
    const char* target = reinterpret_cast<const char*>(bvh.nodes.data() + index);
    std::size_t bytes = sizeof(WideNode);
    if (reference.is_leaf()) {
        target = reinterpret_cast<const char*>(bvh.blocks.data()) + TriangleBlock<T>::bytes_per_triangle * index;
        bytes = TriangleBlock<T>::bytes_per_triangle * triangle_block_size;
    }
    for (std::size_t line = 0; line < bytes; line += 64) __builtin_prefetch(target + line);
}

// A ray on its way through a tree: what culls, and what decides, which is empty until the first leaf is met. T: of the tree's triangles.
template <class T, class AnyRay, class Collector>
struct TracedRay {
    using Coordinate = T;

    const WideBvh& bvh;
    const AnyRay& ray; // the caller's
    TraversalRay& traversal;
    const RayTime& time;
    Collector& collector;
    std::optional<ExactRay>& exact;

    // Hands the hits with a leaf's triangles to the collector. Returns whether it wants no more. A function of its own, so that what a ray
    // needs for triangles does not take registers from what it needs for boxes.
    HWY_NOINLINE bool test_leaf(NodeRef leaf) {
        if (HWY_UNLIKELY(leaf.triangles() > triangle_block_size)) return test_large_leaf(leaf);
        if (!exact) exact.emplace(widened(ray), time.length);
        const double limit = collector.limit();
        const std::byte* const data =
            bvh.blocks.data() + TriangleBlock<T>::bytes_per_triangle * std::size_t{leaf.index()};
        const TriangleBlock<T> block(data, leaf.triangles());
        if (test_triangle_block(BlockRay(*exact), block, leaf.distance() + time.origin_distance, collector))
            return true;
        if (collector.limit() < limit) traversal.last = time.last(collector.limit());
        return false;
    }

    // Of triangles that no plane parts. Not in test_leaf: for a loop a BlockRay would have to lie in memory.
    HWY_NOINLINE bool test_large_leaf(NodeRef leaf) {
        for (std::uint32_t first = 0; first < leaf.triangles(); first += triangle_block_size) {
            if (test_leaf(leaf.part(first, std::min(triangle_block_size, leaf.triangles() - first)))) return true;
        }
        return false;
    }
};

struct StackEntry {
    NodeRef reference;
    float entry; // where the ray enters it
};

// Where a child is entered, and which it is, in one number that orders like the distance, as far as those are not negative.
HWY_INLINE std::uint64_t child_key(const float* entries, std::uint32_t i) {
    std::uint32_t bits;
    std::memcpy(&bits, entries + i, sizeof bits);
    return std::uint64_t{bits} << 32 | i;
}
HWY_INLINE void sort_pair(std::uint64_t& a, std::uint64_t& b) { // the larger first
    const std::uint64_t larger_key = a > b ? a : b;
    b = a > b ? b : a;
    a = larger_key;
}

// Tests what the ray may hit at or below `current`, until the collector wants no more. Returns whether it did.
template <class Traced>
HWY_INLINE bool traverse(Traced& traced, NodeRef current) {
    constexpr bool in_order = std::remove_reference_t<decltype(traced.collector)>::wants_nearest_first;
    const WideBvh& bvh = traced.bvh;
    const WideNode* const nodes = bvh.nodes.data();
    const BoxTest box_test(traced.traversal);

    // Each level leaves at most seven behind.
    StackEntry stack[(wide_bvh_width - 1) * bvh_max_depth + wide_bvh_width];
    StackEntry* top = stack;
    for (;;) {
        if (HWY_LIKELY(!current.is_leaf())) {
            const WideNode& node = nodes[current.index()];
            HWY_ALIGN float entries[wide_bvh_width];
            std::uint32_t bits = box_test(node, traced.traversal.last, entries);
            if (HWY_LIKELY(bits != 0)) {
                const std::uint32_t i = lowest_bit(bits);
                bits &= bits - 1;
                if (bits == 0) {
                    current = node.child[i];
                    continue;
                }
                const auto push = [&](std::uint32_t k) HWY_ATTR {
                    *top = {node.child[k], entries[k]};
                    prefetch<typename Traced::Coordinate>(bvh, top->reference);
                    ++top;
                };
                if constexpr (!in_order) {
                    do {
                        push(lowest_bit(bits));
                        bits &= bits - 1;
                    } while (bits != 0);
                    current = node.child[i];
                    continue;
                }
                // The nearest is next; the others wait, the farthest at the bottom.
                std::uint64_t keys[wide_bvh_width];
                keys[0] = child_key(entries, i);
                keys[1] = child_key(entries, lowest_bit(bits));
                bits &= bits - 1;
                sort_pair(keys[0], keys[1]);
                std::uint32_t count = 2;
                if (bits != 0) {
                    keys[2] = child_key(entries, lowest_bit(bits));
                    bits &= bits - 1;
                    sort_pair(keys[1], keys[2]);
                    sort_pair(keys[0], keys[1]);
                    count = 3;
                    for (; bits != 0; bits &= bits - 1, ++count) {
                        const std::uint64_t key = child_key(entries, lowest_bit(bits));
                        std::uint32_t slot = count;
                        for (; slot > 0 && keys[slot - 1] < key; --slot) keys[slot] = keys[slot - 1];
                        keys[slot] = key;
                    }
                }
                for (std::uint32_t k = 0; k + 1 < count; ++k) push(static_cast<std::uint32_t>(keys[k]));
                current = node.child[static_cast<std::uint32_t>(keys[count - 1])];
                continue;
            }
        } else if (traced.test_leaf(current)) {
            return true;
        }
        // What has been pushed may lie beyond a hit found since.
        const float last = traced.traversal.last;
        const float last_entry = last + TraversalRay::box_slack * std::fabs(last);
        do {
            if (top == stack) return false;
            --top;
        } while (in_order && top->entry > last_entry);
        current = top->reference;
    }
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
