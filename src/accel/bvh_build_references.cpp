#include "accel/bvh_build_references.h"

#include <algorithm>
#include <mutex>
#include <vector>

namespace raywise {
namespace {

constexpr std::uint64_t chunk_size = 16384; // primitives between two reports

BuildItem make_item(const Primitives& primitives, std::uint32_t primitive, const Vec3& center) {
    const Box box = primitives.box(primitive);
    const BoxF rounded = round_outwards({box.lower - center, box.upper - center});
    BuildItem item;
    for (int axis = 0; axis < 3; ++axis) {
        item.lower[axis] = rounded.lower[axis];
        item.upper[axis] = rounded.upper[axis];
    }
    item.id = primitive;
    item.count = 1;
    return item;
}

} // namespace

// Zero where it costs no more than three bits of float32's 24: there boxes of float32 geometry are exact.
Vec3 choose_bvh_center(const Box& bounds) {
    const double size = max_component(bounds.size());
    const Vec3 center = bounds.center();
    return max_component(glm::abs(center)) > 8.0 * size ? center : Vec3(0.0);
}

BuildReferences gather_references(const BuildInput& input, const Vec3& center,
                                  const std::function<void(std::uint64_t)>& report) {
    const Primitives& primitives = input.primitives;
    std::vector<std::uint32_t> hittable; // empty when all are
    if (primitives.hittable_count() != primitives.count()) {
        hittable.reserve(primitives.hittable_count());
        for (std::uint32_t i = 0; i < primitives.count(); ++i) {
            if (primitives.is_hittable(i)) hittable.push_back(i);
        }
    }
    BuildReferences references;
    references.count = static_cast<std::uint32_t>(primitives.hittable_count());
    references.items = make_uninitialised<BuildItem>(references.count);
    std::mutex mutex;
    const std::uint64_t chunks = (references.count + chunk_size - 1) / chunk_size;
    input.parallel.for_each(chunks, [&](std::uint64_t chunk) {
        const std::uint64_t begin = chunk * chunk_size;
        const std::uint64_t end = std::min<std::uint64_t>(references.count, begin + chunk_size);
        Bounds bounds = Bounds::none();
        Bounds centroids = Bounds::none();
        for (std::uint64_t i = begin; i < end; ++i) {
            const BuildItem item =
                make_item(primitives, hittable.empty() ? static_cast<std::uint32_t>(i) : hittable[i], center);
            references.items[i] = item;
            bounds.extend(Bounds::of(references.items[i]));
            centroids.extend(Bounds::of_centroid(references.items[i]));
        }
        {
            const std::lock_guard lock(mutex);
            references.bounds.extend(bounds);
            references.centroids.extend(centroids);
        }
        report(end - begin);
    });
    return references;
}

} // namespace raywise
