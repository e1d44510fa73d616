#include "bench/sections/switches.h"

#include "accel/grid/uniform_grid.h"

namespace raywise::bench {
namespace {

SwitchRow row(const char* name, const GridOptions& options) {
    return {"uniform_grid", name,
            [options](const BuildInput& input) { return std::make_unique<UniformGrid>(input, options); }};
}

} // namespace

std::vector<SwitchRow> grid_switches() {
    GridOptions lists; // those of the lectures; the library gathers corners for as many rays
    lists.gather = false;
    lists.density = 1.0;
    std::vector<SwitchRow> rows = {row("as it is", {}), row("lists, density 1", lists)};
    GridOptions changed = lists;
    changed.mailboxes = false;
    rows.push_back(row("lists, without mailboxes", changed));
    changed = lists;
    changed.overlap_test = OverlapTest::none;
    rows.push_back(row("lists, no overlap test", changed));
    changed.overlap_test = OverlapTest::all;
    rows.push_back(row("lists, all tested", changed));
    struct Density {
        const char* lists;
        const char* corners;
        double cells_per_primitive;
    };
    constexpr Density densities[] = {{"lists, density 0.25", "corners, density 0.25", 0.25},
                                     {"lists, density 0.5", "corners, density 0.5", 0.5},
                                     {"lists, density 4", "corners, density 4", 4.0},
                                     {"lists, density 10", "corners, density 10", 10.0}};
    for (const Density& density : densities) {
        changed = lists;
        changed.density = density.cells_per_primitive;
        rows.push_back(row(density.lists, changed));
        changed.gather = true;
        rows.push_back(row(density.corners, changed));
    }
    return rows;
}

} // namespace raywise::bench
