// Mesh files: the first byte picks the format (o OBJ, p PLY, f OFF, s STL; others by their number), the rest is the file.
// Whatever loads is what its reader promises, can be added to a scene, and is answered alike by all structures.
#include "fuzz/failure.h"
#include "fuzz/memory_file.h"
#include "fuzz/reference.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace raywise::fuzz {
namespace {

constexpr const char* endings[] = {".obj", ".ply", ".off", ".stl"};

const char* ending_of(std::uint8_t first) {
    constexpr char letters[] = {'o', 'p', 'f', 's'};
    for (std::size_t i = 0; i < 4; ++i) {
        if (first == static_cast<std::uint8_t>(letters[i])) return endings[i];
    }
    return endings[first % 4];
}

struct Arrays {
    rw_array vertices;
    const std::uint32_t* indices;
    std::uint64_t vertex_count;
    std::uint64_t triangle_count;

    // What stands at `i` among the coordinates.
    double coordinate(std::uint64_t i) const {
        return vertices.type == RW_FLOAT64 ? static_cast<const double*>(vertices.data)[i]
                                           : static_cast<double>(static_cast<const float*>(vertices.data)[i]);
    }
};

// Whether a scene takes the mesh, and float32 would change it; and whether both is what the library said.
bool check_coordinates(const Arrays& arrays) {
    constexpr double most = static_cast<double>(std::numeric_limits<float>::max());
    bool is_in_range = true;
    bool fits_float32 = true;
    for (std::uint64_t i = 0; i < 3 * arrays.vertex_count; ++i) {
        const double x = arrays.coordinate(i);
        demand(std::isfinite(x), "a mesh with a coordinate that is not finite");
        is_in_range = is_in_range && std::fabs(x) <= most;
        fits_float32 = fits_float32 && std::fabs(x) <= most && static_cast<double>(static_cast<float>(x)) == x;
    }
    demand(fits_float32 == (arrays.vertices.type == RW_FLOAT32), "a mesh of float64 that float32 would hold");
    return is_in_range;
}

Arrays check_mesh(const rw_mesh* mesh, std::size_t file_size) {
    rw_triangles t{};
    t.struct_size = sizeof t;
    Outcome("mesh_triangles").check(rw_mesh_triangles(mesh, &t));
    const Arrays arrays{t.vertices, static_cast<const std::uint32_t*>(t.indices.data), t.vertex_count,
                        t.triangle_count};
    demand(
        (t.vertices.type == RW_FLOAT32 || t.vertices.type == RW_FLOAT64) && t.indices.type == RW_UINT32 && t.flags == 0,
        "a mesh of another type");
    // Every vertex and every corner takes at least a byte of the file.
    demand(arrays.vertex_count <= file_size && arrays.triangle_count <= file_size, "a mesh larger than its file");
    for (std::uint64_t i = 0; i < 3 * arrays.triangle_count; ++i) {
        demand(arrays.indices[i] < arrays.vertex_count, "a mesh with an index out of range");
    }
    const std::uint32_t* faces = nullptr;
    std::uint64_t face_count = 0;
    Outcome("mesh_faces").check(rw_mesh_faces(mesh, &faces, &face_count));
    demand(face_count > 0 && arrays.triangle_count >= face_count,
           "a mesh of no faces, or one whose faces have no triangles");
    for (std::uint64_t i = 0; i < arrays.triangle_count; ++i) {
        const std::uint32_t before = i == 0 ? 0 : faces[i - 1];
        demand(i == 0 ? faces[i] == 0 : faces[i] == before || faces[i] == before + 1, "faces out of order");
    }
    demand(faces[arrays.triangle_count - 1] + 1 == face_count, "faces at the end without a triangle");
    return arrays;
}

// A scene that shares the mesh's memory, and one that copies it.
rw_scene* make_scene(const rw_mesh* mesh, const char* structure, std::uint32_t flags) {
    rw_triangles t{};
    t.struct_size = sizeof t;
    demand(rw_mesh_triangles(mesh, &t) == RW_OK, "a mesh could not be described twice");
    t.flags = flags;
    rw_scene* scene = nullptr;
    demand(rw_scene_create(nullptr, &scene) == RW_OK, "a scene could not be made");
    Outcome("add_triangles").check(rw_scene_add_triangles(scene, &t, nullptr));
    Outcome("set_structure").check(rw_scene_set_structure(scene, structure));
    Outcome("commit").check(rw_scene_commit(scene, nullptr));
    return scene;
}

// A file may hold numbers that no scene takes.
void refuse_range(const rw_mesh* mesh) {
    rw_triangles t{};
    t.struct_size = sizeof t;
    demand(rw_mesh_triangles(mesh, &t) == RW_OK, "a mesh could not be described twice");
    rw_scene* scene = nullptr;
    demand(rw_scene_create(nullptr, &scene) == RW_OK, "a scene could not be made");
    demand(rw_scene_add_triangles(scene, &t, nullptr) == RW_ERROR_COORDINATE_RANGE, "a mesh out of range was added");
    demand_printable_message();
    rw_scene_release(scene);
}

void compare(const rw_scene* judge, const rw_scene* scene, const char* structure, const rw_ray& ray) {
    rw_hit wanted;
    rw_hit found;
    Outcome("intersect").check(rw_scene_intersect(judge, &ray, nullptr, &wanted));
    Outcome("intersect").check(rw_scene_intersect(scene, &ray, nullptr, &found));
    if (std::memcmp(&wanted, &found, sizeof found) == 0) return;
    fail(
        "%s: the judge says t %a u %a v %a primitive %u, it says t %a u %a v %a primitive %u; ray {{%a, %a, %a}, %a, "
        "{%a, %a, %a}, %a}",
        structure, wanted.t, wanted.u, wanted.v, wanted.primitive, found.t, found.u, found.v, found.primitive,
        ray.origin[0], ray.origin[1], ray.origin[2], ray.tmin, ray.direction[0], ray.direction[1], ray.direction[2],
        ray.tmax);
}

// At the corners and the middles of the first triangles, along an axis and from the origin.
void ask(const rw_scene* judge, const rw_scene* scene, const char* structure, const Arrays& arrays) {
    constexpr std::uint64_t most_triangles = 8;
    for (std::uint64_t i = 0; i < std::min(arrays.triangle_count, most_triangles); ++i) {
        const std::uint32_t* corners = arrays.indices + 3 * i;
        for (int kind = 0; kind < 3; ++kind) {
            rw_ray along_axis{{0, 0, 0}, -INFINITY, {0, 0, 0}, INFINITY};
            rw_ray from_origin{{0, 0, 0}, 0, {0, 0, 0}, INFINITY};
            for (int axis = 0; axis < 3; ++axis) {
                double target = arrays.coordinate(3 * corners[0] + static_cast<unsigned>(axis));
                for (int corner = 1; corner <= kind; ++corner) {
                    target += arrays.coordinate(3 * corners[corner] + static_cast<unsigned>(axis));
                }
                target /= kind + 1;
                along_axis.origin[axis] = target;
                from_origin.direction[axis] = target;
            }
            along_axis.direction[i % 3] = 1.0;
            compare(judge, scene, structure, along_axis);
            compare(judge, scene, structure, from_origin);
        }
    }
}

void run(const char* ending, const std::uint8_t* data, std::size_t size) {
    static const MemoryFile file({std::begin(endings), std::end(endings)});
    file.write(data, size);
    rw_mesh* mesh = nullptr;
    const std::int32_t status = rw_mesh_load(file.path(ending).c_str(), &mesh);
    Outcome outcome("mesh_load");
    for (const std::int32_t each : {RW_ERROR_FILE_FORMAT, RW_ERROR_NO_FACES, RW_ERROR_BAD_POLYGON,
                                    RW_ERROR_INDEX_OUT_OF_RANGE, RW_ERROR_NOT_FINITE, RW_ERROR_TOO_MANY}) {
        outcome.may_fail_if(true, each);
    }
    const bool loaded = outcome.check(status);
    demand(loaded == (mesh != nullptr), "a mesh and an error, or neither");
    if (!loaded) {
        demand_printable_message();
        return;
    }

    const Arrays arrays = check_mesh(mesh, size);
    if (!check_coordinates(arrays)) {
        refuse_range(mesh);
        rw_mesh_release(mesh);
        return;
    }
    rw_scene* judge = make_scene(mesh, "linear_scan", RW_TRIANGLES_SHARED);
    for (const std::string& structure : structure_names()) {
        rw_scene* scene = make_scene(mesh, structure.c_str(), 0);
        ask(judge, scene, structure.c_str(), arrays);
        rw_scene_release(scene);
    }
    rw_scene_release(judge);
    rw_mesh_release(mesh);
}

} // namespace
} // namespace raywise::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    setenv("RAYWISE_CALIBRATION", "builtin", 1);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    raywise::fuzz::run(raywise::fuzz::ending_of(data[0]), data + 1, size - 1);
    return 0;
}
