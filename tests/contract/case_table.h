// Results as text: a table of families by libraries, then what failed. Fits 100 columns.
#pragma once

#include "contract/run_cases.h"

#include <string>
#include <vector>

namespace raywise::contract {

std::string table_of(const std::vector<LibraryResult>& results);

} // namespace raywise::contract
