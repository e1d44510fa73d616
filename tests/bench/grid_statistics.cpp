// bench_grid_statistics: how primitives are spread over the cells of uniform grids, beside what Havran and Sixta 1999 ("Comparison of
// Hierarchical Grids", Ray Tracing News 12, 1) published for scenes of the Standard Procedural Databases. docs/grid-statistics.md.
#include "accel/grid/uniform_grid.h"
#include "bench/scenes/nff.h"
#include "bench/table.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace raywise::bench {
namespace {

struct Published {
    const char* scene;
    const char* file;
    double density;
    std::array<std::uint32_t, 3> resolution;
    std::uint64_t empty_cells;
    std::uint64_t references;
    bool is_curved; // its primitives are spheres and cones, of which we have triangles
};

constexpr Published published[] = {
    {"balls", "balls-4.nff", 1, {46, 46, 3}, 4208, 10240, true},
    {"balls", "balls-4.nff", 10, {103, 103, 7}, 63393, 19966, true},
    {"gears", "gears-4.nff", 1, {32, 33, 9}, 6080, 39344, false},
    {"gears", "gears-4.nff", 10, {71, 71, 18}, 66531, 110029, false},
    {"mount", "mount.nff", 1, {20, 20, 20}, 6502, 21746, false},
    {"teapot", "teapot-12.nff", 1, {28, 29, 11}, 7226, 22982, false},
    {"tetra", "tetra.nff", 1, {16, 16, 16}, 3104, 12556, false},
    {"tree", "tree-11.nff", 1, {52, 52, 3}, 5400, 11102, true},
};

// References of the file's primitives: each once for a cell, in however many triangles it is cut.
std::uint64_t references_of(const UniformGrid& grid, const std::vector<std::uint32_t>& primitive_of) {
    std::uint64_t references = 0;
    std::vector<std::uint32_t> listed;
    for (std::uint64_t cell = 0; cell < grid.lattice().number_count; ++cell) {
        listed.clear();
        for (std::uint64_t i = grid.lists().offset(cell); i < grid.lists().offset(cell + 1); ++i)
            listed.push_back(primitive_of[grid.lists().references[i]]);
        std::sort(listed.begin(), listed.end());
        references += static_cast<std::uint64_t>(std::unique(listed.begin(), listed.end()) - listed.begin());
    }
    return references;
}

void run(const std::string& folder) {
    Table table(
        "Uniform grids at the resolutions of Havran and Sixta: ours, and theirs in brackets; eq. 1 to 6 of Hapala, "
        "Karlik and "
        "Havran 2011\nover the triangles",
        {"scene", "D", "cells", "empty cells", "references", "sparseness", "largest", "mean", "deviation", "skewness",
         "kurtosis"});
    for (const Published& row : published) {
        const std::string path = folder + "/" + row.file;
        if (!std::filesystem::exists(path)) {
            std::printf("left out: there is no %s\n", path.c_str());
            continue;
        }
        std::vector<std::uint32_t> primitive_of;
        const workloads::Mesh mesh = load_nff(path, &primitive_of);
        TriangleArrays arrays;
        arrays.vertices = {reinterpret_cast<const std::byte*>(mesh.vertices.data()), 12, 4, Scalar::float32};
        arrays.vertex_count = mesh.vertex_count();
        arrays.indices = {reinterpret_cast<const std::byte*>(mesh.indices.data()), 12, 4, Scalar::uint32};
        arrays.triangle_count = mesh.triangle_count();
        const Primitives primitives({std::make_shared<const TriangleMesh>(arrays, false, false)});
        const Parallel parallel(1);
        Progress progress;
        GridOptions options;
        options.resolution = row.resolution;
        options.overlap_test = OverlapTest::none; // theirs are met best so
        options.gather = false;
        const UniformGrid grid({primitives, {}, {}, parallel, progress}, options);
        const GridStatistics statistics = grid.statistics();
        const auto beside = [](std::uint64_t ours, std::uint64_t theirs) {
            return with_commas(ours) + " (" + with_commas(theirs) + ")";
        };
        const std::uint64_t references = references_of(grid, primitive_of);
        table.add({std::string(row.scene) + (row.is_curved ? "*" : ""), digits(row.density),
                   with_commas(statistics.cells), beside(statistics.empty_cells, row.empty_cells),
                   beside(references, row.references), digits(statistics.sparseness),
                   with_commas(statistics.max_references), digits(statistics.mean),
                   digits(statistics.standard_deviation), digits(statistics.skewness), digits(statistics.kurtosis)});
    }
    std::fputs(table.text().c_str(), stdout);
    std::printf("* spheres and cones are cut into triangles here, and curved there\n");
}

} // namespace
} // namespace raywise::bench

int main(int argc, char** argv) {
    CLI::App app("Statistics of uniform grids beside published ones.");
    std::string folder;
    app.add_option("--spd", folder, "folder with NFF scenes")->required()->type_name("FOLDER");
    CLI11_PARSE(app, argc, argv);
    try {
        raywise::bench::run(folder);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_grid_statistics: %s\n", error.what());
        return 1;
    }
    return 0;
}
