#include "base/instruction_set.h"

// This file is read once for each target, and the kernel compiled for it: chosen like all others, it cannot say anything else than
// what they do.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/instruction_set.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

const char* name_kernel() { return hwy::TargetName(HWY_TARGET); }

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(name_kernel);

const char* instruction_set() { return HWY_DYNAMIC_DISPATCH(name_kernel)(); }

} // namespace raywise
#endif
