// How a ray walks through a WideBvh: by the best vector instructions of the processor the program runs on (Highway's dispatch).
#pragma once

#include "accel/accel.h"
#include "accel/bvh/node.h"
#include "accel/ray_kernels.h"

namespace raywise {

// A hit on a primitive with several references is collected once for each.
RW_DECLARE_RAY_KERNELS(WideBvh);

// As the functions of Accel.
void trace_closest_many(const WideBvh& bvh, const RayPacket& rays, PrimitiveHit* hits, Scratch& scratch);
void trace_closest_many(const WideBvh& bvh, const RayPacketF& rays, PrimitiveHit* hits, Scratch& scratch);
void trace_any_many(const WideBvh& bvh, const RayPacket& rays, bool* found, Scratch& scratch);
void trace_any_many(const WideBvh& bvh, const RayPacketF& rays, bool* found, Scratch& scratch);

} // namespace raywise
