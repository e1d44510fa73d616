#include "convert.h"

#include "guard.h"

#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

namespace raywise::capi {
namespace {

Error bad_argument(const std::string& message) { return {Status::ERROR_INVALID_ARGUMENT, message}; }
Error bad_strides(const std::string& message) { return {Status::ERROR_OVERLAP, message}; }

// The type an array has, 0 standing for the usual one. `allowed` lists what the place takes, the usual one first.
Scalar read_type(std::int32_t type, std::initializer_list<std::int32_t> allowed, const ArgumentName& name) {
    const std::int32_t actual = type == RW_TYPE_DEFAULT ? *allowed.begin() : type;
    if (std::find(allowed.begin(), allowed.end(), actual) == allowed.end()) {
        throw bad_argument(name.text() + ": type " + std::to_string(type) + " has no meaning here");
    }
    switch (actual) {
        case RW_FLOAT32:
            return Scalar::float32;
        case RW_FLOAT64:
            return Scalar::float64;
        case RW_UINT8:
            return Scalar::uint8;
        case RW_UINT32:
            return Scalar::uint32;
        default:
            return Scalar::uint64;
    }
}

struct Strides {
    std::ptrdiff_t stride;
    std::ptrdiff_t component_stride;
};

Strides read_strides(std::int64_t stride, std::int64_t component_stride, Scalar scalar, int components) {
    const auto size = static_cast<std::ptrdiff_t>(size_of(scalar));
    return {stride == RW_REPEAT ? 0
            : stride == 0       ? components * size
                                : static_cast<std::ptrdiff_t>(stride),
            component_stride == 0 ? size : static_cast<std::ptrdiff_t>(component_stride)};
}

// Whether two numbers of an array of `count` elements share a byte. Two of them are Elements * stride + Components *
// component_stride bytes apart; for each difference of components only the nearest differences of elements can be too small.
bool overlaps(const Strides& strides, std::size_t scalar_size, std::uint64_t count, int components) {
    const auto size =
        static_cast<double>(scalar_size); // doubles hold strides of any sensible array exactly, and cannot overflow
    const auto stride = static_cast<double>(strides.stride);
    for (int difference = 0; difference < components; ++difference) {
        const double apart = difference * static_cast<double>(strides.component_stride);
        if (difference > 0 && std::fabs(apart) < size) return true;
        if (count < 2) continue;
        if (stride == 0.0) return true;
        const double nearest = std::floor(-apart / stride);
        for (const double elements : {nearest, nearest + 1.0, -1.0, 1.0}) {
            if (elements == 0.0 || std::fabs(elements) > static_cast<double>(count - 1)) continue;
            if (std::fabs(elements * stride + apart) < size) return true;
        }
    }
    return false;
}

} // namespace

void read_reserved(std::int32_t reserved, const ArgumentName& name) {
    if (reserved != 0)
        throw Error(Status::ERROR_RESERVED, name.text() + ".reserved: it is " + std::to_string(reserved) + ", not 0");
}

StridedArray read_array(const rw_array& array, std::uint64_t count, int components, Elements elements, bool required,
                        const ArgumentName& name) {
    read_reserved(array.reserved, name);
    if (array.data == nullptr) {
        if (required && count > 0)
            throw bad_argument(name.text() + ": data is NULL for " + std::to_string(count) + " elements");
        return {};
    }
    StridedArray result;
    result.scalar = elements == Elements::numbers ? read_type(array.type, {RW_FLOAT32, RW_FLOAT64}, name)
                                                  : read_type(array.type, {RW_UINT32, RW_UINT64}, name);
    const Strides strides = read_strides(array.stride, array.component_stride, result.scalar, components);
    result.data = static_cast<const std::byte*>(array.data);
    result.stride = strides.stride;
    result.component_stride = strides.component_stride;
    return result;
}

OutputArray read_output(const rw_output& output, std::uint64_t count, int components, OutputKind kind,
                        const ArgumentName& name) {
    read_reserved(output.reserved, name);
    if (output.data == nullptr) return {};
    OutputArray result;
    result.scalar = kind == OutputKind::numbers ? read_type(output.type, {RW_FLOAT32, RW_FLOAT64}, name)
                    : kind == OutputKind::ids   ? read_type(output.type, {RW_UINT32, RW_UINT64}, name)
                                                : read_type(output.type, {RW_UINT8, RW_UINT32, RW_UINT64}, name);
    const Strides strides = read_strides(output.stride, output.component_stride, result.scalar, components);
    if (output.stride == RW_REPEAT)
        throw bad_strides(name.text() + ": RW_REPEAT would write every answer to one place");
    if (overlaps(strides, size_of(result.scalar), count, components))
        throw bad_strides(name.text() + ": its strides let elements overlap");
    result.data = static_cast<std::byte*>(output.data);
    result.stride = strides.stride;
    result.component_stride = strides.component_stride;
    return result;
}

TriangleArrays read_triangles(const rw_triangles& triangles, const std::string& name) {
    if ((triangles.flags & ~(RW_TRIANGLES_SHARED | RW_TRIANGLES_SKIP_INVALID)) != 0) {
        throw bad_argument(name + ": flags " + std::to_string(triangles.flags) + " has an unknown bit");
    }
    TriangleArrays arrays;
    arrays.vertex_count = triangles.vertex_count;
    arrays.triangle_count = triangles.triangle_count;
    arrays.vertices =
        read_array(triangles.vertices, triangles.vertex_count, 3, Elements::numbers, true, {name.c_str(), ".vertices"});
    arrays.indices = read_array(triangles.indices, triangles.triangle_count, 3, Elements::indices, false,
                                {name.c_str(), ".indices"});
    return arrays;
}

RayArrays read_rays(const rw_rays* source, const char* name) {
    const rw_rays rays = read_struct(source, name);
    if (rays.flags != 0)
        throw bad_argument(std::string(name) + ".flags: " + std::to_string(rays.flags) + " has an unknown bit");
    if (rays.count > RW_RAYS_LIMIT) {
        throw Error(Status::ERROR_TOO_MANY, std::string(name) + ".count: " + std::to_string(rays.count) + " is above " +
                                                std::to_string(RW_RAYS_LIMIT));
    }
    RayArrays arrays;
    arrays.count = rays.count;
    arrays.origin = read_array(rays.origin, rays.count, 3, Elements::numbers, true, {name, ".origin"});
    arrays.direction = read_array(rays.direction, rays.count, 3, Elements::numbers, true, {name, ".direction"});
    arrays.tmin = read_array(rays.tmin, rays.count, 1, Elements::numbers, false, {name, ".tmin"});
    arrays.tmax = read_array(rays.tmax, rays.count, 1, Elements::numbers, false, {name, ".tmax"});
    arrays.skip.primitive =
        read_array(rays.skip_primitive, rays.count, 1, Elements::indices, false, {name, ".skip_primitive"});
    arrays.skip.geometry =
        read_array(rays.skip_geometry, rays.count, 1, Elements::indices, false, {name, ".skip_geometry"});
    arrays.skip.offsets = {reinterpret_cast<const std::byte*>(rays.skip_offsets), sizeof(std::uint64_t),
                           sizeof(std::uint64_t), Scalar::uint64};
    if (!arrays.skip.wanted() && (arrays.skip.geometry.data != nullptr || arrays.skip.offsets.data != nullptr))
        throw bad_argument(std::string(name) +
                           ".skip_primitive: data is NULL, but skip_geometry or skip_offsets is not");
    return arrays;
}

HitArrays read_hits(const rw_hits* source, std::uint64_t count) {
    const rw_hits hits = read_struct(source, "hits");
    if (hits.flags != 0) throw bad_argument("hits.flags: " + std::to_string(hits.flags) + " has an unknown bit");
    HitArrays arrays;
    arrays.t = read_output(hits.t, count, 1, OutputKind::numbers, "hits.t");
    arrays.uv = read_output(hits.uv, count, 2, OutputKind::numbers, "hits.uv");
    arrays.normal = read_output(hits.normal, count, 3, OutputKind::numbers, "hits.normal");
    arrays.instance = read_output(hits.instance, count, 1, OutputKind::ids, "hits.instance");
    arrays.geometry = read_output(hits.geometry, count, 1, OutputKind::ids, "hits.geometry");
    arrays.primitive = read_output(hits.primitive, count, 1, OutputKind::ids, "hits.primitive");
    return arrays;
}

std::uint32_t number_of(const rw_primitive_id& id, const Primitives& primitives, const char* where,
                        std::uint64_t index) {
    if (id.instance != RW_INVALID_ID) {
        throw Error(Status::ERROR_INDEX_OUT_OF_RANGE, SkipEntry::place(where, index) + ": instance " +
                                                          std::to_string(id.instance) +
                                                          " is out of range, the scene has no instances");
    }
    return SkipEntry{id.geometry, id.primitive}.number(primitives, where, index);
}

std::vector<std::uint32_t> read_skips(const rw_ray_options& source, const Primitives& primitives) {
    const rw_ray_options options = read_struct(&source, "options");
    if (options.skip_count > 0 && options.skip == nullptr) throw null_argument("options.skip");
    std::vector<std::uint32_t> numbers;
    numbers.reserve(options.skip_count);
    for (std::uint32_t i = 0; i < options.skip_count; ++i) {
        const rw_primitive_id& id = options.skip[i];
        if (id.primitive != RW_INVALID_ID) numbers.push_back(number_of(id, primitives, "options.skip", i));
    }
    return numbers;
}

Workload read_workload(std::uint64_t count, std::int32_t kind, const char* name) {
    if (kind < RW_RAYS_ANY_KIND || kind > RW_RAYS_DIFFUSE) {
        throw bad_argument(std::string(name) + ".kind: " + std::to_string(kind) + " is no kind of rays");
    }
    Workload workload;
    workload.kind = static_cast<RayKind>(kind);
    if (count == RW_RAYS_UNKNOWN) return workload;
    if (count == 0 || count > RW_RAYS_LIMIT) {
        throw Error(Status::ERROR_RAY_COUNT, std::string(name) + ".count: " + std::to_string(count) +
                                                 " is not between 1 and " + std::to_string(RW_RAYS_LIMIT) +
                                                 "; RW_RAYS_UNKNOWN says that nobody knows");
    }
    workload.rays = count;
    return workload;
}

std::optional<Structure> read_structure(const char* name) {
    if (name == nullptr) return std::nullopt;
    const std::optional<Structure> structure = structure_named(name);
    if (structure) return structure;
    std::string known;
    for (const char* each : structure_names) known += (known.empty() ? "" : ", ") + std::string(each);
    throw Error(Status::ERROR_UNKNOWN_STRUCTURE,
                "structure: there is none named \"" + std::string(name, strnlen(name, 64)) + "\"; there are " + known);
}

Parallel read_parallel(std::uint32_t threads, rw_parallel_for parallel_for, void* user) {
    if (parallel_for == nullptr) return Parallel(threads);
    return Parallel(threads, [parallel_for, user](std::uint64_t count, const Parallel::Task& task) {
        const rw_task call = [](void* data, std::uint64_t index) {
            (*static_cast<const Parallel::Task*>(data))(index);
        };
        parallel_for(user, count, call, const_cast<Parallel::Task*>(&task));
    });
}

Progress::Callback read_progress(rw_progress progress, void* user) {
    if (progress == nullptr) return {};
    return [progress, user](double fraction, const char* stage) { return progress(user, fraction, stage) != 0; };
}

BatchWatch read_watch(const rw_query_options& options) {
    if (reinterpret_cast<std::uintptr_t>(options.cancel) % alignof(std::int32_t) != 0)
        throw bad_argument("options.cancel: it is not aligned to 4 bytes, as an int32_t that threads share has to be");
    return {read_progress(options.progress, options.progress_user), options.cancel};
}

bool is_json(std::int32_t format) {
    if (format != RW_FORMAT_TEXT && format != RW_FORMAT_JSON)
        throw bad_argument("format: " + std::to_string(format) + " is no format");
    return format == RW_FORMAT_JSON;
}

std::int32_t write_text(const std::string& text, char* buffer, std::uint64_t capacity, std::uint64_t* needed) {
    if (buffer == nullptr && capacity > 0) throw null_argument("buffer");
    if (needed != nullptr) *needed = text.size() + 1;
    if (buffer == nullptr || capacity == 0) return RW_OK;
    const std::size_t copied = std::min<std::uint64_t>(text.size(), capacity - 1);
    std::memcpy(buffer, text.data(), copied);
    buffer[copied] = '\0';
    if (copied == text.size()) return RW_OK;
    throw Error(Status::ERROR_CAPACITY, "buffer: " + std::to_string(text.size() + 1) +
                                            " bytes are needed, capacity is " + std::to_string(capacity));
}

} // namespace raywise::capi
