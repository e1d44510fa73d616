// The walk itself. For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
#if defined(RAYWISE_ACCEL_WIDE_TRAVERSAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_ACCEL_WIDE_TRAVERSAL_INL_H_
#undef RAYWISE_ACCEL_WIDE_TRAVERSAL_INL_H_
#else
#define RAYWISE_ACCEL_WIDE_TRAVERSAL_INL_H_
#endif

#include "accel/frame_ray.h"
#include "accel/plain_ray.h"
#include "accel/triangle_filter-inl.h"
#include "accel/wide_bvh_kernels.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <utility>

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

// See PlainRay.
template <class D, class V = hn::VFromD<D>>
HWY_INLINE V plain_exit_offset(D d, V bound, V inverse, V entry_offset) {
    const V apart =
        hn::MulAdd(hn::Set(d, PlainRay::exit_per_inverse), hn::Abs(inverse), hn::Set(d, PlainRay::exit_constant));
    return hn::NegMulAdd(bound, apart, entry_offset);
}

// The boxes of a node against a ray.
class BoxTest {
public:
    HWY_INLINE explicit BoxTest(const FrameRay& ray)
        : BoxTest(ray.inverse, ray.entry_offset, ray.first, ray.backwards) {
        for (std::size_t axis = 0; axis < 3; ++axis) exit_offset_[axis] = hn::Set(Lanes(), ray.exit_offset[axis]);
    }
    HWY_INLINE explicit BoxTest(const PlainRay& ray) : BoxTest(ray.inverse, ray.entry_offset, ray.first, ray.octant) {
        const Vector bound = hn::Set(Lanes(), ray.bound);
        for (std::size_t axis = 0; axis < 3; ++axis)
            exit_offset_[axis] = plain_exit_offset(Lanes(), bound, inverse_[axis], entry_offset_[axis]);
    }

    // Which children may hold a hit up to `last`, as bits; where the ray enters each goes to `entries`.
    HWY_INLINE std::uint32_t operator()(const WideNode& node, float last, float* entries) const {
        const Lanes d;
        const char* const planes = reinterpret_cast<const char*>(node.planes);
        std::uint32_t bits = 0;
        for (std::size_t lane = 0; lane < wide_bvh_width; lane += lane_count) {
            Vector entry = first_;
            Vector exit = hn::Set(d, last);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const Vector entry_plane = load(planes + entry_line_[axis], lane);
                const Vector exit_plane = load(planes + (entry_line_[axis] ^ line), lane);
                entry = hn::Max(entry, hn::MulSub(entry_plane, inverse_[axis], entry_offset_[axis]));
                exit = hn::Min(exit, hn::MulSub(exit_plane, inverse_[axis], exit_offset_[axis]));
            }
            hn::Store(entry, d, entries + lane);
            bits |= bits_of(hn::Le(entry, exit)) << lane;
        }
        return bits;
    }

private:
    HWY_INLINE BoxTest(const float* inverse, const float* entry_offset, float first, std::uint32_t octant)
        : first_(hn::Set(Lanes(), first)) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            inverse_[axis] = hn::Set(Lanes(), inverse[axis]);
            entry_offset_[axis] = hn::Set(Lanes(), entry_offset[axis]);
            entry_line_[axis] = (2 * axis + ((octant >> axis) & 1u)) * line;
        }
    }

    static constexpr std::size_t line = wide_bvh_width * sizeof(float);

    static HWY_INLINE Vector load(const char* planes, std::size_t lane) {
        return hn::Load(Lanes(), reinterpret_cast<const float*>(planes) + lane);
    }

    Vector inverse_[3];
    Vector entry_offset_[3];
    Vector exit_offset_[3];
    Vector first_;
    std::size_t entry_line_[3]; // in bytes
};

// Of the triangles of a block: which may be hit, which are for certain, and about where (Findings).
struct BlockFindings {
    std::uint32_t possible; // bits
    std::uint32_t certain;
    alignas(64) float lower[wide_bvh_width]; // of those that may be hit
    alignas(64) float upper[wide_bvh_width];
};

// The triangles of a block against a ray.
class BlockTest {
public:
    HWY_INLINE BlockTest(const TriangleRay& ray, float first, float margin)
        : filter_(Lanes(), ray),
          first_(hn::Set(Lanes(), first)),
          margin_(hn::Set(Lanes(), margin)),
          axes_{static_cast<std::size_t>(ray.x_axis), static_cast<std::size_t>(ray.y_axis),
                static_cast<std::size_t>(ray.z_axis)} {}

    // Of n triangles, up to `last`.
    HWY_INLINE void operator()(const BlockWord* block, std::uint32_t n, float last, BlockFindings& found) const {
        const Lanes d;
        found.possible = 0;
        found.certain = 0;
        for (std::uint32_t lane = 0; lane < n; lane += lane_count) {
            const BlockWord* const lines = block + lane;
            const auto a = corner(lines, n);
            const auto b = corner(lines + 3 * n, n);
            const auto c = corner(lines + 6 * n, n);
            const auto edges = edges_of(d, filter_, a, b, c);
            const std::uint32_t present = ((1u << (n - lane)) - 1u) & ((1u << lane_count) - 1u);
            const std::uint32_t part = bits_of(may_hit(edges)) & present;
            if (part == 0) continue;
            const auto findings = find_within(d, filter_, edges, a, b, c, first_, hn::Set(d, last), margin_);
            found.possible |= (bits_of(findings.possible) & part) << lane;
            found.certain |= (bits_of(findings.certain) & part) << lane;
            hn::Store(findings.lower, d, found.lower + lane);
            hn::Store(findings.upper, d, found.upper + lane);
        }
    }

private:
    HWY_INLINE ShearedCorners<Vector> corner(const BlockWord* lines, std::size_t n) const {
        const Lanes d;
        return shear(filter_, hn::LoadU(d, &lines[axes_[0] * n].coordinate),
                     hn::LoadU(d, &lines[axes_[1] * n].coordinate), hn::LoadU(d, &lines[axes_[2] * n].coordinate));
    }

    FilterRay<Lanes> filter_;
    Vector first_;
    Vector margin_;
    std::size_t axes_[3];
};

struct StackEntry {
    WideReference reference;
    float entry; // where the ray enters it
};

HWY_INLINE void prefetch(const WideBvh& bvh, WideReference reference) {
    const void* const target = reference.is_leaf() ? static_cast<const void*>(bvh.block(reference.index()))
                                                   : static_cast<const void*>(&bvh.nodes[reference.index()]);
    for (std::size_t line = 0; line < sizeof(WideNode); line += 64)
        __builtin_prefetch(static_cast<const char*>(target) + line);
}

HWY_INLINE const TriangleRay& for_triangles(const FrameRay& ray) { return ray; }
HWY_INLINE TriangleRay for_triangles(const PlainRay& ray) { return ray.for_triangles(); }

// Calls sink.test for the triangles of a leaf that the ray may hit. Returns whether one of the calls did. A function of its own, so
// that what a ray needs for triangles does not take registers from what it needs for boxes.
template <class CullRay, class Sink>
HWY_NOINLINE bool visit_leaf(const WideBvh& bvh, const CullRay& ray, WideReference leaf, Sink& sink) {
    const BlockTest block_test(for_triangles(ray), ray.first_for_triangles(), ray.margin());
    BlockFindings found;
    const std::uint32_t triangles = leaf.triangles();
    for (std::uint32_t begin = 0; begin < triangles; begin += block_size) {
        const std::uint32_t n = triangles - begin < block_size ? triangles - begin : block_size;
        const BlockWord* const block = bvh.block(std::size_t{leaf.index()} + begin);
        block_test(block, n, sink.last(), found);
        for (std::uint32_t bits = found.possible; bits != 0; bits &= bits - 1) {
            const std::uint32_t i = lowest_bit(bits);
            if (sink.test({block, n, i}, (found.certain >> i & 1u) != 0, found.lower[i], found.upper[i])) return true;
        }
    }
    return false;
}

// Calls sink.test for what the ray may hit at or below `current` up to sink.last(), until it returns true. Returns whether it did.
template <class CullRay, class Sink>
HWY_INLINE bool traverse(const WideBvh& bvh, const CullRay& ray, WideReference current, Sink& sink) {
    const BoxTest box_test(ray);

    // Each level leaves at most seven behind.
    StackEntry stack[(wide_bvh_width - 1) * bvh_max_depth + wide_bvh_width];
    std::size_t height = 0;
    for (;;) {
        if (HWY_LIKELY(!current.is_leaf())) {
            const WideNode& node = bvh.nodes[current.index()];
            HWY_ALIGN float entries[wide_bvh_width];
            std::uint32_t bits = box_test(node, sink.last(), entries);
            if (bits != 0) {
                const std::uint32_t i = lowest_bit(bits);
                bits &= bits - 1;
                current = node.child[i];
                if (bits == 0) continue;

                // The nearest is next, the others wait, the farthest at the bottom.
                prefetch(bvh, current);
                float entry = entries[i];
                const std::size_t bottom = height;
                do {
                    const std::uint32_t k = lowest_bit(bits);
                    bits &= bits - 1;
                    StackEntry pushed{node.child[k], entries[k]};
                    prefetch(bvh, pushed.reference);
                    if (Sink::in_order) {
                        if (pushed.entry < entry) {
                            std::swap(pushed.reference, current);
                            std::swap(pushed.entry, entry);
                        }
                        std::size_t place = height;
                        for (; place > bottom && stack[place - 1].entry < pushed.entry; --place)
                            stack[place] = stack[place - 1];
                        stack[place] = pushed;
                    } else {
                        stack[height] = {current, entry};
                        current = pushed.reference;
                        entry = pushed.entry;
                    }
                    ++height;
                } while (bits != 0);
                continue;
            }
        } else if (visit_leaf(bvh, ray, current, sink)) {
            return true;
        }
        // What has been pushed may lie beyond a hit found since.
        do {
            if (height == 0) return false;
            --height;
        } while (Sink::in_order && stack[height].entry > sink.last());
        current = stack[height].reference;
    }
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
