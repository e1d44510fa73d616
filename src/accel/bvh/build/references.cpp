#include "accel/bvh/build/references.h"

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

// Where most primitives are. A curve over all of a scene would follow one axis alone where something lies far off along the two others:
// terrain with a stray corner at the origin would be cut into layers. What lies outside has the codes of the cells along the border.
Bounds dense_part(const Bounds& all, double radius) {
    constexpr double radii = 4.0;
    const Lanes reach = fill_lanes(static_cast<float>(std::min(radii * radius, 0x1p127)));
    return {max_lanes(all.lower, -reach), min_lanes(all.upper, reach)};
}

} // namespace

BuildReferences gather_references(const BuildInput& input, const SceneFrame& frame,
                                  const std::function<void(std::uint64_t)>& report) {
    const Primitives& primitives = input.primitives;
    const Vec3 center = frame.center();
    PageVector<std::uint32_t> hittable; // empty when all are
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
    const MortonGrid grid(dense_part(all, frame.radius()));
    references.bounds = all;
    const bool exact = center == Vec3(0.0);
    const std::uint64_t chunks = (references.count + chunk_size - 1) / chunk_size;
    input.parallel.for_each(chunks, [&](std::uint64_t chunk) {
        const std::uint64_t begin = chunk * chunk_size;
        const std::uint64_t end = std::min<std::uint64_t>(references.count, begin + chunk_size);
        PrimitiveId id{0, 0};
        std::uint32_t next = 0; // the first primitive after the mesh of `id`
        for (std::uint64_t i = begin; i < end; ++i) {
            const std::uint32_t primitive = hittable.empty() ? static_cast<std::uint32_t>(i) : hittable[i];
            if (primitive >= next) {
                id = primitives.locate(primitive);
                next = primitives.number({id.geometry, 0}) + primitives.meshes()[id.geometry]->triangle_count();
            }
            const TriangleMesh& mesh = *primitives.meshes()[id.geometry];
            const std::uint32_t triangle = mesh.triangle_count() - (next - primitive);
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
