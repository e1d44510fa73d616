// raywise before the cases, through its C ABI only.
#pragma once

#include "contract/library.h"

#include <memory>
#include <vector>

namespace raywise::contract {

// One for each of rw_structure_name, forced by name, and one that asks through views.
std::vector<std::unique_ptr<Library>> raywise_libraries();

} // namespace raywise::contract
