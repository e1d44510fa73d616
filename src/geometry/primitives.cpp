#include "geometry/primitives.h"

#include "base/error.h"
#include "geometry/exact.h"

#include <algorithm>
#include <cmath>
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

} // namespace

Primitives::Primitives(std::vector<std::shared_ptr<const TriangleMesh>> meshes) : meshes_(std::move(meshes)) {
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

    std::vector<bool> unhittable(count_, false);
    for (std::size_t m = 0; m < meshes_.size(); ++m) {
        const TriangleMesh& mesh = *meshes_[m];
        for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
            if (!mesh.is_valid(i)) {
                ++invalid_count_;
                unhittable[first_[m] + i] = true;
                continue;
            }
            const Corners c = mesh.corners(i);
            if (scaled_normal(c) == Vec3(0.0)) {
                ++degenerate_count_;
                unhittable[first_[m] + i] = true;
                continue;
            }
            for (const Vec3& p : c) bounds_.extend(p);
        }
    }
    hittable_count_ = count_ - degenerate_count_ - invalid_count_;
    if (hittable_count_ != count_) unhittable_ = std::move(unhittable);
}

Vec3 unit_normal(const Corners& corners) {
    Vec3 n = scaled_normal(corners);
    const double largest = max_component(magnitudes(n));
    if (largest == 0.0) return Vec3(0.0);
    // Scaled again where the squares of a sliver's normal would leave the range of float64, or lose digits.
    if (!(largest > 0x1p-480 && largest < 0x1p480)) {
        for (int axis = 0; axis < 3; ++axis) n[axis] = std::ldexp(n[axis], -std::ilogb(largest));
    }
    return n / std::sqrt(glm::dot(n, n));
}

} // namespace raywise
