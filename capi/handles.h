// The opaque handles: a count of references around the C++ object.
#pragma once

#include "base/error.h"
#include "batch/batch_workspace.h"
#include "io/mesh_file.h"
#include "model/profile.h"
#include "raywise/raywise.h"
#include "scene/scene.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace raywise::capi {

template <class T>
struct Handle {
    explicit Handle(std::shared_ptr<T> object) : value(std::move(object)) {}
    std::shared_ptr<T> value;
    mutable std::atomic<std::uint64_t> references{1};
};

inline Error null_argument(const char* name) {
    return {Status::ERROR_INVALID_ARGUMENT, std::string(name) + ": it is NULL"};
}

// The argument of that name, or an error when it is NULL.
template <class T>
T& required(T* pointer, const char* name) {
    if (pointer == nullptr) throw null_argument(name);
    return *pointer;
}

template <class H>
void retain(const H* handle, const char* name) {
    required(handle, name).references.fetch_add(1, std::memory_order_relaxed);
}

template <class H>
void release(const H* handle) {
    if (handle != nullptr && handle->references.fetch_sub(1, std::memory_order_acq_rel) == 1) delete handle;
}

} // namespace raywise::capi

struct rw_profile : raywise::capi::Handle<const raywise::Profile> {
    explicit rw_profile(std::shared_ptr<const raywise::Profile> profile)
        : Handle(std::move(profile)),
          machine_key(value->source == raywise::ProfileSource::generic ? "generic" : value->machine.key()) {}
    std::string machine_key;
};
struct rw_mesh : raywise::capi::Handle<const raywise::LoadedMesh> {
    using Handle::Handle;
};
struct rw_batch_workspace {
    raywise::BatchWorkspace value;
};
struct rw_scene : raywise::capi::Handle<raywise::Scene> {
    using Handle::Handle;
};
