// The walk itself. For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
#if defined(RAYWISE_ACCEL_WIDE_TRAVERSAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_ACCEL_WIDE_TRAVERSAL_INL_H_
#undef RAYWISE_ACCEL_WIDE_TRAVERSAL_INL_H_
#else
#define RAYWISE_ACCEL_WIDE_TRAVERSAL_INL_H_
#endif

#include "accel/triangle_filter-inl.h"
#include "accel/wide_bvh_kernels.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Eight lanes, in as many registers as that takes.
using Lanes = hn::CappedTag<float, wide_bvh_width>;
using Vector = hn::VFromD<Lanes>;
inline constexpr std::size_t lane_count = hn::MaxLanes(Lanes());

template <class Mask>
HWY_INLINE std::uint32_t bits_of(Mask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Lanes(), mask, bytes);
    return bytes[0];
}

HWY_INLINE std::uint32_t lowest_bit(std::uint32_t bits) { return static_cast<std::uint32_t>(__builtin_ctz(bits)); }

// The boxes of a node against a ray.
class BoxTest {
public:
    HWY_INLINE explicit BoxTest(const FrameRay& ray) : first_(hn::Set(Lanes(), ray.first)) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            inverse_[axis] = hn::Set(Lanes(), ray.inverse[axis]);
            entry_offset_[axis] = hn::Set(Lanes(), ray.entry_offset[axis]);
            exit_offset_[axis] = hn::Set(Lanes(), ray.exit_offset[axis]);
            const auto backwards = static_cast<std::size_t>(ray.backwards[axis]);
            entry_line_[axis] = (3 * backwards + axis) * wide_bvh_width;
            exit_line_[axis] = (3 * (1 - backwards) + axis) * wide_bvh_width;
        }
    }

    // Which children may hold a hit up to `last`, as bits; where the ray enters each goes to `entries`.
    HWY_INLINE std::uint32_t operator()(const WideNode& node, float last, float* entries) const {
        const Lanes d;
        const float* const planes = &node.planes[0][0][0];
        std::uint32_t bits = 0;
        for (std::size_t lane = 0; lane < wide_bvh_width; lane += lane_count) {
            Vector entry = first_;
            Vector exit = hn::Set(d, last);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const Vector entry_plane = hn::Load(d, planes + entry_line_[axis] + lane);
                const Vector exit_plane = hn::Load(d, planes + exit_line_[axis] + lane);
                entry = hn::Max(entry, hn::MulSub(entry_plane, inverse_[axis], entry_offset_[axis]));
                exit = hn::Min(exit, hn::MulSub(exit_plane, inverse_[axis], exit_offset_[axis]));
            }
            hn::Store(entry, d, entries + lane);
            bits |= bits_of(hn::Le(entry, exit)) << lane;
        }
        return bits;
    }

private:
    Vector inverse_[3];
    Vector entry_offset_[3];
    Vector exit_offset_[3];
    Vector first_;
    std::size_t entry_line_[3];
    std::size_t exit_line_[3];
};

// The triangles of a block against a ray.
class BlockTest {
public:
    HWY_INLINE explicit BlockTest(const FrameRay& ray)
        : filter_(Lanes(), ray),
          first_(hn::Set(Lanes(), ray.first)),
          axes_{static_cast<std::size_t>(ray.x_axis), static_cast<std::size_t>(ray.y_axis),
                static_cast<std::size_t>(ray.z_axis)} {}

    // Which of n triangles may be hit up to `last`, as bits.
    HWY_INLINE std::uint32_t operator()(const BlockWord* block, std::size_t n, float last) const {
        const Lanes d;
        std::uint32_t bits = 0;
        for (std::size_t lane = 0; lane < n; lane += lane_count) {
            const BlockWord* const lines = block + lane;
            const auto a = corner(lines, n);
            const auto b = corner(lines + 3 * n, n);
            const auto c = corner(lines + 6 * n, n);
            bits |= bits_of(may_hit(d, filter_, a, b, c, first_, hn::Set(d, last))) << lane;
        }
        return bits & ((1u << n) - 1u);
    }

private:
    HWY_INLINE ShearedCorners<Vector> corner(const BlockWord* lines, std::size_t n) const {
        const Lanes d;
        return shear(filter_, hn::LoadU(d, &lines[axes_[0] * n].coordinate),
                     hn::LoadU(d, &lines[axes_[1] * n].coordinate), hn::LoadU(d, &lines[axes_[2] * n].coordinate));
    }

    FilterRay<Lanes> filter_;
    Vector first_;
    std::size_t axes_[3];
};

struct StackEntry {
    float entry; // where the ray enters it
    std::uint32_t child;
    std::uint32_t triangles;
};

HWY_INLINE void prefetch(const WideBvh& bvh, std::uint32_t child, std::uint32_t triangles) {
    if (triangles == 0) {
        const char* const node = reinterpret_cast<const char*>(&bvh.nodes[child]);
        for (std::size_t line = 0; line < sizeof(WideNode); line += 64) __builtin_prefetch(node + line);
    } else {
        const char* const block = reinterpret_cast<const char*>(&bvh.words[words_per_triangle * child]);
        for (std::size_t line = 0; line < 256; line += 64) __builtin_prefetch(block + line);
    }
}

// Calls sink.test(corners, primitive) for what the ray may hit up to sink.last(), until it returns true. Returns whether it did.
template <class Sink>
HWY_INLINE bool traverse(const WideBvhQuery& query, const FrameRay& ray, Sink& sink) {
    const WideBvh& bvh = query.bvh;
    if (bvh.nodes.empty()) return false;
    const BoxTest box_test(ray);
    const BlockTest block_test(ray);

    // Each level leaves at most seven behind.
    StackEntry stack[(wide_bvh_width - 1) * bvh_max_depth + wide_bvh_width];
    std::size_t height = 0;
    StackEntry current{0.0f, 0, 0};
    for (;;) {
        if (current.triangles == 0) {
            const WideNode& node = bvh.nodes[current.child];
            HWY_ALIGN float entries[wide_bvh_width];
            std::uint32_t bits = box_test(node, sink.last(), entries);
            if (bits != 0) {
                const std::size_t base = height;
                do {
                    const std::uint32_t i = lowest_bit(bits);
                    bits &= bits - 1;
                    const StackEntry pushed{entries[i], node.child[i], node.triangles[i]};
                    prefetch(bvh, pushed.child, pushed.triangles);
                    std::size_t place = height++;
                    if (Sink::in_order) {
                        for (; place > base && stack[place - 1].entry < pushed.entry; --place)
                            stack[place] = stack[place - 1];
                    }
                    stack[place] = pushed;
                } while (bits != 0);
                current = stack[--height];
                continue;
            }
        } else {
            for (std::uint32_t begin = 0; begin < current.triangles; begin += block_size) {
                const std::uint32_t n = current.triangles - begin < block_size ? current.triangles - begin : block_size;
                const BlockWord* const block = &bvh.words[words_per_triangle * (std::size_t{current.child} + begin)];
                std::uint32_t bits = block_test(block, n, sink.last());
                for (; bits != 0; bits &= bits - 1) {
                    const std::uint32_t i = lowest_bit(bits);
                    const std::uint32_t primitive = block[9 * n + i].primitive;
                    const Corners corners =
                        bvh.exact ? Corners{block_corner(bvh, block, n, i, 0), block_corner(bvh, block, n, i, 1),
                                            block_corner(bvh, block, n, i, 2)}
                                  : query.primitives.corners(primitive);
                    if (sink.test(corners, primitive)) return true;
                }
            }
        }
        // What has been pushed may lie beyond a hit found since.
        do {
            if (height == 0) return false;
            current = stack[--height];
        } while (Sink::in_order && current.entry > sink.last());
    }
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
