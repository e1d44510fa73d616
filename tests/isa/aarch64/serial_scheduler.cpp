// Stands in for src/base/scheduler.cpp where there is no build of oneTBB for the other processor: no threads are to be had, and
// callers then do the work themselves.
#include "base/scheduler.h"

namespace raywise {

void run_on_threads(unsigned, std::uint64_t, void (*)(void*) noexcept, void*) noexcept {}

} // namespace raywise
