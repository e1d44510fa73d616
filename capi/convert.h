// From the structs of the C ABI to the library's own, with every check a caller's mistake calls for. All throw Error.
#pragma once

#include "base/parallel.h"
#include "base/progress.h"
#include "batch/batch.h"
#include "geometry/triangle_mesh.h"
#include "handles.h"
#include "raywise/raywise.h"
#include "scene/tracer.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace raywise::capi {

// The size a struct had in the version before, what an older program passes: to be specialised for those that grow.
template <class T>
inline constexpr std::size_t previous_size = sizeof(T);
template <>
inline constexpr std::size_t previous_size<rw_commit_options> = offsetof(rw_commit_options, refit);
template <>
inline constexpr std::size_t previous_size<rw_query_options> = offsetof(rw_query_options, workspace);

// The struct_size of a struct that begins with one. A larger one, of a newer program, is fine as long as what this library does
// not know is zero.
template <class T>
std::uint32_t read_size(const T* source, const char* name) {
    std::uint32_t size = 0;
    std::memcpy(&size, &required(source, name), sizeof size);
    if ((size < sizeof(T) && size != previous_size<T>) || size > 4096) {
        throw Error(Status::ERROR_INVALID_ARGUMENT, std::string(name) + ": struct_size is " + std::to_string(size) +
                                                        ", it should be " + std::to_string(sizeof(T)));
    }
    const auto* bytes = reinterpret_cast<const unsigned char*>(source);
    if (size > sizeof(T) &&
        std::any_of(bytes + sizeof(T), bytes + size, [](unsigned char byte) { return byte != 0; })) {
        throw Error(Status::ERROR_INVALID_ARGUMENT,
                    std::string(name) + ": it sets a member that this version of the library does not know");
    }
    return size;
}

// Reads such a struct; members that its program did not know are zero.
template <class T>
T read_struct(const T* source, const char* name) {
    const std::uint32_t size = read_size(source, name);
    T copy{};
    std::memcpy(&copy, source, std::min<std::size_t>(size, sizeof copy));
    return copy;
}

// The same for a struct that may be absent: all zero then.
template <class T>
T read_optional_struct(const T* source, const char* name) {
    if (source != nullptr) return read_struct(source, name);
    T defaults{};
    defaults.struct_size = sizeof defaults;
    return defaults;
}

// Hands a result struct out, as much of it as the caller knows, keeping the caller's struct_size.
template <class T>
void write_struct(T* target, const char* name, T value) {
    value.struct_size = read_size(target, name);
    std::memcpy(target, &value, std::min<std::size_t>(value.struct_size, sizeof value));
}

// What an argument is called in messages, put together only where there is one.
class ArgumentName {
public:
    ArgumentName(const char* name) : owner_(""), member_(name) {} // NOLINT: a name is one
    // owner and member: outlive it.
    ArgumentName(const char* owner, const char* member) : owner_(owner), member_(member) {}

    std::string text() const { return std::string(owner_) + member_; }

private:
    const char* owner_;
    const char* member_; // with the dot
};

// A member kept for later versions.
void read_reserved(std::int32_t reserved, const ArgumentName& name);

enum class Elements {
    numbers,
    indices
};

// components: 1, 2 or 3. required: whether data may be NULL.
StridedArray read_array(const rw_array& array, std::uint64_t count, int components, Elements elements, bool required,
                        const ArgumentName& name);

enum class OutputKind {
    numbers,
    ids,
    flags
};
OutputArray read_output(const rw_output& output, std::uint64_t count, int components, OutputKind kind,
                        const ArgumentName& name);

// NULL: the defaults. name: of the argument.
rw_commit_options read_commit_options(const rw_commit_options* options, const char* name);

// name: of the struct, in messages.
TriangleArrays read_triangles(const rw_triangles& triangles, const std::string& name = "triangles");
// Calls visit(mesh, name) for each of the caller's structs, which all have the size of the first.
template <class Visit>
void for_each_mesh(const rw_triangles* meshes, std::uint32_t mesh_count, const Visit& visit) {
    if (mesh_count > 0) required(meshes, "meshes");
    const auto* bytes = reinterpret_cast<const std::byte*>(meshes);
    for (std::uint32_t i = 0; i < mesh_count; ++i) {
        const std::string name = "meshes[" + std::to_string(i) + "]";
        // Elements are as far apart as the caller's struct is large, which a newer program's may be.
        const auto* element = reinterpret_cast<const rw_triangles*>(bytes + std::size_t{i} * meshes->struct_size);
        const rw_triangles mesh = read_struct(element, name.c_str());
        if (mesh.struct_size != meshes->struct_size) {
            throw Error(Status::ERROR_INVALID_ARGUMENT, name + ": struct_size differs from that of meshes[0]");
        }
        visit(mesh, name);
    }
}
RayArrays read_rays(const rw_rays* rays, const char* name);
HitArrays read_hits(const rw_hits* hits, std::uint64_t count);
// The caller's memory, seen as the library's own struct, which has the same members: eight numbers both. Not a copy, because loading
// 32 bytes that were just stored as two times 16 takes as long as waiting for the stores to end.
template <class To, class From>
const To& read_ray_as(const From* source) {
    static_assert(sizeof(To) == sizeof(From) && alignof(To) == alignof(From) &&
                  offsetof(To, tmin) == offsetof(From, tmin) && offsetof(To, direction) == offsetof(From, direction) &&
                  offsetof(To, tmax) == offsetof(From, tmax));
    return reinterpret_cast<const To&>(required(source, "ray"));
}
inline const Ray& read_ray(const rw_ray* source) { return read_ray_as<Ray>(source); }
inline const RayF& read_ray(const rw_ray_f32* source) { return read_ray_as<RayF>(source); }
// The numbers of what the ray skips, in the caller's order.
std::vector<std::uint32_t> read_skips(const rw_ray_options& options, const Primitives& primitives);
// The number of the primitive with those ids; errors name where[index].
std::uint32_t number_of(const rw_primitive_id& id, const Primitives& primitives, const char* where,
                        std::uint64_t index = SkipEntry::no_index);
inline void write_hit(const Hit& hit, rw_hit& out) {
    out.t = hit.t;
    out.u = hit.u;
    out.v = hit.v;
    out.instance = hit.instance;
    out.geometry = hit.geometry;
    out.primitive = hit.primitive;
    out.reserved = 0;
}
inline void write_hit(const Hit& hit, rw_hit_f32& out) {
    out.t = static_cast<float>(hit.t);
    out.u = static_cast<float>(hit.u);
    out.v = static_cast<float>(hit.v);
    out.instance = hit.instance;
    out.geometry = hit.geometry;
    out.primitive = hit.primitive;
}

Workload read_workload(std::uint64_t count, std::int32_t kind, const char* name);
std::optional<Structure> read_structure(const char* name);

Parallel read_parallel(std::uint32_t threads, rw_parallel_for parallel_for, void* user);
Progress::Callback read_progress(rw_progress progress, void* user);
BatchWatch read_watch(const rw_query_options& options);

// RW_FORMAT_JSON rather than RW_FORMAT_TEXT; anything else is an error.
bool is_json(std::int32_t format);

// Copies a text into the caller's buffer as rw_profile_text promises; returns the status.
std::int32_t write_text(const std::string& text, char* buffer, std::uint64_t capacity, std::uint64_t* needed);

} // namespace raywise::capi
