#include "bench/sections/section.h"

namespace raywise::bench {

const std::vector<Section>& sections() {
    static const std::vector<Section> all = {
        {"single", "rays one by one", measure_single, single_table},
        {"overhead", "what a call costs", measure_overhead, overhead_table},
        {"batch", "many rays at once", measure_batch, batch_table},
        {"build", "building", measure_build, build_table},
        {"memory", "bytes per triangle", measure_memory, memory_table},
        {"totals", "from cold to R answers", measure_totals, totals_table},
        {"linear_scan", "the linear scan", measure_linear_scan, linear_scan_table},
    };
    return all;
}

} // namespace raywise::bench
