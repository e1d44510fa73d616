#include "accel/scan/linear_scan_kernels.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/scan/linear_scan_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/scan/scan_ray.h"
#include "geometry/corner_lines-inl.h"

#include <algorithm>
#include <optional>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

// As many as a register has, up to a block.
using Lanes = hn::CappedTag<float, corner_block>;
using Vector = hn::VFromD<Lanes>;
inline constexpr std::size_t lane_count = hn::MaxLanes(Lanes());

// So many blocks are 18 KiB: they stay in the first-level cache while one ray after the other is held against them.
constexpr std::size_t tile_blocks = 32;
constexpr std::uint32_t tile_triangles = tile_blocks * corner_block;

// So many rays go through the triangles together: their numbers stay beside a tile.
constexpr std::size_t rays_together = 32;

CornerFrame corner_frame(const SceneFrame& frame) { return {frame.center(), frame.scale()}; }

template <class Mask>
HWY_INLINE std::uint32_t bits_of(Mask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Lanes(), mask, bytes);
    return lane_count <= 8 ? bytes[0] : bytes[0] | std::uint32_t{bytes[1]} << 8;
}

// A ray's numbers in all lanes.
class Filter {
public:
    HWY_INLINE explicit Filter(const ScanRay& ray)
        : x_(ray.x_axis * corner_block),
          y_(ray.y_axis * corner_block),
          z_(ray.z_axis * corner_block),
          shear_x_(hn::Set(Lanes(), ray.shear_x)),
          shear_y_(hn::Set(Lanes(), ray.shear_y)),
          offset_x_(hn::Set(Lanes(), ray.offset_x)),
          offset_y_(hn::Set(Lanes(), ray.offset_y)),
          scene_error_(hn::Set(Lanes(), ray.scene_error)),
          minus_scene_error_(hn::Neg(scene_error_)),
          start_error_(hn::Set(Lanes(), ray.start_error)) {}

    // Which of the triangles whose corners begin at `lines` may be hit by the line of the ray. NaN never is: comparisons are written
    // for that. The bound of the scene rules out nearly all; where it does not, the one that goes by how far the corners are from
    // the ray is asked as well: in a scene with a small and fine part all of that is within the scene's bound.
    HWY_INLINE std::uint32_t operator()(const float* lines) const {
        const Lanes d;
        const Point a = corner(lines);
        const Point b = corner(lines + 3 * corner_block);
        const Point c = corner(lines + 6 * corner_block);
        const Vector wa = hn::MulSub(b.x, c.y, hn::Mul(b.y, c.x));
        const Vector wb = hn::MulSub(c.x, a.y, hn::Mul(c.y, a.x));
        const Vector wc = hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x));
        const Vector highest = hn::Max(wa, hn::Max(wb, wc));
        const Vector lowest = hn::Min(wa, hn::Min(wb, wc));
        const auto near = hn::Or(hn::Ge(lowest, minus_scene_error_), hn::Le(highest, scene_error_));
        if (HWY_LIKELY(hn::AllFalse(d, near))) return 0;
        const Vector largest =
            hn::Max(size_of(lines), hn::Max(size_of(lines + 3 * corner_block), size_of(lines + 6 * corner_block)));
        const Vector e = hn::MulAdd(hn::Set(d, ScanRay::corner_error), largest, start_error_);
        const Vector reach = hn::Max(reach_of(a), hn::Max(reach_of(b), reach_of(c)));
        // 2^-21 R^2 is twice 4 u R^2, for the rounding of these lines.
        const Vector error = hn::MulAdd(reach, hn::MulAdd(hn::Set(d, 0x1p-21f), reach, hn::Mul(hn::Set(d, 4.0f), e)),
                                        hn::Mul(hn::Add(e, e), e));
        return bits_of(hn::Or(hn::Ge(lowest, hn::Neg(error)), hn::Le(highest, error)));
    }

private:
    struct Point {
        Vector x;
        Vector y;
    };
    HWY_INLINE Point corner(const float* lines) const {
        const Lanes d;
        const Vector z = hn::Load(d, lines + z_);
        return {hn::NegMulAdd(shear_x_, z, hn::Sub(hn::Load(d, lines + x_), offset_x_)),
                hn::NegMulAdd(shear_y_, z, hn::Sub(hn::Load(d, lines + y_), offset_y_))};
    }
    // The largest coordinate of a corner.
    static HWY_INLINE Vector size_of(const float* lines) {
        const Lanes d;
        return hn::Max(hn::Abs(hn::Load(d, lines)), hn::Max(hn::Abs(hn::Load(d, lines + corner_block)),
                                                            hn::Abs(hn::Load(d, lines + 2 * corner_block))));
    }
    static HWY_INLINE Vector reach_of(const Point& p) { return hn::Max(hn::Abs(p.x), hn::Abs(p.y)); }

    std::size_t x_;
    std::size_t y_;
    std::size_t z_;
    Vector shear_x_;
    Vector shear_y_;
    Vector offset_x_;
    Vector offset_y_;
    Vector scene_error_;
    Vector minus_scene_error_;
    Vector start_error_;
};

// Blocks of primitives from `first` on against one ray: sink(primitive) for those it may hit, until that returns true. Returns whether
// it did.
template <class Sink>
HWY_INLINE bool scan_blocks(const ScanRay& ray, const float* blocks, std::size_t count, std::uint32_t first,
                            Sink& sink) {
    const Filter filter(ray);
    for (std::size_t block = 0; block < count; ++block) {
        for (std::size_t lane = 0; lane < corner_block; lane += lane_count) {
            std::uint32_t bits = filter(blocks + block * corner_block_numbers + lane);
            for (; HWY_UNLIKELY(bits != 0); bits &= bits - 1) {
                const auto i = static_cast<std::uint32_t>(block * corner_block + lane) +
                               static_cast<std::uint32_t>(__builtin_ctz(bits));
                if (sink(first + i)) return true;
            }
        }
    }
    return false;
}

void gather_kernel(const Primitives& primitives, const SceneFrame& frame, std::uint32_t first, std::uint32_t end,
                   float* blocks) {
    const CornerFrame corners = corner_frame(frame);
    const std::uint32_t count = end - first;
    std::size_t lane = 0;
    while (first < end) {
        const PrimitiveId id = primitives.locate(first);
        const TriangleMesh& mesh = *primitives.meshes()[id.geometry];
        const std::uint32_t here = std::min(end - first, mesh.triangle_count() - id.primitive);
        gather_mesh(mesh, id.primitive, id.primitive + here, corners, blocks, lane);
        first += here;
        lane += here;
    }
    fill_lanes(blocks, count, corner_blocks_for(count) * corner_block);
}

// All rays of a group through all triangles. `sinks`, one for each, take what may be hit.
template <class Sink>
void scan(const ScannedScene& scene, const ScanRay* rays, Sink* sinks, std::size_t count) {
    HWY_ALIGN float gathered[tile_blocks * corner_block_numbers];
    const std::uint32_t triangles = scene.primitives.count();
    bool done[rays_together] = {};
    std::size_t left = count;
    for (std::uint32_t first = 0; first < triangles && left > 0; first += tile_triangles) {
        const std::uint32_t here = std::min(tile_triangles, triangles - first);
        const float* blocks = gathered;
        if (scene.blocks != nullptr) {
            blocks = scene.blocks + first / corner_block * corner_block_numbers;
        } else {
            gather_kernel(scene.primitives, scene.frame, first, first + here, gathered);
        }
        for (std::size_t i = 0; i < count; ++i) {
            if (done[i] || !scan_blocks(rays[i], blocks, corner_blocks_for(here), first, sinks[i])) continue;
            done[i] = true;
            --left;
        }
    }
}

// What a ray may hit goes to the exact test, and from there to its collector.
template <class Collector>
struct Candidates {
    const Primitives* primitives;
    const ExactRay* ray;
    Collector* collector;

    bool operator()(std::uint32_t primitive) const {
        PrimitiveHit hit;
        return primitives->test(*ray, primitive, hit) && collector->collect(hit);
    }
};

// Sets the rays up, those that may hit something, in groups.
template <class Collector>
void scan_in_groups(const ScannedScene& scene, const Ray* rays, std::size_t count, Collector* collectors) {
    if (scene.primitives.hittable_count() == 0) return;
    std::optional<ExactRay> exact[rays_together];
    ScanRay group[rays_together];
    Candidates<Collector> candidates[rays_together];
    std::size_t size = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (!rays[i].is_traceable()) continue;
        exact[size].emplace(rays[i]);
        if (!group[size].set(*exact[size], scene.frame)) continue;
        candidates[size] = {&scene.primitives, &*exact[size], collectors + i};
        if (++size < rays_together) continue;
        scan(scene, group, candidates, size);
        size = 0;
    }
    if (size > 0) scan(scene, group, candidates, size);
}

void scan_closest_kernel(const ScannedScene& scene, const Ray* rays, std::size_t count, ClosestCollector* collectors) {
    scan_in_groups(scene, rays, count, collectors);
}

void scan_any_kernel(const ScannedScene& scene, const Ray* rays, std::size_t count, AnyCollector* collectors) {
    scan_in_groups(scene, rays, count, collectors);
}

void scan_all_kernel(const ScannedScene& scene, const Ray& ray, AllCollector& collector) {
    scan_in_groups(scene, &ray, 1, &collector);
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(gather_kernel);
HWY_EXPORT(scan_closest_kernel);
HWY_EXPORT(scan_any_kernel);
HWY_EXPORT(scan_all_kernel);

void gather_blocks(const Primitives& primitives, const SceneFrame& frame, std::uint32_t first, std::uint32_t end,
                   float* blocks) {
    HWY_DYNAMIC_DISPATCH(gather_kernel)(primitives, frame, first, end, blocks);
}
void scan_closest(const ScannedScene& scene, const Ray* rays, std::size_t count, ClosestCollector* collectors) {
    HWY_DYNAMIC_DISPATCH(scan_closest_kernel)(scene, rays, count, collectors);
}
void scan_any(const ScannedScene& scene, const Ray* rays, std::size_t count, AnyCollector* collectors) {
    HWY_DYNAMIC_DISPATCH(scan_any_kernel)(scene, rays, count, collectors);
}
void scan_all(const ScannedScene& scene, const Ray& ray, AllCollector& collector) {
    HWY_DYNAMIC_DISPATCH(scan_all_kernel)(scene, ray, collector);
}

} // namespace raywise
#endif
