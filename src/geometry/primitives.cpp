#include "geometry/primitives.h"

#include "base/error.h"
#include "geometry/exact.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>
#include <utility>

namespace raywise {
namespace {

// (b - a) x (c - a) times a power of two; zero exactly when the corners lie in one line. Where the plain cross product would be
// mostly rounding each component is computed exactly.
Vec3 scaled_normal(const Corners& c) {
    Vec3 e = c[1] - c[0];
    Vec3 f = c[2] - c[0];
    const double size = max_component(larger(magnitudes(e), magnitudes(f)));
    if (size == 0.0) return Vec3(0.0);
    Vec3 n = glm::cross(e, f);
    // Its rounding is below 2^-50 of size^2, as long as the squares are normal numbers.
    if (size > 0x1p-300 && size < 0x1p300 && max_component(magnitudes(n)) > 0x1p-30 * size * size) return n;

    return exact_normal(c[0], c[1], c[2]);
}

bool has_area(const Corners& corners) { return scaled_normal(corners) != Vec3(0.0); }

// Fewer than this are not worth another thread.
constexpr std::uint64_t triangles_per_task = 32768;

// Returns the triangles that cannot be hit, and extends the reach by the others.
std::vector<std::uint32_t> find_unhittable(const TriangleMesh& mesh, const Parallel& parallel, Reach& reach) {
    std::vector<std::uint32_t> unhittable;
    std::mutex mutex;
    const auto settle = [&](std::uint64_t begin, std::uint64_t end) {
        std::vector<std::uint32_t> doubtful;
        Reach here;
        check_areas(mesh, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), here, doubtful);
        const auto is_hittable = [&](std::uint32_t i) {
            if (!mesh.is_valid(i)) return false;
            const Corners c = mesh.corners(i);
            if (!has_area(c)) return false;
            Box box;
            for (const Vec3& p : c) box.extend(p);
            here.extend({box, max_component(box.size())});
            return true;
        };
        doubtful.erase(std::remove_if(doubtful.begin(), doubtful.end(), is_hittable), doubtful.end());
        const std::lock_guard lock(mutex);
        reach.extend(here);
        unhittable.insert(unhittable.end(), doubtful.begin(), doubtful.end());
    };
    if (mesh.triangle_count() <= triangles_per_task) {
        settle(0, mesh.triangle_count());
    } else {
        parallel.for_blocks(mesh.triangle_count(), triangles_per_task, settle);
    }
    return unhittable;
}

} // namespace

const std::vector<bool> Primitives::not_settled;

Primitives::Primitives(std::vector<std::shared_ptr<const TriangleMesh>> meshes, const Parallel& parallel,
                       AreasAre areas)
    : meshes_(std::move(meshes)) {
    std::uint64_t total = 0;
    bool all_usable = true;
    first_.reserve(meshes_.size());
    for (const auto& mesh : meshes_) {
        if (total + mesh->triangle_count() >= PrimitiveHit::no_primitive) {
            throw Error(Status::ERROR_TOO_MANY, "the scene's meshes together have more than 4294967294 triangles");
        }
        first_.push_back(static_cast<std::uint32_t>(total));
        total += mesh->triangle_count();
        invalid_count_ += mesh->invalid_count();
        all_usable = all_usable && (mesh->triangle_count() == 0 || !mesh->vertex_bounds().empty());
    }
    count_ = static_cast<std::uint32_t>(total);
    if (areas == AreasAre::settled_now || invalid_count_ > 0 || !all_usable) settle_areas(parallel);
}

// Who settles them at the same time as another does so for nothing: a lock held over the parallel loop might be waited for by a task of it.
const Areas& Primitives::settle_areas(const Parallel& parallel) const {
    if (are_areas_settled()) return settled_;
    Areas areas;
    std::vector<std::uint32_t> unhittable;
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
        for (const std::uint32_t i : find_unhittable(*meshes_[m], parallel, areas.reach))
            unhittable.push_back(first_[m] + i);
    }
    areas.degenerate_count = unhittable.size() - invalid_count_;
    if (!unhittable.empty()) {
        areas.unhittable.resize(count_, false);
        for (const std::uint32_t i : unhittable) areas.unhittable[i] = true;
    }
    std::call_once(settled_once_, [&] {
        settled_ = std::move(areas);
        unhittable_.store(unhittable.empty() ? nullptr : &settled_.unhittable, std::memory_order_release);
        areas_.store(&settled_, std::memory_order_release);
    });
    return settled_;
}

bool Primitives::is_hittable(const std::vector<bool>& unhittable, std::uint32_t primitive) const {
    if (&unhittable != &not_settled) return !unhittable[primitive];
    const PrimitiveId id = locate(primitive);
    const TriangleMesh& mesh = *meshes_[id.geometry];
    return mesh.is_valid(id.primitive) && has_area(mesh.corners(id.primitive));
}

std::uint64_t Primitives::hittable_count() const {
    return count_ - invalid_count_ - (are_areas_settled() ? degenerate_count() : 0);
}

Box Primitives::outer_bounds() const {
    if (are_areas_settled()) return bounds();
    Box box;
    for (const auto& mesh : meshes_) {
        if (mesh->triangle_count() > 0) box.extend(mesh->vertex_bounds());
    }
    return box;
}

Vec3 unit_normal(const Corners& corners) {
    Vec3 n = scaled_normal(corners);
    const double largest = max_component(magnitudes(n));
    if (largest == 0.0) return Vec3(0.0);
    // Scaled again where the squares of a sliver's normal would leave the range of float64, or lose digits.
    if (!(largest > 0x1p-480 && largest < 0x1p480)) {
        for (int axis = 0; axis < 3; ++axis) n[axis] = std::ldexp(n[axis], -std::ilogb(largest));
    }
    // Zeros lose their signs: those of the corners are not kept everywhere, and the same hit is to have the same bits.
    return n / std::sqrt(glm::dot(n, n)) + Vec3(0.0);
}

} // namespace raywise
