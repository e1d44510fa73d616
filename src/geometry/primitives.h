// All primitives of a scene under one numbering, and what a primitive answers: its box, its corners, and the ray test.
#pragma once

#include "base/box.h"
#include "base/page_array.h"
#include "base/parallel.h"
#include "geometry/area_check.h"
#include "geometry/triangle_mesh.h"
#include "geometry/triangle_test.h"
#include "ray/exact_ray.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace raywise {

// A hit inside the library. Primitives are numbered through all meshes in the order of adding, so the lowest number is
// the lowest (geometry, primitive) id.
struct PrimitiveHit {
    double t = std::numeric_limits<double>::infinity(); // in the caller's unit
    double u = 0.0;
    double v = 0.0;
    std::uint32_t primitive = no_primitive;

    static constexpr std::uint32_t no_primitive = 0xFFFFFFFFu;
    bool is_hit() const { return primitive != no_primitive; }

    // The order of answers: by t, then by number.
    bool operator<(const PrimitiveHit& other) const {
        return t < other.t || (t == other.t && primitive < other.primitive);
    }
};

struct PrimitiveId {
    std::uint32_t geometry;
    std::uint32_t primitive;
};

// (v1 - v0) x (v2 - v0), of unit length; zero where the corners lie in one line.
Vec3 unit_normal(const Corners& corners);

// Which primitives have area, and how far those reach.
struct Areas {
    PageVector<bool> unhittable; // empty when all can be hit
    Reach reach;                 // of those that can be
    std::uint64_t degenerate_count = 0;
};

// When a scene's areas are looked at, which takes as long as some rays of a linear scan, and which that does not need.
enum class AreasAre {
    settled_now,
    settled_on_demand // where every vertex can be used; else now
};

// Immutable. Any number of threads may ask at the same time, also what is settled on demand.
class Primitives {
public:
    // The meshes are kept. Throws Error(ERROR_TOO_MANY) when all of them together exceed the ids.
    explicit Primitives(std::vector<std::shared_ptr<const TriangleMesh>> meshes, const Parallel& parallel = Parallel(1),
                        AreasAre areas = AreasAre::settled_now);

    std::uint32_t count() const { return count_; } // all ids
    const std::vector<std::shared_ptr<const TriangleMesh>>& meshes() const { return meshes_; }
    std::uint64_t invalid_count() const { return invalid_count_; }
    bool is_float32() const { // the coordinates of all meshes
        return std::all_of(meshes_.begin(), meshes_.end(), [](const auto& mesh) { return mesh->is_float32(); });
    }

    // Settles the areas if they are not: for whoever asks much of what follows.
    const Areas& settle_areas(const Parallel& parallel) const;
    bool are_areas_settled() const { return areas_.load(std::memory_order_acquire) != nullptr; }

    // Each settles the areas.
    const Box& bounds() const { return areas().reach.bounds; }                  // of all hittable primitives
    double largest_extent() const { return areas().reach.largest_extent; }      // none of them is longer along any axis
    std::uint64_t degenerate_count() const { return areas().degenerate_count; } // without area

    // None settles them. How many primitives can be hit, for planning: as long as areas are not settled those without area are counted as
    // well. And a box around all that can be hit.
    std::uint64_t hittable_count() const;
    Box outer_bounds() const;

    // Whether a primitive can be hit at all: valid, and with corners that are not all in one line. Structures need not
    // contain the others (they may: the test never hits them).
    bool is_hittable(std::uint32_t primitive) const {
        const PageVector<bool>* const unhittable = unhittable_.load(std::memory_order_acquire);
        return unhittable == nullptr || is_hittable(*unhittable, primitive);
    }

    // Needs a valid primitive.
    Corners corners(std::uint32_t primitive) const {
        const PrimitiveId id = locate(primitive);
        return meshes_[id.geometry]->corners(id.primitive);
    }
    Box box(std::uint32_t primitive) const {
        const Corners c = corners(primitive);
        return {glm::min(c[0], glm::min(c[1], c[2])), glm::max(c[0], glm::max(c[1], c[2]))};
    }

    // Asks the caches for what corners() reads: its indices, and the vertices that they name, once they are there.
    [[gnu::always_inline]] void prefetch_indices(std::uint32_t primitive) const {
        const PrimitiveId id = locate(primitive);
        meshes_[id.geometry]->prefetch_indices(id.primitive);
    }
    [[gnu::always_inline]] void prefetch_vertices(std::uint32_t primitive) const {
        const PrimitiveId id = locate(primitive);
        meshes_[id.geometry]->prefetch_vertices(id.primitive);
    }

    PrimitiveId locate(std::uint32_t primitive) const {
        if (first_.size() == 1) return {0, primitive};
        const auto next = std::upper_bound(first_.begin(), first_.end(), primitive);
        const auto geometry = static_cast<std::uint32_t>(next - first_.begin() - 1);
        return {geometry, primitive - first_[geometry]};
    }

    std::uint32_t number(const PrimitiveId& id) const { return first_[id.geometry] + id.primitive; }

    // Whether the ray hits the primitive within [ray.tmin, ray.tmax]. The same hits as test_triangle_block, one at a time.
    bool test(const ExactRay& ray, std::uint32_t primitive, PrimitiveHit& hit) const {
        const PrimitiveId id = locate(primitive);
        const TriangleMesh& mesh = *meshes_[id.geometry];
        return mesh.is_valid(id.primitive) && test_corners(ray, mesh.corners(id.primitive), primitive, hit);
    }

    // The same with the corners at hand, which have to be those of a valid primitive.
    static bool test_corners(const ExactRay& ray, const Corners& c, std::uint32_t primitive, PrimitiveHit& hit) {
        TriangleHit found;
        if (!test_triangle(ray, c[0], c[1], c[2], found) || !ray.contains(found.t)) return false;
        hit = {found.t, found.u, found.v, primitive};
        return true;
    }

private:
    const Areas& areas() const {
        const Areas* const settled = areas_.load(std::memory_order_acquire);
        return settled != nullptr ? *settled : settle_areas(Parallel(1));
    }
    bool is_hittable(const PageVector<bool>& unhittable, std::uint32_t primitive) const;

    std::vector<std::shared_ptr<const TriangleMesh>> meshes_;
    std::vector<std::uint32_t> first_; // the number of each mesh's first triangle
    std::uint32_t count_ = 0;
    std::uint64_t invalid_count_ = 0;

    mutable std::once_flag settled_once_;
    mutable Areas settled_; // written once, then read through the following
    mutable std::atomic<const Areas*> areas_{nullptr};
    static const PageVector<bool> not_settled;
    mutable std::atomic<const PageVector<bool>*> unhittable_{&not_settled}; // null when all can be hit
};

} // namespace raywise
