#include "bench/sections/section.h"

namespace raywise::bench {

const std::vector<Section>& sections() {
    static const std::vector<Section> all = {
        {"single", "rays one by one", measure_single, single_table, true},
        {"hit_counts", "hits, counted", measure_hit_counts, hit_counts_table, true},
        {"overhead", "what a call costs", measure_overhead, overhead_table, false},
        {"batch", "many rays at once", measure_batch, batch_table, false},
        {"build", "building", measure_build, build_table, false},
        {"memory", "bytes per triangle", measure_memory, memory_table, false},
        {"totals", "from cold to R answers", measure_totals, totals_table, false},
        {"regret", "what the choice costs", measure_regret, regret_table, false},
        {"frames", "moved, renewed and asked", measure_frames, frames_table, false},
        {"linear_scan", "the linear scan", measure_linear_scan, linear_scan_table, false},
        {"structures", "our structures beside each other", measure_structures, structures_table, false},
        {"switches", "the switches of the lectures", measure_switches, switches_table, false},
    };
    return all;
}

} // namespace raywise::bench
