// Which candidate to take. The whole policy of the default rule; see hapala_rule.h for the published one.
#pragma once

#include "base/structure.h"
#include "model/cost_functions.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace raywise {

struct Candidate {
    Structure structure;
    Cost cost;
    bool eligible = true; // fits the memory limit and has a meaning here
};

// The index of the eligible candidate with the smallest total for so many rays; the earlier of equals. With an unknown
// number of rays: the one whose worst ratio to the best total, over 100, 1,000, ... 10^8 rays, is smallest.
// Empty when none is eligible.
std::optional<std::size_t> decide(const std::vector<Candidate>& candidates, std::optional<std::uint64_t> rays);

// The smallest number of rays from which `other` has a smaller total than `chosen`: infinite when never, 0 when always.
double break_even_rays(const Cost& chosen, const Cost& other);

} // namespace raywise
