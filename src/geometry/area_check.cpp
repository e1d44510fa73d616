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

// So many triangles at a time stay in the first-level cache; and what has just been written is not read at once, in wider registers,
// which would wait for it.
constexpr std::uint32_t tile = 256;

// A triangle certainly has area when its normal, made of the edges e and f, is above `thin` * size^2, with size the edges' largest
// component. Each edge is rounded by u of itself, and so are products and differences: a component of the normal is wrong by less
// than 8 u size^2, fused or not. Between smallest and largest no product that matters leaves the normal numbers.
template <class T>
struct Limits;
template <>
struct Limits<float> { // u = 2^-24
    static constexpr float thin = 0x1p-19f;
    static constexpr float smallest = 0x1p-45f;
    static constexpr float largest = 0x1p60f;
};
template <>
struct Limits<double> { // u = 2^-53
    static constexpr double thin = 0x1p-40;
    static constexpr double smallest = 0x1p-300;
    static constexpr double largest = 0x1p300;
};

template <class T>
class AreaCheck {
public:
    using Lanes = hn::CappedTag<T, corner_block>;
    using Vector = hn::VFromD<Lanes>;
    static constexpr std::size_t lane_count = hn::MaxLanes(Lanes());

    HWY_INLINE AreaCheck() {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower_[axis] = hn::Set(Lanes(), std::numeric_limits<T>::infinity());
            upper_[axis] = hn::Set(Lanes(), -std::numeric_limits<T>::infinity());
        }
        largest_size_ = hn::Zero(Lanes());
    }

    // Which of the triangles that begin at `lines` are doubtful, as bits; the bounds are extended by the others.
    HWY_INLINE std::uint32_t operator()(const T* lines) {
        const Lanes d;
        Vector a[3];
        Vector b[3];
        Vector c[3];
        Vector e[3];
        Vector f[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            a[axis] = hn::Load(d, lines + axis * corner_block);
            b[axis] = hn::Load(d, lines + (3 + axis) * corner_block);
            c[axis] = hn::Load(d, lines + (6 + axis) * corner_block);
            e[axis] = hn::Sub(b[axis], a[axis]);
            f[axis] = hn::Sub(c[axis], a[axis]);
        }
        const Vector size = hn::Max(largest(e[0], e[1], e[2]), largest(f[0], f[1], f[2]));
        const Vector normal =
            largest(hn::MulSub(e[1], f[2], hn::Mul(e[2], f[1])), hn::MulSub(e[2], f[0], hn::Mul(e[0], f[2])),
                    hn::MulSub(e[0], f[1], hn::Mul(e[1], f[0])));
        const auto in_range =
            hn::And(hn::Gt(size, hn::Set(d, Limits<T>::smallest)), hn::Lt(size, hn::Set(d, Limits<T>::largest)));
        const auto thick = hn::Gt(normal, hn::Mul(hn::Mul(size, size), hn::Set(d, Limits<T>::thin)));
        const auto certain = hn::And(in_range, thick);
        const bool all = hn::AllTrue(d, certain);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Vector low = hn::Min(lower_[axis], hn::Min(a[axis], hn::Min(b[axis], c[axis])));
            const Vector high = hn::Max(upper_[axis], hn::Max(a[axis], hn::Max(b[axis], c[axis])));
            lower_[axis] = all ? low : hn::IfThenElse(certain, low, lower_[axis]);
            upper_[axis] = all ? high : hn::IfThenElse(certain, high, upper_[axis]);
        }
        largest_size_ = hn::Max(largest_size_, all ? size : hn::IfThenElseZero(certain, size));
        if (HWY_LIKELY(all)) return 0;
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, hn::Not(certain), bits);
        return bits[0] | std::uint32_t{bits[1]} << 8;
    }

    Reach reach() const {
        Reach reach;
        Box& box = reach.bounds;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<glm::length_t>(axis);
            HWY_ALIGN T lower[lane_count];
            HWY_ALIGN T upper[lane_count];
            hn::Store(lower_[axis], Lanes(), lower);
            hn::Store(upper_[axis], Lanes(), upper);
            for (const T x : lower) box.lower[i] = std::min(box.lower[i], static_cast<double>(x));
            for (const T x : upper) box.upper[i] = std::max(box.upper[i], static_cast<double>(x));
        }
        HWY_ALIGN T size[lane_count];
        hn::Store(largest_size_, Lanes(), size);
        // Two edges meet in the first corner: the third is no longer than both.
        for (const T x : size) reach.largest_extent = std::max(reach.largest_extent, 2.0 * static_cast<double>(x));
        return reach;
    }

private:
    static HWY_INLINE Vector largest(Vector x, Vector y, Vector z) {
        return hn::Max(hn::Abs(x), hn::Max(hn::Abs(y), hn::Abs(z)));
    }

    Vector lower_[3];
    Vector upper_[3];
    Vector largest_size_; // of two edges of a triangle
};

template <class T>
void check_in_tiles(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t end, Reach& reach,
                    PageVector<std::uint32_t>& doubtful) {
    HWY_ALIGN T lines[tile / corner_block * corner_block_numbers];
    AreaCheck<T> check;
    for (; first < end; first += std::min(tile, end - first)) {
        const std::uint32_t count = std::min(tile, end - first);
        gather_mesh(mesh, first, first + count, {}, lines, 0);
        fill_lanes(lines, count, corner_blocks_for(count) * corner_block); // with what is doubtful
        for (std::uint32_t i = 0; i < count; i += AreaCheck<T>::lane_count) {
            for (std::uint32_t bits = check(lane_of(lines, i)); HWY_UNLIKELY(bits != 0); bits &= bits - 1) {
                const std::uint32_t triangle = i + static_cast<std::uint32_t>(__builtin_ctz(bits));
                if (triangle < count) doubtful.push_back(first + triangle);
            }
        }
    }
    reach.extend(check.reach());
}

void check_areas_kernel(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t end, Reach& reach,
                        PageVector<std::uint32_t>& doubtful) {
    if (mesh.arrays().vertices.scalar == Scalar::float32) {
        check_in_tiles<float>(mesh, first, end, reach, doubtful);
    } else {
        check_in_tiles<double>(mesh, first, end, reach, doubtful);
    }
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(check_areas_kernel);

void check_areas(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t end, Reach& reach,
                 PageVector<std::uint32_t>& doubtful) {
    HWY_DYNAMIC_DISPATCH(check_areas_kernel)(mesh, first, end, reach, doubtful);
}

} // namespace raywise
#endif
