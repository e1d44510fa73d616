// How a ray walks through a kd-tree: by the best vector instructions of the processor the program runs on (Highway's dispatch).
#pragma once

#include "accel/accel.h"
#include "accel/kdtree/treelets.h"
#include "accel/ray_kernels.h"

namespace raywise {

// A hit on a primitive is collected once for each leaf in which it is found.
RW_DECLARE_RAY_KERNELS(KdTreelets);

} // namespace raywise
