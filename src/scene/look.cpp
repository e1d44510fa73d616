#include "scene/look.h"

#include "accel/grid/cell_lattice.h"
#include "base/split_mix.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory_resource>
#include <vector>

namespace raywise {
namespace {

// One out of each of `sampled` equal parts of all, at no regular distance: meshes repeat themselves. Those that can be hit.
std::pmr::vector<std::uint32_t> sample(const Primitives& primitives, std::uint32_t sampled,
                                       std::pmr::memory_resource& memory) {
    const std::uint32_t count = primitives.count();
    std::pmr::vector<std::uint32_t> chosen(&memory);
    chosen.reserve(sampled);
    for (std::uint64_t i = 0; i < sampled; ++i) {
        const std::uint64_t begin = i * count / sampled;
        const std::uint64_t size = (i + 1) * count / sampled - begin;
        chosen.push_back(static_cast<std::uint32_t>(begin + split_mix(i + 1) % size));
    }
    // They are far from each other, and the caches hold little of a mesh that has just been made or loaded: all are asked for at once.
    for (const std::uint32_t primitive : chosen) primitives.prefetch_indices(primitive);
    for (const std::uint32_t primitive : chosen) primitives.prefetch_vertices(primitive);
    chosen.erase(std::remove_if(chosen.begin(), chosen.end(),
                                [&](std::uint32_t primitive) { return !primitives.is_hittable(primitive); }),
                 chosen.end());
    return chosen;
}

// The grid that the features speak of.
struct Cells {
    Cells(const Box& bounds, double triangles)
        : lattice(bounds, grid_resolution(bounds.size(), triangles, feature_cells_per_triangle)) {}

    double count(int axis) const { return lattice.resolution[static_cast<std::size_t>(axis)]; }
    double number() const { return count(0) * count(1) * count(2); }

    // Between the cells along one axis there are planes; a line that meets the box meets each with the chance that areas give.
    double along_line() const {
        const Vec3 size = lattice.bounds.size();
        const double area = lattice.bounds.half_area();
        if (!(area > 0.0)) return max_component(Vec3(count(0), count(1), count(2)));
        double cells = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double face = size[(axis + 1) % 3] * size[(axis + 2) % 3];
            cells += (count(axis) - 1.0) * face / area;
        }
        return cells;
    }
    std::uint64_t at(const Vec3& point) const {
        std::uint64_t cell = 0;
        for (int axis = 2; axis >= 0; --axis) {
            const double place = (point[axis] - lattice.bounds.lower[axis]) * lattice.cells_per_unit[axis];
            cell = cell * lattice.resolution[static_cast<std::size_t>(axis)] +
                   static_cast<std::uint64_t>(std::clamp(place, 0.0, count(axis) - 1.0));
        }
        return cell;
    }
    // In the mean over where the planes are.
    double reached_by(const Vec3& box) const {
        double cells = 1.0;
        for (int axis = 0; axis < 3; ++axis)
            cells *= std::min(count(axis), 1.0 + box[axis] * lattice.cells_per_unit[axis]);
        return cells;
    }

    CellLattice lattice;
};

// The pairs of equal numbers.
double equal_pairs(std::pmr::vector<std::uint64_t>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    double pairs = 0.0;
    for (std::size_t begin = 0; begin < numbers.size();) {
        std::size_t end = begin;
        while (end < numbers.size() && numbers[end] == numbers[begin]) ++end;
        pairs += 0.5 * static_cast<double>(end - begin) * static_cast<double>(end - begin - 1);
        begin = end;
    }
    return pairs;
}

} // namespace

SceneFeatures look_at(const Primitives& primitives, std::uint32_t sampled) {
    // On the stack, for as many triangles as are looked at before a choice: a heap that many small pieces were given back to may take
    // milliseconds to put them together, at the next request for more than small pieces (malloc_consolidate of glibc).
    std::array<std::byte, 32768> stack;
    std::pmr::monotonic_buffer_resource memory(stack.data(), stack.size());
    const std::pmr::vector<std::uint32_t> chosen = sample(primitives, std::min(sampled, primitives.count()), memory);
    if (chosen.empty()) return typical_features(primitives.hittable_count());

    const double triangles = static_cast<double>(primitives.hittable_count());
    // Not the bounds: those of the triangles with area alone may not be known yet.
    const Cells cells(primitives.outer_bounds(), triangles);
    const double area = cells.lattice.bounds.half_area();
    SceneFeatures features;
    features.triangles = triangles;
    features.cells = cells.along_line();
    std::pmr::vector<std::uint64_t> cell_of_middle(&memory);
    cell_of_middle.reserve(chosen.size());
    for (const std::uint32_t primitive : chosen) {
        const Box box = primitives.box(primitive);
        features.boxes += area > 0.0 ? box.half_area() / area : 1.0;
        features.references += cells.reached_by(box.size());
        cell_of_middle.push_back(cells.at(box.center()));
    }
    const double looked_at = static_cast<double>(chosen.size());
    features.boxes *= triangles / looked_at;
    features.references /= looked_at;
    // Of all pairs the same part as of those looked at shares a cell.
    const double pairs = 0.5 * looked_at * (looked_at - 1.0);
    features.crowding = 1.0 + (pairs > 0.0 ? (triangles - 1.0) * equal_pairs(cell_of_middle) / pairs : 0.0);
    // As if each cell that holds something held as many middles.
    features.filled =
        features.cells * std::min(1.0, triangles * features.references / (features.crowding * cells.number()));
    return features;
}

} // namespace raywise
