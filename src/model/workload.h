// What a scene will be asked, as far as costs depend on it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace raywise {

// How rays are spread; values as RW_RAYS_* in raywise.h.
enum class RayKind {
    any = 0,
    random = 1,
    camera = 2,
    shadow = 3,
    diffuse = 4
};

// The kinds that are measured. `any` is reckoned as random.
inline constexpr std::array measured_ray_kinds = {RayKind::random, RayKind::camera, RayKind::shadow, RayKind::diffuse};
inline constexpr std::array measured_ray_kind_names = {"random", "camera", "shadow", "diffuse"};

inline constexpr std::size_t ray_kind_index(RayKind kind) {
    return kind == RayKind::any ? 0 : static_cast<std::size_t>(kind) - 1;
}

struct Workload {
    std::optional<std::uint64_t> rays; // empty: unknown
    RayKind kind = RayKind::any;
};

} // namespace raywise
