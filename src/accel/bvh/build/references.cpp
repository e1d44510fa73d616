#include "accel/bvh/build/references.h"

#include "accel/hittable_triangles.h"

namespace raywise {
namespace {

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

BuildReferences gather_references(const BuildInput& input, const SceneFrame& frame, const Box& most,
                                  const std::function<void(std::uint64_t)>& report) {
    const Primitives& primitives = input.primitives;
    const Vec3 center = frame.center();
    BuildReferences references;
    references.count = static_cast<std::uint32_t>(primitives.hittable_count());
    references.items = PageArray<BuildItem>(references.count);
    references.keys = PageArray<MortonKey>(references.count);
    references.bounds = bounds_of(round_outwards(SceneFrame::relative(primitives.bounds(), center)));
    const MortonGrid grid(bounds_of(BoxF{Vec3f(most.lower - center), Vec3f(most.upper - center)}));
    const bool exact = center == Vec3(0.0);
    for_each_hittable(input, report,
                      [&](std::uint64_t i, std::uint32_t primitive, const TriangleMesh& mesh, std::uint32_t triangle) {
                          BuildItem item = exact && mesh.is_float32() ? make_item(mesh.corners_float32(triangle))
                                                                      : make_item(mesh.corners(triangle), center);
                          item.id = primitive;
                          item.count = 1;
                          references.items[i] = item;
                          references.keys[i] = {grid.code(Bounds::of(item).centroid()), static_cast<std::uint32_t>(i)};
                      });
    return references;
}

} // namespace raywise
