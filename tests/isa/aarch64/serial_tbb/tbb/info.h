// Stands in for oneTBB where there is no build of it for the other processor: one thread, which changes no answer.
#pragma once

namespace tbb::info {

inline int default_concurrency() { return 1; }

} // namespace tbb::info
