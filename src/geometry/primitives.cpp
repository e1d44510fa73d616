#include "geometry/primitives.h"

#include "base/error.h"
#include "geometry/area_check.h"
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

// Fewer than this are not worth another thread.
constexpr std::uint64_t triangles_per_task = 32768;

// Returns the triangles that cannot be hit, and extends the reach by the others.
PageVector<std::uint32_t> settle_areas(const TriangleMesh& mesh, const Parallel& parallel, Reach& reach) {
    PageVector<std::uint32_t> unhittable;
    std::mutex mutex;
    const auto settle = [&](std::uint64_t begin, std::uint64_t end) {
        PageVector<std::uint32_t> doubtful;
        Reach here;
        check_areas(mesh, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), here, doubtful);
        const auto has_area = [&](std::uint32_t i) {
            if (!mesh.is_valid(i)) return false;
            const Corners c = mesh.corners(i);
            if (scaled_normal(c) == Vec3(0.0)) return false;
            Box box;
            for (const Vec3& p : c) box.extend(p);
            here.extend({box, max_component(box.size())});
            return true;
        };
        doubtful.erase(std::remove_if(doubtful.begin(), doubtful.end(), has_area), doubtful.end());
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

Primitives::Primitives(std::vector<std::shared_ptr<const TriangleMesh>> meshes, const Parallel& parallel)
    : meshes_(std::move(meshes)) {
    std::uint64_t total = 0;
    first_.reserve(meshes_.size());
    for (const auto& mesh : meshes_) {
        if (total + mesh->triangle_count() >= PrimitiveHit::no_primitive) {
            throw Error(Status::ERROR_TOO_MANY, "the scene's meshes together have more than 4294967294 triangles");
        }
        first_.push_back(static_cast<std::uint32_t>(total));
        total += mesh->triangle_count();
    }
    count_ = static_cast<std::uint32_t>(total);

    PageVector<std::uint32_t> unhittable;
    Reach reach;
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
        const TriangleMesh& mesh = *meshes_[m];
        for (const std::uint32_t i : settle_areas(mesh, parallel, reach)) {
            unhittable.push_back(first_[m] + i);
            ++(mesh.is_valid(i) ? degenerate_count_ : invalid_count_);
        }
    }
    bounds_ = reach.bounds;
    largest_extent_ = reach.largest_extent;
    hittable_count_ = count_ - degenerate_count_ - invalid_count_;
    if (unhittable.empty()) return;
    unhittable_.resize(count_, false);
    for (const std::uint32_t i : unhittable) unhittable_[i] = true;
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
