#include "accel/bvh/build/references.h"

#include "accel/dense_region.h"
#include "geometry/mesh_cursor.h"

#include <algorithm>
#include <vector>

namespace raywise {
namespace {

constexpr std::uint64_t chunk_size = 16384; // primitives between two reports

BuildItem make_item(const Corners& c, const Vec3& center) {
    const Box exact{glm::min(c[0], glm::min(c[1], c[2])), glm::max(c[0], glm::max(c[1], c[2]))};
    const BoxF box = round_outwards(SceneFrame::relative(exact, center));
    BuildItem item;
    for (int axis = 0; axis < 3; ++axis) {
        item.lower[axis] = box.lower[axis];
        item.upper[axis] = box.upper[axis];
    }
    return item;
}

// Boxes of float32 corners are exact where they are not moved.
BuildItem make_item(const CornersF& c) {
    const Lanes a{c[0].x, c[0].y, c[0].z, 0.0f};
    const Lanes b{c[1].x, c[1].y, c[1].z, 0.0f};
    const Lanes d{c[2].x, c[2].y, c[2].z, 0.0f};
    const Bounds bounds{min_lanes(a, min_lanes(b, d)), max_lanes(a, max_lanes(b, d))};
    return bounds.item(0, 1);
}

} // namespace

BuildReferences gather_references(const BuildInput& input, const SceneFrame& frame,
                                  const std::function<void(std::uint64_t)>& report) {
    const Primitives& primitives = input.primitives;
    const Vec3 center = frame.center();
    std::vector<std::uint32_t> hittable; // empty when all are
    if (primitives.hittable_count() != primitives.count()) {
        hittable.reserve(primitives.hittable_count());
        for (std::uint32_t i = 0; i < primitives.count(); ++i) {
            if (primitives.is_hittable(i)) hittable.push_back(i);
        }
    }
    BuildReferences references;
    references.count = static_cast<std::uint32_t>(primitives.hittable_count());
    references.items = PageArray<BuildItem>(references.count);
    references.keys = PageArray<MortonKey>(references.count);
    const BoxF box = round_outwards(SceneFrame::relative(primitives.bounds(), center));
    const Bounds all{Lanes{box.lower.x, box.lower.y, box.lower.z, 0.0f},
                     Lanes{box.upper.x, box.upper.y, box.upper.z, 0.0f}};
    const DenseRegion dense = dense_region(primitives);
    const auto grid = MortonGrid::over_most(all, dense.center - center, dense.radius);
    references.bounds = all;
    const bool exact = center == Vec3(0.0);
    const std::uint64_t chunks = (references.count + chunk_size - 1) / chunk_size;
    input.parallel.for_each(chunks, [&](std::uint64_t chunk) {
        const std::uint64_t begin = chunk * chunk_size;
        const std::uint64_t end = std::min<std::uint64_t>(references.count, begin + chunk_size);
        MeshCursor cursor(primitives);
        for (std::uint64_t i = begin; i < end; ++i) {
            const std::uint32_t primitive = hittable.empty() ? static_cast<std::uint32_t>(i) : hittable[i];
            cursor.move_to(primitive);
            const TriangleMesh& mesh = cursor.mesh();
            const std::uint32_t triangle = cursor.triangle(primitive);
            BuildItem item = exact && mesh.is_float32() ? make_item(mesh.corners_float32(triangle))
                                                        : make_item(mesh.corners(triangle), center);
            item.id = primitive;
            item.count = 1;
            references.items[i] = item;
            references.keys[i] = {grid.code(Bounds::of(item).centroid()), static_cast<std::uint32_t>(i)};
        }
        report(end - begin);
    });
    return references;
}

} // namespace raywise
