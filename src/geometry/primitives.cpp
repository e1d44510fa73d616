#include "geometry/primitives.h"

#include "base/error.h"

#include <cmath>
#include <string>
#include <utility>

namespace raywise {
namespace {

// (b - a) x (c - a), scaled by powers of two; zero exactly when the corners lie in one line. Where the plain cross product
// would be mostly rounding each component is computed exactly: it is the determinant of an axis with the two edges.
Vec3 scaled_normal(const Corners& c) {
    Vec3 e = c[1] - c[0];
    Vec3 f = c[2] - c[0];
    const double largest = std::max(max_component(glm::abs(e)), max_component(glm::abs(f)));
    if (largest == 0.0) return Vec3(0.0);
    const int scale_exponent = std::ilogb(largest);
    for (int axis = 0; axis < 3; ++axis) {
        e[axis] = std::ldexp(e[axis], -scale_exponent);
        f[axis] = std::ldexp(f[axis], -scale_exponent);
    }
    Vec3 n = glm::cross(e, f);
    if (max_component(glm::abs(n)) > 0x1p-30) return n; // its rounding is below 2^-50
    const AxisScale scale{{scale_exponent, scale_exponent, scale_exponent}};
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 unit(0.0);
        unit[axis] = 1.0;
        n[axis] = exact_determinant(unit, c[0], c[1], c[2], scale);
    }
    return n;
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

Vec3 Primitives::normal(std::uint32_t primitive) const {
    Vec3 n = scaled_normal(corners(primitive));
    const double largest = max_component(glm::abs(n));
    if (largest == 0.0) return Vec3(0.0);
    // Scaled again, so that the squares of a sliver's normal do not underflow.
    for (int axis = 0; axis < 3; ++axis) n[axis] = std::ldexp(n[axis], -std::ilogb(largest));
    return n / std::sqrt(glm::dot(n, n));
}

} // namespace raywise
