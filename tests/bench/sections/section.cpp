#include "bench/sections/section.h"

namespace raywise::bench {

const std::vector<Section>& sections() {
    static const std::vector<Section> all = {
        {"single", "rays one by one", measure_single, single_table},
        {"build", "building, one thread and all", measure_build, build_table},
    };
    return all;
}

} // namespace raywise::bench
