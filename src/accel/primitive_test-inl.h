// The leaf test for lists of primitives, inside a traversal that is compiled for each target itself (accel/primitive_test.h).
//
// For each target of Highway once: include it inside the loop of hwy/foreach_target.h.
#if defined(RAYWISE_ACCEL_PRIMITIVE_TEST_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAYWISE_ACCEL_PRIMITIVE_TEST_INL_H_
#undef RAYWISE_ACCEL_PRIMITIVE_TEST_INL_H_
#else
#define RAYWISE_ACCEL_PRIMITIVE_TEST_INL_H_
#endif

#include "geometry/corner_lines-inl.h"
#include "geometry/primitives.h"
#include "geometry/triangle_block-inl.h"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {

static_assert(listed_at_once == triangle_block_size);

// At most eight primitives out of a list, and behind them the last one again.
struct Listed {
    std::uint32_t ids[triangle_block_size];
    std::uint32_t n = 0;

    // Takes what can be hit from the list's beginning. Returns how many it has looked at.
    HWY_INLINE std::size_t take(const Primitives& primitives, const std::uint32_t* list, std::size_t count) {
        n = 0;
        std::size_t next = 0;
        for (; next < count && n < triangle_block_size; ++next) {
            if (primitives.is_hittable(list[next])) ids[n++] = list[next];
        }
        for (std::uint32_t i = n; n > 0 && i < triangle_block_size; ++i) ids[i] = ids[n - 1];
        return next;
    }
};

// Eight primitives as triangles of the mesh that the first one is in.
struct ListedTriangles {
    const TriangleMesh& mesh;
    std::uint32_t triangles[triangle_block_size];
    bool has_rows; // all are of that mesh, and its vertices are rows: their corners can be gathered

    HWY_INLINE ListedTriangles(const Primitives& primitives, const std::uint32_t (&ids)[triangle_block_size])
        : ListedTriangles(primitives, ids, primitives.locate(ids[0])) {}

private:
    HWY_INLINE ListedTriangles(const Primitives& primitives, const std::uint32_t (&ids)[triangle_block_size],
                               const PrimitiveId& first)
        : mesh(*primitives.meshes()[first.geometry]), has_rows(mesh.arrays().vertices.has_rows()) {
        for (std::uint32_t i = 0; i < triangle_block_size; ++i) {
            triangles[i] = ids[i] - (ids[0] - first.primitive);
            has_rows &= triangles[i] < mesh.triangle_count();
        }
    }
};

// No corner of the block is farther from the origin along any axis.
template <class T>
HWY_INLINE double farthest_corner(const TriangleBlock<T>& block, const Vec3& origin) {
    const TriangleLanes d;
    TriangleVector farthest = hn::Zero(d);
    for (std::uint32_t lane = 0; lane < block.n; lane += triangle_lanes) {
        const auto in_block = hn::FirstN(d, block.n - lane); // lanes behind it hold anything
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const TriangleVector start = hn::Set(d, origin[static_cast<glm::length_t>(axis)]);
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const TriangleVector place = load_coordinates(block.line(corner, axis) + lane);
                farthest = hn::Max(farthest, hn::IfThenElseZero(in_block, hn::Abs(hn::Sub(place, start))));
            }
        }
    }
    return hn::GetLane(hn::MaxOfLanes(d, farthest));
}

// Triangles of one mesh, whose vertices are rows of T.
template <class T, class Collector>
HWY_INLINE bool test_in_lanes(const BlockRay& ray, const TriangleMesh& mesh, const std::uint32_t* triangles,
                              const Listed& listed, Collector& collector) {
    HWY_ALIGN std::byte data[TriangleBlock<T>::bytes_per_triangle * corner_block];
    gather_listed(mesh.arrays(), triangles, reinterpret_cast<T*>(data));
    for (std::uint32_t i = 0; i < listed.n; ++i) write_block_id<T>(data, corner_block, i, listed.ids[i]);
    const TriangleBlock<T> block(data, listed.n, corner_block);
    return test_triangle_block(ray, block, farthest_corner(block, ray.ray.origin), collector);
}

// As test_primitives.
template <class Collector>
HWY_INLINE bool test_listed(const Primitives& primitives, const BlockRay& block_ray, const std::uint32_t* list,
                            std::size_t count, Collector& collector) {
    const ExactRay& ray = block_ray.ray;
    Listed listed;
    for (std::size_t next = 0; next < count;) {
        next += listed.take(primitives, list + next, count - next);
        if (listed.n == 0) break;
        const ListedTriangles of_mesh(primitives, listed.ids);
        const TriangleMesh& mesh = of_mesh.mesh;
        if (!of_mesh.has_rows) {
            for (std::uint32_t i = 0; i < listed.n; ++i) {
                PrimitiveHit hit;
                if (primitives.test(ray, listed.ids[i], hit) && collector.collect(hit)) return true;
            }
        } else if (mesh.is_float32() ? test_in_lanes<float>(block_ray, mesh, of_mesh.triangles, listed, collector)
                                     : test_in_lanes<double>(block_ray, mesh, of_mesh.triangles, listed, collector)) {
            return true;
        }
    }
    return false;
}

} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
