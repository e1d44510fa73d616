// What a committed scene is, and the structures there are.
#include "accel/grid/uniform_grid.h"
#include "base/shared_bytes.h"
#include "convert.h"
#include "guard.h"

using namespace raywise;
using namespace raywise::capi;

extern "C" {

std::int32_t rw_structure_count(std::uint32_t* count) {
    return guard([&] { required(count, "count") = static_cast<std::uint32_t>(structure_count); });
}

std::int32_t rw_structure_name(std::uint32_t index, const char** name) {
    return guard([&] {
        const char*& out = required(name, "name");
        if (index >= structure_count) {
            throw Error(Status::ERROR_INVALID_ARGUMENT,
                        "index: " + std::to_string(index) + " is not below " + std::to_string(structure_count));
        }
        out = structure_names[index];
    });
}

std::int32_t rw_scene_bounds(const rw_scene* scene, double* lower, double* upper) {
    return guard([&] {
        const Box& bounds = required(scene, "scene").value->tracer().primitives().bounds();
        const auto layout = [](const double& first) {
            return ByteLayout{reinterpret_cast<std::uintptr_t>(&first), 3, sizeof first, 1, 0, sizeof first};
        };
        if (share_bytes(layout(required(lower, "lower")), layout(required(upper, "upper"))))
            throw Error(Status::ERROR_SHARED_MEMORY, "lower and upper: they share memory");
        for (int axis = 0; axis < 3; ++axis) {
            lower[axis] = bounds.lower[axis];
            upper[axis] = bounds.upper[axis];
        }
    });
}

std::int32_t rw_scene_get_statistics(const rw_scene* scene, rw_scene_statistics* statistics) {
    return guard([&] {
        const Scene& s = *required(scene, "scene").value;
        const Tracer& tracer = s.tracer();
        const Primitives& primitives = tracer.primitives();
        rw_scene_statistics facts{};
        facts.geometry_count = static_cast<std::uint32_t>(primitives.meshes().size());
        facts.triangle_count = primitives.count();
        facts.degenerate_triangles = primitives.degenerate_count();
        facts.invalid_triangles = primitives.invalid_count();
        facts.structure = name_of(s.plan().chosen);
        facts.decide_ns = s.plan().decide_ns;
        facts.build_ns = s.plan().build_ns;
        facts.structure_bytes = s.plan().bytes;
        facts.geometry_bytes = s.geometry_bytes();
        facts.rays = tracer.usage().rays.load(std::memory_order_relaxed);
        facts.invalid_rays = tracer.usage().invalid_rays.load(std::memory_order_relaxed);
        facts.rays_ns = static_cast<double>(tracer.usage().batch_ns.load(std::memory_order_relaxed));
        facts.refits = s.plan().refit ? s.plan().refit->refits : 0;
        write_struct(statistics, "statistics", facts);
    });
}

std::int32_t rw_scene_get_grid_statistics(const rw_scene* scene, rw_grid_statistics* statistics) {
    return guard([&] {
        const Scene& s = *required(scene, "scene").value;
        const auto* grid = dynamic_cast<const UniformGrid*>(&s.tracer().accel());
        if (grid == nullptr) {
            throw Error(Status::ERROR_WRONG_STRUCTURE,
                        std::string("scene: its structure is ") + name_of(s.plan().chosen) + ", not uniform_grid");
        }
        const GridStatistics& g = grid->statistics();
        rw_grid_statistics facts{};
        for (int axis = 0; axis < 3; ++axis) facts.resolution[axis] = static_cast<std::uint32_t>(g.resolution[axis]);
        facts.cells = g.cells;
        facts.empty_cells = g.empty_cells;
        facts.references = g.references;
        facts.max_references = g.max_references;
        facts.sparseness = g.sparseness;
        facts.mean = g.mean;
        facts.variance = g.variance;
        facts.standard_deviation = g.standard_deviation;
        facts.skewness = g.skewness;
        facts.kurtosis = g.kurtosis;
        write_struct(statistics, "statistics", facts);
    });
}

} // extern "C"
