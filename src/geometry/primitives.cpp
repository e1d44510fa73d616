#include "geometry/primitives.h"

#include "base/error.h"
#include "base/lanes.h"
#include "geometry/exact.h"

#include <algorithm>
#include <cmath>
#include <limits>
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
    const Vec3 largest = glm::max(glm::abs(e), glm::abs(f));
    const double size = max_component(largest);
    if (size == 0.0) return Vec3(0.0);
    Vec3 n = glm::cross(e, f);
    // Its rounding is below 2^-50 of size^2, as long as the squares are normal numbers.
    if (size > 0x1p-300 && size < 0x1p300 && max_component(glm::abs(n)) > 0x1p-30 * size * size) return n;

    return exact_normal(c[0], c[1], c[2]);
}

float largest(Lanes x) { return std::max(x[0], std::max(x[1], x[2])); }

Lanes lanes_of(const Vec3f& p) { return Lanes{p.x, p.y, p.z, 0.0f}; }
Vec3 vec3_of(Lanes x) { return Vec3(Vec3f(x[0], x[1], x[2])); }

// Whether float32 is enough to see that a triangle has an area: most have by far. The differences are right to 2^-24 of
// themselves, so the cross product is to less than 2^-20 of size^2, as long as all are normal numbers.
bool surely_has_area(Lanes a, Lanes b, Lanes c) {
    const Lanes e = b - a;
    const Lanes f = c - a;
    const Lanes none{};
    const Lanes abs_e = max_lanes(e, none - e);
    const Lanes abs_f = max_lanes(f, none - f);
    const Lanes n = __builtin_shufflevector(e, e, 1, 2, 0, 3) * __builtin_shufflevector(f, f, 2, 0, 1, 3) -
                    __builtin_shufflevector(e, e, 2, 0, 1, 3) * __builtin_shufflevector(f, f, 1, 2, 0, 3);
    const float size = largest(max_lanes(abs_e, abs_f));
    return size > 0x1p-40f && size < 0x1p40f && largest(max_lanes(n, none - n)) > 0x1p-18f * size * size;
}

// What a run of triangles of one mesh adds up to.
struct Survey {
    Box bounds;
    std::uint64_t degenerate = 0;
    std::uint64_t invalid = 0;
    std::vector<std::uint32_t> unhittable; // of the mesh's triangles
};

Survey survey(const TriangleMesh& mesh, std::uint32_t begin, std::uint32_t end) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Survey result;
    Lanes lower = fill_lanes(infinity);
    Lanes upper = fill_lanes(-infinity);
    const bool is_float32 = mesh.is_float32();
    for (std::uint32_t i = begin; i < end; ++i) {
        if (!mesh.is_valid(i)) {
            ++result.invalid;
            result.unhittable.push_back(i);
            continue;
        }
        if (is_float32) {
            const CornersF corners = mesh.corners_float32(i);
            const Lanes a = lanes_of(corners[0]);
            const Lanes b = lanes_of(corners[1]);
            const Lanes c = lanes_of(corners[2]);
            if (surely_has_area(a, b, c)) {
                lower = min_lanes(min_lanes(a, b), min_lanes(c, lower));
                upper = max_lanes(max_lanes(a, b), max_lanes(c, upper));
                continue;
            }
        }
        const Corners c = mesh.corners(i);
        if (scaled_normal(c) == Vec3(0.0)) {
            ++result.degenerate;
            result.unhittable.push_back(i);
            continue;
        }
        for (const Vec3& p : c) result.bounds.extend(p);
    }
    result.bounds.extend(Box{vec3_of(lower), vec3_of(upper)});
    return result;
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

    for (std::size_t m = 0; m < meshes_.size(); ++m) {
        const TriangleMesh& mesh = *meshes_[m];
        std::mutex mutex;
        parallel.for_blocks(mesh.triangle_count(), 16384, [&](std::uint64_t begin, std::uint64_t end) {
            const Survey part = survey(mesh, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end));
            const std::lock_guard lock(mutex);
            bounds_.extend(part.bounds);
            degenerate_count_ += part.degenerate;
            invalid_count_ += part.invalid;
            if (part.unhittable.empty()) return;
            unhittable_.resize(count_, false);
            for (const std::uint32_t i : part.unhittable) unhittable_[first_[m] + i] = true;
        });
    }
    hittable_count_ = count_ - degenerate_count_ - invalid_count_;
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
