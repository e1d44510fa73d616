// How a ray walks through a kd-tree: by the best vector instructions of the processor the program runs on (Highway's dispatch).
#pragma once

#include "accel/accel.h"
#include "accel/collectors.h"
#include "accel/kdtree/treelets.h"

namespace raywise {

// As the functions of Accel. A hit on a primitive is collected once for each leaf in which it is found.
PrimitiveHit trace_closest(const KdTreelets& tree, const Ray& ray, const Query& query);
PrimitiveHit trace_closest(const KdTreelets& tree, const RayF& ray, const Query& query);
bool trace_any(const KdTreelets& tree, const Ray& ray, const Query& query);
bool trace_any(const KdTreelets& tree, const RayF& ray, const Query& query);
void trace_all(const KdTreelets& tree, const Ray& ray, AllCollector& collector);

} // namespace raywise
