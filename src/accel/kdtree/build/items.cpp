#include "accel/kdtree/build/items.h"

#include "accel/kdtree/build/clip.h"
#include "geometry/mesh_cursor.h"

#include <algorithm>
#include <cstdint>

namespace raywise {
namespace {

constexpr std::uint64_t chunk_size = 16384; // primitives between two reports

BuildItem item_of(const CornersF& c, float scale) {
    const Lanes factor = fill_lanes(scale);
    const Lanes p = Lanes{c[0].x, c[0].y, c[0].z, 0.0f} * factor;
    const Lanes q = Lanes{c[1].x, c[1].y, c[1].z, 0.0f} * factor;
    const Lanes r = Lanes{c[2].x, c[2].y, c[2].z, 0.0f} * factor;
    return Bounds{min_lanes(p, min_lanes(q, r)), max_lanes(p, max_lanes(q, r))}.item(0, 1);
}

BuildItem item_of(const Corners& c, const SceneFrame& frame) {
    const Box relative = frame.relative({glm::min(c[0], glm::min(c[1], c[2])), glm::max(c[0], glm::max(c[1], c[2]))});
    return rounded_bounds({relative.lower * frame.scale(), relative.upper * frame.scale()}).item(0, 1);
}

std::vector<std::uint32_t> hittable_primitives(const Primitives& primitives) {
    std::vector<std::uint32_t> list;
    list.reserve(primitives.hittable_count());
    for (std::uint32_t i = 0; i < primitives.count(); ++i) {
        if (primitives.is_hittable(i)) list.push_back(i);
    }
    return list;
}

} // namespace

std::vector<BuildItem> gather_kd_items(const BuildInput& input, const SceneFrame& frame,
                                       const std::function<void(std::uint64_t)>& report) {
    const Primitives& primitives = input.primitives;
    std::vector<std::uint32_t> hittable; // empty when all are
    if (primitives.hittable_count() != primitives.count()) hittable = hittable_primitives(primitives);
    std::vector<BuildItem> items(primitives.hittable_count());
    const std::uint64_t chunks = (items.size() + chunk_size - 1) / chunk_size;
    input.parallel.for_each(chunks, [&](std::uint64_t chunk) {
        const std::uint64_t begin = chunk * chunk_size;
        const std::uint64_t end = std::min<std::uint64_t>(items.size(), begin + chunk_size);
        MeshCursor cursor(primitives);
        for (std::uint64_t i = begin; i < end; ++i) {
            const std::uint32_t primitive = hittable.empty() ? static_cast<std::uint32_t>(i) : hittable[i];
            cursor.move_to(primitive);
            const TriangleMesh& mesh = cursor.mesh();
            const std::uint32_t triangle = cursor.triangle(primitive);
            items[i] = frame.float_scale() != 0.0f && mesh.is_float32()
                           ? item_of(mesh.corners_float32(triangle), frame.float_scale())
                           : item_of(mesh.corners(triangle), frame);
            items[i].id = primitive;
        }
        report(end - begin);
    });
    return items;
}

} // namespace raywise
