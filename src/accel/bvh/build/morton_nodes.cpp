#include "accel/bvh/build/morton_nodes.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/bvh/build/morton_nodes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/bvh/write_leaf-inl.h"
#include "geometry/mesh_cursor.h"

#include <algorithm>
#include <cstdint>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

// Below this depth ranges are halved whatever their codes, so that none of at most 2^32 primitives needs more than eleven levels more: each
// divides by eight, down to leaves of eight.
constexpr int most_depth_of_codes = bvh_max_depth - 11;

// A range of so few triangles becomes a leaf where its node has no room left to divide it: two blocks take no longer than a node and what is
// left of its leaves. With leaves of at most 8 / 12 / 16 the dragon takes 44 / 41 / 39 ns per triangle, nodes take 15 / 10 / 8 bytes of it,
// and rays are as fast. AMD EPYC, 2026-12-01.
constexpr std::uint32_t largest_leaf = 16;
static_assert(largest_leaf <= MortonRanges::padding);

// Ranges of so few triangles are divided by number, in whole blocks: fuller blocks are fewer to write and to test, and their codes need not be
// searched. Of 0 / 16 / 32 triangles: 1 / 0.97 / 0.91 of the time to build and 1 / 0.98 / 0.97 of the speed of rays. Where the codes divide them but
// for the rounding to whole blocks, up to 16 / 32 / 64 / 128 triangles: 0.98 / 0.92 / 0.90 / 0.90 and 0.97 / 0.97 / 0.95 / 0.93. Where no range of at
// most 12 / 16 is divided at all: 0.94 / 0.90 and 0.93 / 0.91. Geometric means over meshes and soup, AMD EPYC, 2026-12-01.
constexpr std::uint32_t most_by_blocks = 32;

// Corners are asked for by so many triangles at a time. Without it the dragon takes 57 ns per triangle, with 128 / 512 / 1,024 / 2,048 it takes
// 53 / 49 / 45 / 46; what fits the second-level cache takes as long. AMD EPYC, 2026-12-01.
constexpr std::uint32_t prefetched = 1024;

HWY_INLINE bool is_leaf(const MortonRange& range) { return range.count() <= largest_leaf; }

// How many of the keys, in the order of codes, have codes below one.
#if HWY_TARGET == HWY_SCALAR
HWY_INLINE std::uint32_t count_below_in_vectors(const MortonKey* keys, std::uint32_t count, std::uint32_t code) {
    std::uint32_t below = 0;
    for (std::uint32_t i = 0; i < count; ++i) below += keys[i].code < code ? 1 : 0;
    return below;
}
constexpr std::uint32_t fewest_in_vectors = 0;
constexpr std::uint32_t most_in_vectors = 16;
#else
using KeyTag = hn::CappedTag<std::uint32_t, 16>; // of codes and indices
constexpr std::uint32_t fewest_in_vectors = static_cast<std::uint32_t>(hn::MaxLanes(KeyTag()) / 2);
constexpr std::uint32_t most_in_vectors = 4 * fewest_in_vectors;

// The last vector may begin before the end of the one in front: where codes rise, what counts is where the last one below lies.
HWY_INLINE std::uint32_t count_below_in_vectors(const MortonKey* keys, std::uint32_t count, std::uint32_t code) {
    const KeyTag d;
    const hn::Repartition<std::uint64_t, KeyTag> pairs;
    const auto limit = hn::Set(d, code);
    const auto indices = hn::BitCast(d, hn::Set(pairs, 0xFFFFFFFF00000000u)); // never below
    std::uint32_t below = 0;
    for (std::uint32_t i = 0; i < most_in_vectors; i += fewest_in_vectors) {
        const std::uint32_t first = std::min(i, count - fewest_in_vectors);
        const auto* const numbers = reinterpret_cast<const std::uint32_t*>(keys + first);
        const auto here = hn::CountTrue(d, hn::Lt(hn::Or(hn::LoadU(d, numbers), indices), limit));
        below = here == 0 ? below : first + static_cast<std::uint32_t>(here);
    }
    return below;
}
#endif

// Without a jump that depends on codes: it would be guessed wrong.
HWY_INLINE std::uint32_t count_below(const MortonKey* keys, std::uint32_t count, std::uint32_t code) {
    const MortonKey* key = keys;
    while (count > most_in_vectors) {
        const std::uint32_t half = count / 2;
        key += half & (0u - static_cast<std::uint32_t>(key[half - 1].code < code));
        count -= half;
    }
    return static_cast<std::uint32_t>(key - keys) + count_below_in_vectors(key, count, code);
}

class MortonNodes {
public:
    MortonNodes(MortonRanges& ranges, const Primitives& primitives, WideBvh& bvh)
        : ranges_(ranges), bvh_(bvh), cursor_(primitives) {}

    void make_top(MortonTop& top) {
        top.nodes.push_back(empty_node());
        make_top_node(top, 0, {ranges_.all(), 0});
    }

    void make_subtree(const MortonPart& root, PageVector<WideNode>& nodes) {
        nodes.reserve(root.range.count() / 24 + 1);
        make_node(nodes, root);
    }

private:
    struct Children {
        MortonRange ranges[wide_bvh_width];
        std::uint32_t count = 1;
    };
    // What a node says of a child.
    struct Child {
        NodeRef reference;
        Bounds box;
    };

    // By the highest digit in which codes differ, or in whole blocks where none does, or too few triangles are left, or below the depth for codes.
    HWY_INLINE std::pair<MortonRange, MortonRange> divide(const MortonRange& range, bool by_codes) {
        const MortonKey* const keys = ranges_.keys();
        const std::uint32_t last = keys[range.end - 1].code;
        const std::uint32_t differing = keys[range.begin].code ^ last;
        if (!by_codes || differing == 0 || range.count() <= most_by_blocks) {
            const std::uint32_t blocks = (range.count() + (triangle_block_size - 1)) / triangle_block_size;
            return ranges_.divide(range, range.begin + blocks / 2 * triangle_block_size);
        }
        const int digit = 31 - __builtin_clz(differing);
        const std::uint32_t below = count_below(keys + range.begin, range.count(), last >> digit << digit);
        return ranges_.divide(range, range.begin + below);
    }

    // What is largest in space is divided first.
    HWY_INLINE Children choose_children(const MortonPart& part) {
        const bool by_codes = part.depth < most_depth_of_codes;
        Children children;
        children.ranges[0] = part.range;
        std::uint64_t priorities[wide_bvh_width] = {priority(part.range, by_codes, 0)};
        while (children.count < wide_bvh_width) {
            const std::uint64_t highest = largest_of(priorities);
            if (highest == 0) break;
            const auto i = static_cast<std::uint32_t>(highest % wide_bvh_width);
            const std::uint32_t k = children.count++;
            std::tie(children.ranges[i], children.ranges[k]) = divide(children.ranges[i], by_codes);
            priorities[i] = priority(children.ranges[i], by_codes, i);
            priorities[k] = priority(children.ranges[k], by_codes, k);
        }
        return children;
    }

    // By level, then by number, in one number with the place as lowest digit: no jump depends on codes. Zero for what stays whole.
    HWY_INLINE static std::uint64_t priority(const MortonRange& range, bool by_codes, std::uint32_t place) {
        const std::uint64_t level = by_codes ? range.level : 0;
        return range.count() <= triangle_block_size ? 0 : (level << 32 | range.count()) * wide_bvh_width + place;
    }

    HWY_INLINE static std::uint64_t largest_of(const std::uint64_t (&x)[wide_bvh_width]) {
        const auto larger_of = [](std::uint64_t a, std::uint64_t b) HWY_ATTR { return a > b ? a : b; };
        return larger_of(larger_of(larger_of(x[0], x[1]), larger_of(x[2], x[3])),
                         larger_of(larger_of(x[4], x[5]), larger_of(x[6], x[7])));
    }

    void make_top_node(MortonTop& top, std::uint32_t index, const MortonPart& part) {
        const Children children = choose_children(part);
        for (std::uint32_t i = 0; i < children.count; ++i) {
            const MortonPart child{children.ranges[i], part.depth + 1};
            if (is_leaf(child.range)) {
                const Child leaf = make_leaf(child.range);
                top.nodes[index].child[i] = leaf.reference;
                set_box(top.nodes[index], i, leaf.box);
            } else if (child.range.count() <= subtree_size) {
                top.roots.push_back(child);
                top.subtrees.push_back({index, i, {}});
            } else {
                const auto next = static_cast<std::uint32_t>(top.nodes.size());
                top.nodes.push_back(empty_node());
                top.nodes[index].child[i] = NodeRef::node(next);
                make_top_node(top, next, child);
            }
        }
    }

    Child make_node(PageVector<WideNode>& nodes, const MortonPart& part) {
        const auto index = static_cast<std::uint32_t>(nodes.size());
        nodes.emplace_back();
        const Children children = choose_children(part);
        NodeRef references[wide_bvh_width];
        Bounds boxes[wide_bvh_width];
        Bounds all = Bounds::none();
        for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
            references[i] = NodeRef::node(0);
            boxes[i] = empty_box();
            if (i >= children.count) continue;
            const MortonRange& range = children.ranges[i];
            if (range.count() <= prefetched && part.range.count() > prefetched) prefetch_corners(range);
            const Child child = is_leaf(range) ? make_leaf(range) : make_node(nodes, {range, part.depth + 1});
            references[i] = child.reference;
            boxes[i] = child.box;
            all.extend(child.box);
        }
        set_boxes(nodes[index], boxes);
        std::copy(references, references + wide_bvh_width, nodes[index].child);
        return {NodeRef::node(index), all};
    }

    HWY_INLINE Child make_leaf(const MortonRange& range) {
        std::uint32_t primitives[largest_leaf]; // and others behind them
        const MortonKey* const keys = ranges_.keys() + range.begin;
        for (std::uint32_t i = 0; i < largest_leaf; ++i) primitives[i] = keys[i].index;
        const LeafWriter::Leaf leaf = write_leaf(bvh_, cursor_, range.begin, primitives, range.count());
        return {leaf.reference, leaf.box};
    }

    // Asks for the corners of what leaves will soon be written of: where those lie far from each other, that is what writing waits for.
    void prefetch_corners(const MortonRange& range) {
        const MortonKey* const keys = ranges_.keys();
        for (std::uint32_t begin = range.begin; begin < range.end;) {
            cursor_.move_to(keys[begin].index);
            const TriangleArrays& arrays = cursor_.mesh().arrays();
            const MeshCursor& cursor = cursor_;
            begin = with_indices(arrays.indices, [&](const auto& index) HWY_ATTR {
                std::uint32_t i = begin;
                for (; i < range.end && cursor.contains(keys[i].index); ++i) {
                    const std::uint32_t triangle = cursor.triangle(keys[i].index);
                    for (std::uint64_t corner = 0; corner < 3; ++corner) {
                        const auto vertex = static_cast<std::ptrdiff_t>(index(triangle, corner));
                        __builtin_prefetch(arrays.vertices.data + vertex * arrays.vertices.stride);
                    }
                }
                return i;
            });
        }
    }

    MortonRanges& ranges_;
    WideBvh& bvh_;
    MeshCursor cursor_;
};

void make_top_kernel(MortonRanges& ranges, const Primitives& primitives, WideBvh& bvh, MortonTop& top) {
    MortonNodes(ranges, primitives, bvh).make_top(top);
}

void make_subtree_kernel(MortonRanges& ranges, const Primitives& primitives, const MortonPart& root, WideBvh& bvh,
                         PageVector<WideNode>& nodes) {
    MortonNodes(ranges, primitives, bvh).make_subtree(root, nodes);
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(make_top_kernel);
HWY_EXPORT(make_subtree_kernel);

MortonTop make_morton_top(MortonRanges& ranges, const Primitives& primitives, WideBvh& bvh) {
    MortonTop top;
    HWY_DYNAMIC_DISPATCH(make_top_kernel)(ranges, primitives, bvh, top);
    return top;
}

void make_morton_subtree(MortonRanges& ranges, const Primitives& primitives, const MortonPart& root, WideBvh& bvh,
                         PageVector<WideNode>& nodes) {
    HWY_DYNAMIC_DISPATCH(make_subtree_kernel)(ranges, primitives, root, bvh, nodes);
}

} // namespace raywise
#endif
