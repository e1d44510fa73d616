// The far end of peer_process.h: answers requests with a library of this process until there are no more.
#pragma once

#include "contract/library.h"

#include <string>

namespace raywise::contract {

// version: as the report shows it. Reads from one descriptor and writes to the other. Throws std::runtime_error for a
// message that is none.
void serve(Library& library, const std::string& version, int from, int to);

} // namespace raywise::contract
