// The builder of kd-trees.
#pragma once

#include "accel/accel.h"
#include "accel/kdtree/build/binary_tree.h"
#include "accel/kdtree/options.h"

namespace raywise {

// Splits from above by the surface area heuristic: large nodes by bins (item_builder.h), in parts that are built apart from each other, and
// small ones at the best of all planes (event_builder.h). The same tree for any number of threads. Progress is reported from 0 to
// `progress_end`.
KdTreeData build_kd_tree(const BuildInput& input, const KdTreeOptions& options = {}, double progress_end = 1.0);

} // namespace raywise
