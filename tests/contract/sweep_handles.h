// The library's handles, released by themselves, and its statuses as exceptions: the sweep has no use for a failed call.
#pragma once

#include "raywise/raywise.h"

#include <memory>
#include <stdexcept>
#include <string>

namespace raywise::sweep {

struct Releaser {
    void operator()(rw_scene* scene) const { rw_scene_release(scene); }
};
using SceneHandle = std::unique_ptr<rw_scene, Releaser>;

inline void must(std::int32_t status, const char* call) {
    if (status == RW_OK) return;
    throw std::runtime_error(std::string(call) + ": " + rw_status_text(status) + ": " + rw_last_error_message());
}

// A struct that begins with its size, all else zero.
template <class Struct>
Struct sized() {
    Struct made{};
    made.struct_size = sizeof made;
    return made;
}

} // namespace raywise::sweep
