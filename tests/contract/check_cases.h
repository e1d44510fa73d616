// Puts the case files themselves before the exact judge: an expectation that exact arithmetic contradicts is a fault of the
// file, not of a library.
#pragma once

#include "contract/case_file.h"

#include <cstdint>
#include <string>
#include <vector>

namespace raywise::contract {

// One text per fault, with file and line; at most a few for each case.
std::vector<std::string> faults_of(const std::vector<Family>& families, std::uint64_t sweep_factor);

} // namespace raywise::contract
