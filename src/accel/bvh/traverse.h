// How a ray walks through a WideBvh: by the best vector instructions of the processor the program runs on (Highway's dispatch).
#pragma once

#include "accel/accel.h"
#include "accel/bvh/node.h"
#include "accel/collectors.h"

namespace raywise {

// As the functions of Accel. One on a primitive with several references is collected once for each.
void trace_closest(const WideBvh& bvh, const Ray& ray, ClosestCollector& collector);
void trace_any(const WideBvh& bvh, const Ray& ray, AnyCollector& collector);
void trace_all(const WideBvh& bvh, const Ray& ray, AllCollector& collector);
void trace_closest_many(const WideBvh& bvh, const RayPacket& rays, PrimitiveHit* hits, Scratch& scratch);
void trace_any_many(const WideBvh& bvh, const RayPacket& rays, bool* found, Scratch& scratch);

} // namespace raywise
