// Which vector instructions the kernels use.
#pragma once

namespace raywise {

// The level that they are dispatched to on this processor, by Highway's name: "AVX3" (AVX-512), "AVX2", "SSE4", "SCALAR",
// "NEON" ... What Highway is told to leave out (hwy::DisableTargets, HWY_DISABLED_TARGETS) is left out here as well.
const char* instruction_set();

} // namespace raywise
