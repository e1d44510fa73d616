// Many rays through the tree together: each node is come to once, with all rays that enter it, and one of its boxes after the other is
// tested against as many rays as a vector holds. No branch depends on a single ray, and a node is fetched once for all of them.
// Barringer and Akenine-Moeller 2014, "Dynamic Ray Stream Traversal", and Tsakok 2009, "Faster Incoherent Rays: Multi-BVH Ray Stream
// Tracing", are the sources of the idea; rays keep their own interval here, and groups that have become small go on one by one.
//
// For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
#if defined(RAYWISE_ACCEL_BVH_STREAM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_ACCEL_BVH_STREAM_INL_H_
#undef RAYWISE_ACCEL_BVH_STREAM_INL_H_
#else
#define RAYWISE_ACCEL_BVH_STREAM_INL_H_
#endif

#include "accel/accel.h"
#include "accel/bvh/traverse-inl.h"
#include "base/scratch.h"
#include "ray/traversal_ray-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <optional>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Many rays set up for traversal, and for the triangles of leaves, once they have met one: rays come to many leaves, one at a time.
template <class AnyRay>
struct StreamRays {
    const AnyRay* rays;
    TraversalRay* traversal;
    RayTime* times;
    std::optional<ExactRay>* exact;
};

// Rays that all run in one octant, through one tree.
template <class T, class AnyRay, class Collector>
class Stream {
public:
    // most: the most rays of one stream.
    Stream(const WideBvh& bvh, const StreamRays<AnyRay>& rays, Collector* collectors, std::size_t most,
           Scratch& scratch)
        : bvh_(bvh),
          rays_(rays),
          collectors_(collectors),
          list_capacity_(most + ray_lanes),
          waiting_capacity_(levels_of_capacity * most + ray_lanes),
          lists_(scratch.take<std::uint32_t>(wide_bvh_width * list_capacity_)),
          waiting_(scratch.take<std::uint32_t>(waiting_capacity_)) {}

    void run(const std::uint32_t* numbers, std::size_t count, std::uint32_t octant) {
        octant_ = octant;
        std::memcpy(waiting_, numbers, count * sizeof *numbers);
        groups_[0] = {NodeRef::node(0), 0, static_cast<std::uint32_t>(count)};
        height_ = 1;
        while (height_ > 0) {
            const Group group = groups_[--height_];
            if (group.reference.is_leaf() || group.count < smallest_group || !divide(group)) defer(group);
        }
        flush();
    }

private:
    // As many rays as a vector holds, but no more than two of the tree's own.
    using Rays = hn::CappedTag<float, 16>;
    using RayVector = hn::VFromD<Rays>;
    static constexpr std::size_t ray_lanes = hn::MaxLanes(Rays());

    // With fewer rays than this, what a node costs by itself is more than what they share.
    static constexpr std::uint32_t smallest_group = 4;

    // Rays wait in several groups, those that enter several children of a node. Where there is no room for more they go on alone.
    static constexpr std::size_t levels_of_capacity = 8;

    static constexpr std::size_t most_deferred = 64;
    struct Deferred {
        std::uint32_t ray;
        NodeRef reference;
    };

    struct Group {
        NodeRef reference;
        std::uint32_t begin; // in waiting_
        std::uint32_t count;
    };

    // What is left of a group is done ray by ray, but not at once: by then memory has been fetched for all of them.
    HWY_INLINE void defer(const Group& group) {
        for (std::uint32_t k = 0; k < group.count; ++k) {
            deferred_[deferred_count_++] = {waiting_[group.begin + k], group.reference};
            if (deferred_count_ == most_deferred) flush();
        }
    }

    HWY_NOINLINE void flush() {
        for (std::size_t k = 0; k < deferred_count_; ++k) {
            const auto [i, reference] = deferred_[k];
            if (is_done(collectors_[i])) continue;
            TracedRay<T, AnyRay, Collector> traced{bvh_,           rays_.rays[i],  rays_.traversal[i],
                                                   rays_.times[i], collectors_[i], rays_.exact[i]};
            const bool done = reference.is_leaf() ? traced.test_leaf(reference) : traverse(traced, reference);
            if (done) rays_.traversal[i].last = -std::numeric_limits<float>::max(); // it enters no box any more
        }
        deferred_count_ = 0;
    }

    // Puts a group's rays into groups for the children that they enter. Returns false, and changes nothing, where there is no room.
    HWY_INLINE bool divide(const Group& group) {
        const WideNode& node = bvh_.nodes[group.reference.index()];
        std::uint32_t counts[wide_bvh_width] = {};
        test_boxes(node, group, counts);

        std::uint32_t order[wide_bvh_width];
        std::uint32_t entered = 0;
        std::size_t total = 0;
        for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
            if (counts[i] == 0) continue;
            order[entered++] = i;
            total += counts[i];
        }
        if (group.begin + total + ray_lanes > waiting_capacity_) return false;
        if (Collector::wants_nearest_first && entered > 1)
            sort_farthest_first(node, rays_.traversal[waiting_[group.begin]], order, entered);

        std::uint32_t end = group.begin; // its own place is free now
        for (std::uint32_t k = 0; k < entered; ++k) {
            const std::uint32_t i = order[k];
            prefetch<T>(bvh_, node.child[i]);
            std::memcpy(waiting_ + end, lists_ + i * list_capacity_, counts[i] * sizeof(std::uint32_t));
            groups_[height_++] = {node.child[i], end, counts[i]};
            end += counts[i];
        }
        return true;
    }

    // Lists the rays that enter each child.
    HWY_INLINE void test_boxes(const WideNode& node, const Group& group, std::uint32_t* counts) {
        const Rays d;
        const hn::RebindToUnsigned<Rays> du;
        const hn::RebindToSigned<Rays> di;
        const float* entry_planes[3];
        const float* exit_planes[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t backwards = octant_ >> axis & 1u;
            entry_planes[axis] = node.planes[axis][backwards];
            exit_planes[axis] = node.planes[axis][backwards ^ 1u];
        }
        std::uint32_t children = wide_bvh_width;
        while (children > 0 && is_empty_child(node, children - 1)) --children;

        for (std::uint32_t k = 0; k < group.count; k += ray_lanes) {
            const auto present = hn::FirstN(du, std::min<std::size_t>(group.count - k, ray_lanes));
            const auto numbers = hn::IfThenElseZero(present, hn::LoadU(du, waiting_ + group.begin + k));
            const auto offsets = hn::BitCast(di, hn::ShiftLeft<6>(numbers));
            static_assert(sizeof(TraversalRay) == 1u << 6);
            const TraversalRay& first_ray = rays_.traversal[0];
            RayVector inverse[3];
            RayVector entry_offset[3];
            RayVector exit_offset[3];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                inverse[axis] = hn::GatherOffset(d, first_ray.inverse + axis, offsets);
                entry_offset[axis] = hn::GatherOffset(d, first_ray.entry_offset + axis, offsets);
                exit_offset[axis] = hn::GatherOffset(d, first_ray.exit_offset + axis, offsets);
            }
            const RayVector first = hn::GatherOffset(d, &first_ray.first, offsets);
            const RayVector last = hn::GatherOffset(d, &first_ray.last, offsets);
            const auto present_rays = hn::RebindMask(d, present);
            for (std::uint32_t i = 0; i < children; ++i) {
                RayVector entry = first;
                RayVector exit = last;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    entry = hn::Max(entry,
                                    hn::MulSub(hn::Set(d, entry_planes[axis][i]), inverse[axis], entry_offset[axis]));
                    exit =
                        hn::Min(exit, hn::MulSub(hn::Set(d, exit_planes[axis][i]), inverse[axis], exit_offset[axis]));
                }
                const auto enters = hn::And(may_meet(d, entry, exit), present_rays);
                std::uint32_t* const list = lists_ + i * list_capacity_ + counts[i];
                // Not CompressStore, which some processors take a hundred nanoseconds over: docs/decisions/0025.
                hn::StoreU(hn::Compress(numbers, hn::RebindMask(du, enters)), du, list);
                counts[i] += static_cast<std::uint32_t>(hn::CountTrue(d, enters));
            }
        }
    }

    // By where one of the rays, standing for all, passes the corner of each box that is nearest along the octant.
    HWY_INLINE void sort_farthest_first(const WideNode& node, const TraversalRay& ray, std::uint32_t* order,
                                        std::uint32_t n) const {
        float along[wide_bvh_width];
        for (std::uint32_t i = 0; i < wide_bvh_width; ++i) {
            along[i] = 0.0f;
            for (std::size_t axis = 0; axis < 3; ++axis)
                along[i] += node.planes[axis][octant_ >> axis & 1u][i] * ray.direction[axis];
        }
        for (std::uint32_t k = 1; k < n; ++k) {
            const std::uint32_t i = order[k];
            std::uint32_t place = k;
            for (; place > 0 && along[order[place - 1]] < along[i]; --place) order[place] = order[place - 1];
            order[place] = i;
        }
    }

    static bool is_done(const ClosestCollector&) { return false; }
    static bool is_done(const AnyCollector& collector) { return collector.found(); }

    const WideBvh& bvh_;
    const StreamRays<AnyRay>& rays_;
    Collector* const collectors_;
    const std::size_t list_capacity_;
    const std::size_t waiting_capacity_;
    std::uint32_t* const lists_;   // one for each child, of a node at a time
    std::uint32_t* const waiting_; // the rays of all groups, those of the last group last
    Group groups_[(wide_bvh_width - 1) * bvh_max_depth + wide_bvh_width]; // each level leaves at most seven behind
    std::size_t height_ = 0;
    Deferred deferred_[most_deferred];
    std::size_t deferred_count_ = 0;
    std::uint32_t octant_ = 0;
};

// All rays in streams, one for each octant. collectors: of each ray.
template <class T, class AnyRay, class Collector>
HWY_INLINE void trace_streams(const WideBvh& bvh, const PacketOf<AnyRay>& packet, Collector* collectors,
                              Scratch& scratch) {
    constexpr std::size_t octants = 8;
    const std::size_t count = packet.count;
    const StreamRays<AnyRay> rays{packet.rays, scratch.take<TraversalRay>(count), scratch.take<RayTime>(count),
                                  scratch.take<std::optional<ExactRay>>(count)};
    std::uint32_t* indices[octants];
    std::uint32_t counts[octants] = {};
    for (std::uint32_t*& list : indices) list = scratch.take<std::uint32_t>(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (set_up_ray(rays.rays[i], bvh.frame, rays.traversal[i], rays.times[i]) != RaySetup::ready) continue;
        new (rays.exact + i) std::optional<ExactRay>();
        const std::size_t octant = rays.traversal[i].octant;
        indices[octant][counts[octant]++] = i;
    }
    const std::uint32_t most = *std::max_element(counts, counts + octants);
    if (most == 0) return;
    Stream<T, AnyRay, Collector> stream(bvh, rays, collectors, most, scratch);
    for (std::uint32_t octant = 0; octant < octants; ++octant) {
        if (counts[octant] > 0) stream.run(indices[octant], counts[octant], octant);
    }
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
