#include "accel/scan/linear_scan_kernels.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/scan/linear_scan_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/scan/outcodes-inl.h"
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

// So many rays at a time are sooner done by outcodes than over blocks, where triangles share their vertices.
constexpr std::size_t fewest_not_over_blocks = 6;

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

// Rays that go through the triangles together. `sinks`, one for each, take what may be hit.
template <class Sink>
struct RayGroup {
    const ScanRay* rays;
    Sink* sinks;
    std::uint32_t live; // a bit for each ray that wants more

    void test(std::size_t ray, std::uint32_t primitive) {
        if (sinks[ray](primitive)) live &= ~(std::uint32_t{1} << ray);
    }
};

// The rays of a group through the primitives of a tile, first ... first + count - 1.
template <class Sink>
void scan_tile(const ScannedScene& scene, std::uint32_t first, std::uint32_t count, RayGroup<Sink>& group) {
    HWY_ALIGN float gathered[tile_blocks * corner_block_numbers];
    const float* blocks = gathered;
    if (scene.blocks != nullptr) {
        blocks = scene.blocks + first / corner_block * corner_block_numbers;
    } else {
        gather_kernel(scene.primitives, scene.frame, first, first + count, gathered);
    }
    for (std::uint32_t rays = group.live; rays != 0; rays &= rays - 1) {
        const auto i = static_cast<std::size_t>(__builtin_ctz(rays));
        if (scan_blocks(group.rays[i], blocks, corner_blocks_for(count), first, group.sinks[i]))
            group.live &= ~(std::uint32_t{1} << i);
    }
}

template <class Sink>
void scan_tiles(const ScannedScene& scene, std::uint32_t first, std::uint32_t end, RayGroup<Sink>& group) {
    for (; first < end && group.live != 0; first += std::min(tile_triangles, end - first))
        scan_tile(scene, first, std::min(tile_triangles, end - first), group);
}

// What outcodes leave of a tile's triangles: how many corners are around a ray depends on how large triangles are, and how they lie to the
// axes. Where they are many, the tile is scanned as others are, which rules out more.
class Remaining {
public:
    explicit Remaining(std::size_t rays) : most_pairs_(32 + 8 * rays) {}

    // Returns false where there are too many.
    HWY_INLINE bool add(std::uint32_t triangle, std::uint32_t rays) {
        pairs_ += static_cast<std::size_t>(__builtin_popcount(rays));
        if (count_ == most || pairs_ > most_pairs_) return false;
        triangles_[count_] = triangle;
        rays_[count_] = rays;
        ++count_;
        return true;
    }
    void clear() { count_ = pairs_ = 0; }

    template <class Sink>
    void test(std::uint32_t first_primitive, RayGroup<Sink>& group) const {
        for (std::size_t k = 0; k < count_; ++k) {
            for (std::uint32_t rays = rays_[k] & group.live; rays != 0; rays &= rays - 1)
                group.test(static_cast<std::size_t>(__builtin_ctz(rays)), first_primitive + triangles_[k]);
        }
    }

private:
    static constexpr std::size_t most = 64;
    const std::size_t most_pairs_;
    std::size_t count_ = 0;
    std::size_t pairs_ = 0;
    std::uint32_t triangles_[most];
    std::uint32_t rays_[most];
};

// The triangles of a mesh, whose vertices have codes, against a group.
template <class Codes, class Sink>
void scan_codes(const ScannedScene& scene, const TriangleMesh& mesh, std::uint32_t first_primitive,
                const typename Codes::Code* codes, RayGroup<Sink>& group) {
    with_indices(mesh.arrays().indices, [&](const auto& index) HWY_ATTR {
        Remaining remaining(static_cast<std::size_t>(__builtin_popcount(group.live)));
        for (std::uint32_t begin = 0; begin < mesh.triangle_count() && group.live != 0;) {
            const std::uint32_t count = std::min(tile_triangles, mesh.triangle_count() - begin);
            remaining.clear();
            bool all_fit = true;
            for (std::uint32_t i = begin; i < begin + count; ++i) {
                const std::uint32_t near =
                    group.live & Codes::near(codes[index(i, 0)] & codes[index(i, 1)] & codes[index(i, 2)]);
                if (HWY_LIKELY(near == 0)) continue;
                all_fit = remaining.add(i, near);
                if (!all_fit) break;
            }
            if (all_fit) {
                remaining.test(first_primitive, group);
            } else {
                scan_tile(scene, first_primitive + begin, count, group);
            }
            begin += count;
        }
    });
}

// The rest of the memory is worth more to the caller.
constexpr std::uint64_t most_code_bytes = std::uint64_t{64} << 20;

// The rays of a group, Codes::rays at most, through a mesh. Returns false, with nothing done, where there is no memory for it.
template <class Codes, class Sink>
bool scan_mesh(const ScannedScene& scene, const TriangleMesh& mesh, std::uint32_t first_primitive,
               RayGroup<Sink>& group) {
    using Code = typename Codes::Code;
    // Behind the last there is room for what vectors write there.
    const std::uint64_t vertices = mesh.arrays().vertex_count;
    const std::uint64_t bytes = (vertices + 16) * sizeof(Code);
    if (bytes > most_code_bytes) return false;
    CodeMemory memory;
    auto* const codes = reinterpret_cast<Code*>(memory.take(bytes));
    if (codes == nullptr) return false;
    with_vertices(mesh.arrays().vertices, corner_frame(scene.frame), [&](const auto& rows, float scale) HWY_ATTR {
        OutcodeRay rays[Codes::rays];
        for (std::size_t i = 0; i < Codes::rays; ++i) {
            if ((group.live >> i & 1) != 0) rays[i] = OutcodeRay(group.rays[i], scale);
        }
        Codes::note(rays, rows, vertices, codes);
    });
    scan_codes<Codes>(scene, mesh, first_primitive, codes, group);
    return true;
}

// The rays of a group through all meshes, by codes where that suits the mesh.
template <class Codes, class Sink>
void scan_meshes(const ScannedScene& scene, RayGroup<Sink>& group) {
    std::uint32_t first = 0;   // of the mesh
    std::uint32_t waiting = 0; // the primitives from here up to the mesh go through tiles, of several meshes at a time
    for (const auto& mesh : scene.primitives.meshes()) {
        const std::uint32_t end = first + mesh->triangle_count();
        if (suits_outcodes(*mesh, Codes::rays) && scan_mesh<Codes>(scene, *mesh, first, group)) {
            scan_tiles(scene, waiting, first, group);
            waiting = end;
        }
        first = end;
    }
    scan_tiles(scene, waiting, first, group);
}

// All rays of a group through all triangles.
template <class Sink>
void scan(const ScannedScene& scene, const ScanRay* rays, Sink* sinks, std::size_t count) {
    using Many = ManyRaysCode<16>;
    if (scene.blocks != nullptr && (count < fewest_not_over_blocks || !suit_outcodes(scene.primitives))) {
        RayGroup<Sink> group{rays, sinks, static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1)};
        scan_tiles(scene, 0, scene.primitives.count(), group);
        return;
    }
    const ScannedScene in_place{scene.primitives, scene.frame, nullptr};
    for (std::size_t begin = 0; begin < count; begin += Many::rays) {
        const std::size_t size = std::min(Many::rays, count - begin);
        RayGroup<Sink> group{rays + begin, sinks + begin, (std::uint32_t{1} << size) - 1};
        if (size == 1) {
            scan_meshes<OneRayCode>(in_place, group);
        } else {
            scan_meshes<Many>(in_place, group);
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
namespace {

// Fewer triangles are not worth it.
constexpr std::uint32_t fewest_for_outcodes = 256;

} // namespace

bool suits_outcodes(const TriangleMesh& mesh, std::size_t rays) {
    if (mesh.invalid_count() > 0 || mesh.vertex_bounds().empty() || mesh.triangle_count() < fewest_for_outcodes)
        return false;
    const std::uint64_t triangles = mesh.triangle_count();
    return mesh.arrays().vertex_count <= (rays == 1 ? 3 * triangles : triangles + triangles / 2);
}

bool suit_outcodes(const Primitives& primitives) {
    const auto suits = [](const auto& mesh) { return suits_outcodes(*mesh, 2); };
    return std::all_of(primitives.meshes().begin(), primitives.meshes().end(), suits);
}

HWY_EXPORT(gather_kernel);
HWY_EXPORT(scan_closest_kernel);
HWY_EXPORT(scan_any_kernel);
HWY_EXPORT(scan_all_kernel);

namespace {

// Where there are so few triangles that setting a ray up for the filter takes longer than asking the exact test about each.
template <class Collector>
void test_all(const ScannedScene& scene, const Ray* rays, std::size_t count, Collector* collectors) {
    for (std::size_t i = 0; i < count; ++i) {
        if (!rays[i].is_traceable()) continue;
        const ExactRay ray(rays[i]);
        PrimitiveHit hit;
        for (std::uint32_t primitive = 0; primitive < scene.primitives.count(); ++primitive) {
            if (scene.primitives.test(ray, primitive, hit) && collectors[i].collect(hit)) break;
        }
    }
}

bool is_tiny(const ScannedScene& scene) {
    return scene.blocks == nullptr && scene.primitives.count() <= most_tested_singly;
}

} // namespace

void gather_blocks(const Primitives& primitives, const SceneFrame& frame, std::uint32_t first, std::uint32_t end,
                   float* blocks) {
    HWY_DYNAMIC_DISPATCH(gather_kernel)(primitives, frame, first, end, blocks);
}
void scan_closest(const ScannedScene& scene, const Ray* rays, std::size_t count, ClosestCollector* collectors) {
    if (is_tiny(scene)) return test_all(scene, rays, count, collectors);
    HWY_DYNAMIC_DISPATCH(scan_closest_kernel)(scene, rays, count, collectors);
}
void scan_any(const ScannedScene& scene, const Ray* rays, std::size_t count, AnyCollector* collectors) {
    if (is_tiny(scene)) return test_all(scene, rays, count, collectors);
    HWY_DYNAMIC_DISPATCH(scan_any_kernel)(scene, rays, count, collectors);
}
void scan_all(const ScannedScene& scene, const Ray& ray, AllCollector& collector) {
    if (is_tiny(scene)) return test_all(scene, &ray, 1, &collector);
    HWY_DYNAMIC_DISPATCH(scan_all_kernel)(scene, ray, collector);
}

} // namespace raywise
#endif
