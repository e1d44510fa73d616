// How a ray walks through a WideBvh: by the best vector instructions of the processor the program runs on (Highway's dispatch).
#pragma once

#include "accel/accel.h"
#include "accel/bvh/node.h"
#include "accel/collectors.h"

namespace raywise {

// As the functions of Accel. One on a primitive with several references is collected once for each.
PrimitiveHit trace_closest(const WideBvh& bvh, const Ray& ray, const Query& query);
PrimitiveHit trace_closest(const WideBvh& bvh, const RayF& ray, const Query& query);
bool trace_any(const WideBvh& bvh, const Ray& ray, const Query& query);
bool trace_any(const WideBvh& bvh, const RayF& ray, const Query& query);
void trace_all(const WideBvh& bvh, const Ray& ray, AllCollector& collector);
void trace_closest_many(const WideBvh& bvh, const RayPacket& rays, PrimitiveHit* hits, Scratch& scratch);
void trace_closest_many(const WideBvh& bvh, const RayPacketF& rays, PrimitiveHit* hits, Scratch& scratch);
void trace_any_many(const WideBvh& bvh, const RayPacket& rays, bool* found, Scratch& scratch);
void trace_any_many(const WideBvh& bvh, const RayPacketF& rays, bool* found, Scratch& scratch);

} // namespace raywise
