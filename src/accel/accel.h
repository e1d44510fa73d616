// What a structure must answer, and what it is built from.
#pragma once

#include "base/parallel.h"
#include "base/progress.h"
#include "base/scratch.h"
#include "base/structure.h"
#include "geometry/primitives.h"
#include "ray/query.h"
#include "ray/ray.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace raywise {

// Costs that steer builders, in nanoseconds; from the calibration profile. Only their ratios matter to a builder.
struct BuildCosts {
    double primitive_test_ns = 20.0; // one ray against one triangle
    double node_step_ns = 5.0;       // one step from node to node
};

// The point rays start at, or the direction they run along; see rw_view_options.
struct ViewFrame {
    enum class Kind {
        point,
        direction
    };
    Kind kind = Kind::point;
    Vec3 origin{0.0};
    Vec3 direction{0.0};     // zero for a point that looks all around
    double half_angle = 0.0; // radians, of a point with a direction
};

struct BuildInput {
    const Primitives& primitives; // outlives the structure
    BuildCosts costs;
    std::optional<ViewFrame> view; // for structures that are projected
    const Parallel& parallel;
    Progress&
        progress; // report() between larger steps and at least every 100,000 primitives: it is how builds are cancelled
    // So few rays will come that what is made ready for them would take longer than they do; see worth_gathering in
    // model/policy.h. A structure that can do without may then do so.
    bool few_rays = false;
    std::uint64_t memory_limit = 0;      // bytes, 0: none; for structures that can do with less
    std::optional<std::uint64_t> rays{}; // expected; empty: nobody knows
};

// Many rays, each with what narrows it down.
template <class AnyRay>
struct PacketOf {
    const AnyRay* rays;
    const Query* queries; // null: nothing narrows any of them down
    std::size_t count;

    Query query(std::size_t i) const { return queries != nullptr ? queries[i] : Query{}; }
};
using RayPacket = PacketOf<Ray>;
using RayPacketF = PacketOf<RayF>;

class Accel;

// What has come of the attempt to use a structure for geometry that has moved.
struct Refitted {
    std::unique_ptr<const Accel> accel; // none: build anew
    const char* obstacle = "";          // why there is none
    double cost = 1.0;                  // what a ray is taken to cost, over the same when the structure was built
};

// A built structure, and the one door to it: scenes, views, batches, probes and calibration all ask here. Immutable: any number of threads
// may ask at the same time.
//
// The answers are those of the linear scan, bit for bit: t in the caller's unit, and a ray that is not traceable hits nothing. A structure
// only decides which primitives to test (geometry/triangle_block-inl.h), and it may leave out a primitive only when no hit on it could
// change the answer.
class Accel {
public:
    virtual ~Accel() = default;

    // The first hit in the order of PrimitiveHit, or no hit.
    virtual PrimitiveHit closest(const Ray& ray, const Query& query) const = 0;
    virtual bool any(const Ray& ray, const Query& query) const = 0;
    // The same for a ray of float32, which is not worth being widened on the way for whoever widens it in registers.
    virtual PrimitiveHit closest_f32(const RayF& ray, const Query& query) const { return closest(widened(ray), query); }
    virtual bool any_f32(const RayF& ray, const Query& query) const { return any(widened(ray), query); }
    // Every hit once, appended in any order.
    virtual void all(const Ray& ray, const Query& query, std::vector<PrimitiveHit>& hits) const = 0;

    // How many rays the next four would like to get at a time, whatever their order; 1: none, for structures that gain more from rays
    // that follow near ones.
    virtual std::size_t rays_at_a_time() const { return 1; }
    // How many rays keep a thread busy for longer than waking it takes, where that is fewer than through a tree or a grid; 0: it is not.
    virtual std::size_t rays_worth_thread() const { return 0; }
    // The same for many rays at a time: answer i is that of ray i. scratch: for whatever memory it takes; not reset here.
    virtual void closest_many(const RayPacket& rays, PrimitiveHit* hits, Scratch& scratch) const;
    virtual void any_many(const RayPacket& rays, bool* found, Scratch& scratch) const;
    virtual void closest_many_f32(const RayPacketF& rays, PrimitiveHit* hits, Scratch& scratch) const;
    virtual void any_many_f32(const RayPacketF& rays, bool* found, Scratch& scratch) const;

    // Memory of the structure.
    virtual std::size_t bytes() const = 0;

    // The same structure around primitives that have moved: input.primitives have the numbers of those it was built from, of which
    // only is_hittable() is asked. most: the cost at which building anew pays; see Refitted::cost.
    virtual Refitted refitted(const BuildInput& input, double most) const {
        static_cast<void>(input);
        static_cast<void>(most);
        return {nullptr, "the structure cannot be refitted", 1.0};
    }
};

// Makes a structure from its name; the one place that knows all classes. Throws Error(ERROR_CANCELLED) when the caller
// stops it, std::bad_alloc when memory runs out.
std::unique_ptr<Accel> build(Structure structure, const BuildInput& input);

} // namespace raywise
