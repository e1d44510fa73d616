// Many rays through the tree together: each node is come to once, with all rays that enter it, and one of its boxes after the other is
// tested against as many rays as a vector holds. No branch depends on a single ray, and a node is fetched once for all of them.
// Barringer and Akenine-Moeller 2014, "Dynamic Ray Stream Traversal", and Tsakok 2009, "Faster Incoherent Rays: Multi-BVH Ray Stream
// Tracing", are the sources of the idea; rays keep their own interval here, and groups that have become small go on one by one.
//
// For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
#if defined(RAYWISE_ACCEL_WIDE_STREAMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_ACCEL_WIDE_STREAMS_INL_H_
#undef RAYWISE_ACCEL_WIDE_STREAMS_INL_H_
#else
#define RAYWISE_ACCEL_WIDE_STREAMS_INL_H_
#endif

#include "accel/plain_ray-inl.h"
#include "accel/wide_bvh_kernels.h"
#include "accel/wide_traversal-inl.h"
#include "base/scratch.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Rays that all run in one octant, through one tree. Sink has
//     in_order              whether the nearest child comes first
//     is_done(i)            whether ray i needs nothing more
//     of_ray(i)             what takes the hits of ray i, as traverse() wants it; its last() is that of rays[i]
template <class Sink>
class Stream {
public:
    // rays: of all streams together, which the numbers below are places in. most: the most rays of one stream.
    Stream(const WideBvh& bvh, const PlainRay* rays, std::size_t most, Sink& sink, Scratch& scratch)
        : bvh_(bvh),
          rays_(rays),
          sink_(sink),
          list_room_(most + ray_lanes),
          waiting_room_(levels_of_room * most + ray_lanes),
          lists_(scratch.take<std::uint32_t>(wide_bvh_width * list_room_)),
          waiting_(scratch.take<std::uint32_t>(waiting_room_)) {}

    void run(const std::uint32_t* numbers, std::size_t count, std::uint32_t octant) {
        octant_ = octant;
        std::memcpy(waiting_, numbers, count * sizeof *numbers);
        groups_[0] = {WideReference::node(0), 0, static_cast<std::uint32_t>(count)};
        height_ = 1;
        while (height_ > 0) {
            const Group group = groups_[--height_];
            if (group.reference.is_leaf() || group.count < smallest_group || !divide(group)) put_off(group);
        }
        catch_up();
    }

private:
    // As many rays as a vector holds, but no more than two of the tree's own.
    using Rays = hn::CappedTag<float, 16>;
    using RayVector = hn::VFromD<Rays>;
    static constexpr std::size_t ray_lanes = hn::MaxLanes(Rays());

    // With fewer rays than this, what a node costs by itself is more than what they share.
    static constexpr std::uint32_t smallest_group = 4;

    // Rays wait in several groups, those that enter several children of a node. Where there is no room for more they go on alone.
    static constexpr std::size_t levels_of_room = 8;

    static constexpr std::size_t put_off_room = 64;
    struct PutOff {
        std::uint32_t ray;
        WideReference reference;
    };

    struct Group {
        WideReference reference;
        std::uint32_t begin; // in waiting_
        std::uint32_t count;
    };

    // What is left of a group is done ray by ray, but not at once: by then memory has been fetched for all of them.
    HWY_INLINE void put_off(const Group& group) {
        for (std::uint32_t k = 0; k < group.count; ++k) {
            put_off_[put_off_count_++] = {waiting_[group.begin + k], group.reference};
            if (put_off_count_ == put_off_room) catch_up();
        }
    }

    HWY_NOINLINE void catch_up() {
        for (std::size_t k = 0; k < put_off_count_; ++k) {
            const auto [i, reference] = put_off_[k];
            if (sink_.is_done(i)) continue;
            auto of_ray = sink_.of_ray(i);
            if (reference.is_leaf()) {
                visit_leaf(bvh_, rays_[i], reference, of_ray);
            } else {
                traverse(bvh_, rays_[i], reference, of_ray);
            }
        }
        put_off_count_ = 0;
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
        if (group.begin + total + ray_lanes > waiting_room_) return false;
        if (Sink::in_order && entered > 1) sort_farthest_first(node, rays_[waiting_[group.begin]], order, entered);

        std::uint32_t end = group.begin; // its own place is free now
        for (std::uint32_t k = 0; k < entered; ++k) {
            const std::uint32_t i = order[k];
            prefetch(bvh_, node.child[i]);
            std::memcpy(waiting_ + end, lists_ + i * list_room_, counts[i] * sizeof(std::uint32_t));
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
        while (children > 0 && is_absent(node, children - 1)) --children;

        for (std::uint32_t k = 0; k < group.count; k += ray_lanes) {
            const auto present = hn::FirstN(du, std::min<std::size_t>(group.count - k, ray_lanes));
            const auto numbers = hn::IfThenElseZero(present, hn::LoadU(du, waiting_ + group.begin + k));
            const auto offsets = hn::BitCast(di, hn::ShiftLeft<6>(numbers));
            static_assert(sizeof(PlainRay) == 1u << 6);
            const RayVector bound = hn::GatherOffset(d, &rays_[0].bound, offsets);
            RayVector inverse[3];
            RayVector entry_offset[3];
            RayVector exit_offset[3];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                inverse[axis] = hn::GatherOffset(d, rays_[0].inverse + axis, offsets);
                entry_offset[axis] = hn::GatherOffset(d, rays_[0].entry_offset + axis, offsets);
                exit_offset[axis] = plain_exit_offset(d, bound, inverse[axis], entry_offset[axis]);
            }
            const RayVector first = hn::GatherOffset(d, &rays_[0].first, offsets);
            const RayVector last = hn::GatherOffset(d, &rays_[0].last, offsets);
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
                const auto enters = hn::And(hn::Le(entry, exit), present_rays);
                std::uint32_t* const list = lists_ + i * list_room_ + counts[i];
                counts[i] +=
                    static_cast<std::uint32_t>(hn::CompressStore(numbers, hn::RebindMask(du, enters), du, list));
            }
        }
    }

    // By where one of the rays, standing for all, passes the corner of each box that is nearest along the octant.
    HWY_INLINE void sort_farthest_first(const WideNode& node, const PlainRay& ray, std::uint32_t* order,
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

    const WideBvh& bvh_;
    const PlainRay* const rays_;
    Sink& sink_;
    const std::size_t list_room_;
    const std::size_t waiting_room_;
    std::uint32_t* const lists_;   // one for each child, of a node at a time
    std::uint32_t* const waiting_; // the rays of all groups, those of the last group last
    Group groups_[(wide_bvh_width - 1) * bvh_max_depth + wide_bvh_width]; // each level leaves at most seven behind
    std::size_t height_ = 0;
    PutOff put_off_[put_off_room];
    std::size_t put_off_count_ = 0;
    std::uint32_t octant_ = 0;
};

// Many rays made ready for streams: those of each octant for one.
class StreamRays {
public:
    // on_odd(i): answers a ray that no stream can take.
    template <class OnOdd>
    StreamRays(const WideBvhScene& scene, const UnpreparedRays& rays, Scratch& scratch, const OnOdd& on_odd)
        : plain_(scratch.take<PlainRay>(rays.count)), places_(scratch.take<PlainRayPlace>(rays.count)) {
        const std::size_t count = rays.count;
        for (std::uint32_t*& numbers : numbers_) numbers = scratch.take<std::uint32_t>(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            const PlainRayStatus status = set_plain_ray(rays.rays[i], scene.bvh.frame, plain_[i], places_[i]);
            if (HWY_LIKELY(status == PlainRayStatus::plain)) {
                const std::size_t octant = plain_[i].octant;
                numbers_[octant][counts_[octant]++] = i;
            } else if (status == PlainRayStatus::odd) {
                on_odd(i);
            }
        }
    }

    PlainRay& plain(std::size_t i) { return plain_[i]; }
    const PlainRayPlace& place(std::size_t i) const { return places_[i]; }

    template <class Sink>
    void trace(const WideBvh& bvh, Sink& sink, Scratch& scratch) const {
        const std::uint32_t most = *std::max_element(counts_, counts_ + octant_count);
        if (most == 0) return;
        Stream<Sink> stream(bvh, plain_, most, sink, scratch);
        for (std::uint32_t octant = 0; octant < octant_count; ++octant) {
            if (counts_[octant] > 0) stream.run(numbers_[octant], counts_[octant], octant);
        }
    }

private:
    static constexpr std::size_t octant_count = 8;

    PlainRay* const plain_;
    PlainRayPlace* const places_;
    std::uint32_t* numbers_[octant_count];
    std::uint32_t counts_[octant_count] = {};
};

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
