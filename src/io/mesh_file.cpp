#include "io/mesh_file.h"

#include "base/error.h"
#include "geometry/polygon_triangles.h"
#include "io/expected.h"
#include "io/file_kind.h"
#include "io/openmesh_reader.h"
#include "io/stl_file.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace raywise {
namespace {

using namespace io;

Expected prepare(FileKind kind, std::string& text) {
    switch (kind) {
        case FileKind::obj:
            return prepare_obj(text);
        case FileKind::off:
            return prepare_off(text);
        case FileKind::ply:
            return prepare_ply(text);
        case FileKind::stl:
            break;
    }
    throw Error(Status::ERROR_INTERNAL, "prepare: a kind of file without a reader");
}

// Cuts faces into triangles.
class FaceTriangles {
public:
    explicit FaceTriangles(LoadedMesh& mesh) : mesh_(mesh) {}

    template <class Index>
    void add(std::uint32_t face, const Index* corners, std::size_t count) {
        if (count < 3) fail_bad_polygon(face, count);
        for (std::size_t i = 0; i < count; ++i) {
            if (static_cast<std::uint64_t>(corners[i]) >= mesh_.vertex_count())
                fail_index(face, std::to_string(corners[i]), mesh_.vertex_count());
        }
        if (mesh_.triangle_count() + count - 2 >= std::numeric_limits<std::uint32_t>::max()) fail_too_many("triangles");
        polygon_.clear();
        for (std::size_t i = 0; i < count; ++i) polygon_.push_back(mesh_.vertex(static_cast<std::size_t>(corners[i])));
        for (const CornerTriple& triangle : cutter_.cut(polygon_)) {
            for (const std::uint32_t position : triangle) {
                mesh_.indices.push_back(static_cast<std::uint32_t>(corners[position]));
            }
            mesh_.face_of_triangle.push_back(face);
        }
    }

private:
    LoadedMesh& mesh_;
    PolygonTriangles cutter_;
    std::vector<Vec3> polygon_;
};

// Whether the OBJ reader hands a face on: it takes repeated corners out and wants three in the end.
bool is_delivered(const std::vector<std::uint32_t>& corners) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < corners.size() && different < 3; ++i) {
        std::size_t first = 0;
        while (corners[first] != corners[i]) ++first;
        if (first == i) ++different;
    }
    return different > 2;
}

LoadedMesh assemble(const Expected& expected, RawMesh raw) {
    std::size_t undelivered = 0;
    for (const RepeatedCorners& face : expected.repeated) undelivered += is_delivered(face.corners) ? 0 : 1;
    if (raw.vertices.size() != 3 * expected.vertices || raw.face_count() + undelivered != expected.faces) {
        throw Error(Status::ERROR_FILE_FORMAT, "the file has " + std::to_string(expected.vertices) + " vertices and " +
                                                   std::to_string(expected.faces) + " faces, but the reader found " +
                                                   std::to_string(raw.vertices.size() / 3) + " and " +
                                                   std::to_string(raw.face_count() + undelivered));
    }
    LoadedMesh mesh;
    mesh.vertices = std::move(raw.vertices);
    mesh.face_count = static_cast<std::uint32_t>(expected.faces);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        if (std::isfinite(mesh.vertices[i])) continue;
        throw Error(Status::ERROR_NOT_FINITE,
                    "vertex " + std::to_string(i / 3) + ": coordinate " + "xyz"[i % 3] +
                        (std::isnan(mesh.vertices[i]) ? " is NaN" : " is infinite, or too large for a float32"));
    }
    FaceTriangles triangles(mesh);
    auto repeated = expected.repeated.begin();
    std::size_t next = 0; // of the faces delivered
    for (std::uint32_t face = 0; face < mesh.face_count; ++face) {
        if (repeated != expected.repeated.end() && repeated->face == face) {
            triangles.add(face, repeated->corners.data(), repeated->corners.size());
            if (is_delivered(repeated->corners)) ++next;
            ++repeated;
            continue;
        }
        const std::size_t begin = next == 0 ? 0 : raw.face_ends[next - 1];
        triangles.add(face, raw.corners.data() + begin, raw.face_ends[next] - begin);
        ++next;
    }
    return mesh;
}

} // namespace

LoadedMesh load_mesh(const std::filesystem::path& path) {
    try {
        std::string text = read_file(path);
        const FileKind kind = kind_of(path);
        if (text.empty()) throw Error(Status::ERROR_FILE_FORMAT, "the file is empty");
        if (kind == FileKind::stl) return read_stl(text);
        const Expected expected = prepare(kind, text);
        return assemble(expected, read_with_openmesh(kind, path, text));
    } catch (const Error& error) {
        throw Error(error.status(), path.u8string() + ": " + error.what());
    }
}

} // namespace raywise
