// Tells the thread sanitizer what it cannot see: that one thread's work comes before another's. Nothing in other builds.
#pragma once

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace raywise {

// All that was done before hand_over(mark) comes before all that is done after a take_over(mark) that follows it.
#ifdef __SANITIZE_THREAD__
inline void hand_over(void* mark) { __tsan_release(mark); }
inline void take_over(void* mark) { __tsan_acquire(mark); }
#else
inline void hand_over(void*) {}
inline void take_over(void*) {}
#endif

} // namespace raywise
