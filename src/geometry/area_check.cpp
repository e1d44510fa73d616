#include "geometry/area_check.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/area_check.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "geometry/corner_lines-inl.h"

#include <algorithm>
#include <cmath>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

using Lanes = hn::CappedTag<float, corner_block>;
using Vector = hn::VFromD<Lanes>;
inline constexpr std::size_t lane_count = hn::MaxLanes(Lanes());

// So many triangles at a time stay in the first-level cache; and what has just been written in fours is not read at once, which would
// wait for it.
constexpr std::uint32_t tile = 256;

// The bounds of many points, lane by lane.
class LaneBounds {
public:
    HWY_INLINE LaneBounds() {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower_[axis] = hn::Set(Lanes(), std::numeric_limits<float>::infinity());
            upper_[axis] = hn::Set(Lanes(), -std::numeric_limits<float>::infinity());
        }
    }
    template <class Mask>
    HWY_INLINE void extend(const Vector* a, const Vector* b, const Vector* c, Mask which) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Vector low = hn::Min(lower_[axis], hn::Min(a[axis], hn::Min(b[axis], c[axis])));
            const Vector high = hn::Max(upper_[axis], hn::Max(a[axis], hn::Max(b[axis], c[axis])));
            lower_[axis] = hn::IfThenElse(which, low, lower_[axis]);
            upper_[axis] = hn::IfThenElse(which, high, upper_[axis]);
        }
    }
    HWY_INLINE Box box() const {
        Box box;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<glm::length_t>(axis);
            HWY_ALIGN float lower[lane_count];
            HWY_ALIGN float upper[lane_count];
            hn::Store(lower_[axis], Lanes(), lower);
            hn::Store(upper_[axis], Lanes(), upper);
            for (std::size_t i = 0; i < lane_count; ++i) {
                box.lower[a] = std::min(box.lower[a], static_cast<double>(lower[i]));
                box.upper[a] = std::max(box.upper[a], static_cast<double>(upper[i]));
            }
        }
        return box;
    }

private:
    Vector lower_[3];
    Vector upper_[3];
};

// The components of the normal are wrong by less than 2^-21 size^2, fused or not: each edge is rounded by 2^-24 of itself, and so are
// both products and the difference.
HWY_INLINE auto certainly_have_area(const Vector* a, const Vector* b, const Vector* c) {
    const Lanes d;
    Vector e[3];
    Vector f[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        e[axis] = hn::Sub(b[axis], a[axis]);
        f[axis] = hn::Sub(c[axis], a[axis]);
    }
    const auto largest = [](Vector x, Vector y, Vector z)
                             HWY_ATTR { return hn::Max(hn::Abs(x), hn::Max(hn::Abs(y), hn::Abs(z))); };
    const Vector size = hn::Max(largest(e[0], e[1], e[2]), largest(f[0], f[1], f[2]));
    const Vector normal =
        largest(hn::MulSub(e[1], f[2], hn::Mul(e[2], f[1])), hn::MulSub(e[2], f[0], hn::Mul(e[0], f[2])),
                hn::MulSub(e[0], f[1], hn::Mul(e[1], f[0])));
    // Within these bounds no product leaves the normal numbers by so much that it matters.
    const auto in_range = hn::And(hn::Gt(size, hn::Set(d, 0x1p-45f)), hn::Lt(size, hn::Set(d, 0x1p60f)));
    return hn::And(in_range, hn::Gt(normal, hn::Mul(hn::Mul(size, size), hn::Set(d, 0x1p-19f))));
}

void check_float32(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t end, Box& bounds,
                   std::vector<std::uint32_t>& doubtful) {
    const Lanes d;
    HWY_ALIGN float lines[tile / corner_block * corner_block_floats];
    LaneBounds lane_bounds;
    while (first < end) {
        const std::uint32_t count = std::min(tile, end - first);
        gather_mesh(mesh, first, first + count, {}, lines, 0);
        fill_lanes(lines, count, corner_blocks_for(count) * corner_block); // NaN: doubtful
        for (std::uint32_t i = 0; i < count; i += lane_count) {
            const float* const line = lane_of(lines, i);
            Vector corners[9];
            for (std::size_t k = 0; k < 9; ++k) corners[k] = hn::Load(d, line + k * corner_block);
            const auto certain = certainly_have_area(corners, corners + 3, corners + 6);
            lane_bounds.extend(corners, corners + 3, corners + 6, certain);
            if (HWY_LIKELY(hn::AllTrue(d, certain))) continue;
            std::uint8_t bits[8] = {};
            hn::StoreMaskBits(d, hn::Not(certain), bits);
            for (std::uint32_t k = 0; k < lane_count && i + k < count; ++k) {
                if ((bits[k / 8] >> (k % 8) & 1) != 0) doubtful.push_back(first + i + k);
            }
        }
        first += count;
    }
    bounds.extend(lane_bounds.box());
}

// The same in float64, for other layouts.
void check_float64(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t end, Box& bounds,
                   std::vector<std::uint32_t>& doubtful) {
    for (std::uint32_t i = first; i < end; ++i) {
        if (!mesh.is_valid(i)) {
            doubtful.push_back(i);
            continue;
        }
        const Corners c = mesh.corners(i);
        const Vec3 e = c[1] - c[0];
        const Vec3 f = c[2] - c[0];
        const double size = max_component(glm::max(glm::abs(e), glm::abs(f)));
        if (size > 0x1p-300 && size < 0x1p300 && max_component(glm::abs(glm::cross(e, f))) > 0x1p-30 * size * size) {
            for (const Vec3& p : c) bounds.extend(p);
        } else {
            doubtful.push_back(i);
        }
    }
}

void check_areas_kernel(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t end, Box& bounds,
                        std::vector<std::uint32_t>& doubtful) {
    if (reads_in_fours(mesh, {})) {
        check_float32(mesh, first, end, bounds, doubtful);
    } else {
        check_float64(mesh, first, end, bounds, doubtful);
    }
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(check_areas_kernel);

void check_areas(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t end, Box& bounds,
                 std::vector<std::uint32_t>& doubtful) {
    HWY_DYNAMIC_DISPATCH(check_areas_kernel)(mesh, first, end, bounds, doubtful);
}

} // namespace raywise
#endif
