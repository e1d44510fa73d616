#include "io/mesh_file.h"

#include "base/error.h"
#include "geometry/polygon_triangles.h"
#include "io/file_kind.h"
#include "io/openmesh_reader.h"

#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace raywise {
namespace {

using namespace io;

// Cuts faces into triangles.
class FaceTriangles {
public:
    FaceTriangles(LoadedMesh& mesh, std::uint64_t vertex_count) : mesh_(mesh), vertex_count_(vertex_count) {}

    void add(std::uint32_t face, const std::uint32_t* corners, std::size_t count) {
        if (count < 3) throw Error(Status::ERROR_BAD_POLYGON, bad_polygon(face, static_cast<std::int64_t>(count)));
        for (std::size_t i = 0; i < count; ++i) {
            if (corners[i] < vertex_count_) continue;
            throw Error(Status::ERROR_INDEX_OUT_OF_RANGE, bad_index(face, std::to_string(corners[i]), vertex_count_));
        }
        if (mesh_.triangle_count() + count - 2 >= std::numeric_limits<std::uint32_t>::max())
            throw Error(Status::ERROR_TOO_MANY, too_many("triangles"));
        polygon_.clear();
        for (std::size_t i = 0; i < count; ++i) polygon_.push_back(mesh_.vertex(corners[i]));
        for (const CornerTriple& triangle : cutter_.cut(polygon_)) {
            for (const std::uint32_t position : triangle) mesh_.indices.push_back(corners[position]);
            mesh_.face_of_triangle.push_back(face);
        }
    }

private:
    LoadedMesh& mesh_;
    std::uint64_t vertex_count_;
    PolygonTriangles cutter_;
    std::vector<Vec3> polygon_;
};

// OpenMesh's reader of such files would merge corners that are near each other and drop facets.
LoadedMesh assemble_facets(FileMesh file) {
    LoadedMesh mesh;
    mesh.face_count = static_cast<std::uint32_t>(file.face_count());
    mesh.indices.resize(file.vertex_count());
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
    mesh.face_of_triangle.resize(mesh.face_count);
    std::iota(mesh.face_of_triangle.begin(), mesh.face_of_triangle.end(), 0u);
    std::vector<double> coordinates = file.take_coordinates();
    if (file.fits_float32()) {
        mesh.vertices = std::vector<float>(coordinates.begin(), coordinates.end());
    } else {
        mesh.vertices = std::move(coordinates);
    }
    return mesh;
}

LoadedMesh assemble_polygons(FileMesh file) {
    RawMesh raw = read_with_openmesh(file.take_ply());
    if (raw.vertices.size() != file.coordinates().size() || raw.face_count() != file.face_count()) {
        throw Error(Status::ERROR_FILE_FORMAT,
                    "the file has " + std::to_string(file.vertex_count()) + " vertices and " +
                        std::to_string(file.face_count()) + " faces, but OpenMesh found " +
                        std::to_string(raw.vertices.size() / 3) + " and " + std::to_string(raw.face_count()));
    }
    LoadedMesh mesh;
    mesh.face_count = static_cast<std::uint32_t>(file.face_count());
    if (file.fits_float32()) {
        mesh.vertices = std::move(raw.vertices);
    } else {
        mesh.vertices = file.take_coordinates();
    }
    FaceTriangles triangles(mesh, mesh.vertex_count());
    for (std::uint32_t face = 0; face < mesh.face_count; ++face) {
        const std::size_t begin = face == 0 ? 0 : raw.face_ends[face - 1];
        triangles.add(face, raw.corners.data() + begin, raw.face_ends[face] - begin);
    }
    return mesh;
}

FileMesh read(const std::filesystem::path& path) {
    require_plain_file(path);
    const FormatReader reader = reader_of(path);
    const std::string bytes = read_file(path);
    if (bytes.empty()) throw Error(Status::ERROR_FILE_FORMAT, "the file is empty");
    FileMesh mesh = reader(bytes);
    if (mesh.face_count() == 0) throw Error(Status::ERROR_NO_FACES, "the file has no faces");
    return mesh;
}

} // namespace

LoadedMesh load_mesh(const std::filesystem::path& path) {
    try {
        FileMesh file = read(path);
        return file.has_facets() ? assemble_facets(std::move(file)) : assemble_polygons(std::move(file));
    } catch (const Error& error) {
        throw Error(error.status(), path.u8string() + ": " + error.what());
    }
}

} // namespace raywise
