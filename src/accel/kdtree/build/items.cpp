#include "accel/kdtree/build/items.h"

#include "accel/hittable_triangles.h"
#include "accel/kdtree/build/clip.h"

#include <cstdint>

namespace raywise {
namespace {

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

} // namespace

PageVector<BuildItem> gather_kd_items(const BuildInput& input, const SceneFrame& frame,
                                      const std::function<void(std::uint64_t)>& report) {
    PageVector<BuildItem> items(input.primitives.hittable_count());
    for_each_hittable(input, report,
                      [&](std::uint64_t i, std::uint32_t primitive, const TriangleMesh& mesh, std::uint32_t triangle) {
                          items[i] = frame.float_scale() != 0.0f && mesh.is_float32()
                                         ? item_of(mesh.corners_float32(triangle), frame.float_scale())
                                         : item_of(mesh.corners(triangle), frame);
                          items[i].id = primitive;
                      });
    return items;
}

} // namespace raywise
