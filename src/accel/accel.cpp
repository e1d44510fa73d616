#include "accel/accel.h"

namespace raywise {

void Accel::closest_many(const RayPacket& rays, PrimitiveHit* hits, Scratch&) const {
    for (std::size_t i = 0; i < rays.count; ++i) hits[i] = closest(rays.rays[i], rays.query(i));
}

void Accel::any_many(const RayPacket& rays, bool* found, Scratch&) const {
    for (std::size_t i = 0; i < rays.count; ++i) found[i] = any(rays.rays[i], rays.query(i));
}

void Accel::closest_many_f32(const RayPacketF& rays, PrimitiveHit* hits, Scratch&) const {
    for (std::size_t i = 0; i < rays.count; ++i) hits[i] = closest_f32(rays.rays[i], rays.query(i));
}

void Accel::any_many_f32(const RayPacketF& rays, bool* found, Scratch&) const {
    for (std::size_t i = 0; i < rays.count; ++i) found[i] = any_f32(rays.rays[i], rays.query(i));
}

} // namespace raywise
