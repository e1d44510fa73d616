// Highway's dispatch for kernels that are called for each ray. HWY_DYNAMIC_DISPATCH asks the shared library of Highway which target was chosen;
// that is a call through two tables. Here its answer's place is kept.
#pragma once

#include <hwy/highway.h>

#if HWY_IDE || ((HWY_TARGETS & (HWY_TARGETS - 1)) == 0) // one target, and no library of Highway

#define RW_DISPATCH(kernel) HWY_DYNAMIC_DISPATCH(kernel)

#else

#include <hwy/targets.h>

namespace raywise {

// Found when the library is loaded.
inline const hwy::ChosenTarget& chosen_target = hwy::GetChosenTarget();

} // namespace raywise

#define RW_DISPATCH(kernel) (HWY_DISPATCH_TABLE(kernel)[raywise::chosen_target.GetIndex()])

#endif
