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
    GridOptions no_mailboxes;
    no_mailboxes.mailboxes = false;
    GridOptions boxes_alone;
    boxes_alone.overlap_test = OverlapTest::none;
    GridOptions all_tested;
    all_tested.overlap_test = OverlapTest::all;
    std::vector<SwitchRow> rows = {row("as it is", {}), row("without mailboxes", no_mailboxes),
                                   row("no overlap test", boxes_alone), row("overlap test of all", all_tested)};
    struct Density {
        const char* name;
        double cells_per_primitive;
    };
    for (const Density& density :
         {Density{"density 0.25", 0.25}, {"density 1", 1.0}, {"density 4", 4.0}, {"density 10", 10.0}}) {
        GridOptions options;
        options.density = density.cells_per_primitive;
        rows.push_back(row(density.name, options));
    }
    return rows;
}

} // namespace raywise::bench
