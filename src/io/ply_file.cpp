#include "io/file_mesh.h"
#include "io/ply_header.h"
#include "io/ply_values.h"

#include <algorithm>
#include <array>

namespace raywise::io {
namespace {

class PlyReader {
public:
    PlyReader(std::string_view file, std::size_t first_byte)
        : header_(read_ply_header(file)), values_(file, header_, first_byte) {}

    FileMesh read() {
        const PlyElement* const vertex = header_.find("vertex");
        const PlyElement* face = header_.find("face");
        const PlyElement* const strips = header_.find("tristrips");
        if (vertex == nullptr) fail_header("the header has no element vertex");
        if (face == nullptr || face->count == 0) face = strips;
        if (face == nullptr || face->count == 0) return {};
        if (vertex->count > most_elements) fail_header(too_many("vertices"), Status::ERROR_TOO_MANY);
        if (face->count > most_elements) fail_header(too_many("faces"), Status::ERROR_TOO_MANY);
        vertex_count_ = vertex->count;
        for (int axis = 0; axis < 3; ++axis) {
            if (count_if(*vertex, [axis](const PlyProperty& p) { return p.axis == axis; }) != 1)
                fail_header("element vertex needs the properties x, y and z, once each");
        }
        if (count_if(*face, [](const PlyProperty& p) { return p.is_corners; }) != 1)
            fail_header("element " + face->name + " needs one list of vertex indices");

        bool has_vertices = false;
        bool has_faces = false;
        for (const PlyElement& element : header_.elements) {
            if (has_vertices && has_faces) break; // nothing behind them is wanted
            if (&element == vertex) {
                vertices(element);
                has_vertices = true;
            } else if (&element == face) {
                faces(element, face == strips);
                has_faces = true;
            } else {
                skip(element);
            }
        }
        return std::move(mesh_);
    }

private:
    template <class Condition>
    static std::ptrdiff_t count_if(const PlyElement& element, Condition condition) {
        return std::count_if(element.properties.begin(), element.properties.end(), condition);
    }

    [[noreturn]] void fail_header(const std::string& reason, Status status = Status::ERROR_FILE_FORMAT) const {
        throw Error(status, reason + " (line " + std::to_string(header_.lines) + ", where the header ends)");
    }

    void vertices(const PlyElement& element) {
        std::array<double, 3> position{};
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) {
                if (property.axis < 0) {
                    values_.skip(property, "vertex", i);
                } else {
                    position[static_cast<std::size_t>(property.axis)] = values_.take_coordinate(property, i);
                }
            }
            mesh_.add_vertex(position);
            values_.end_element();
        }
    }

    void faces(const PlyElement& element, bool are_strips) {
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) {
                if (!property.is_corners) {
                    values_.skip(property, element.name.c_str(), i);
                } else if (are_strips) {
                    strip(property, i);
                } else {
                    face(property, i);
                }
            }
            values_.end_element();
        }
    }

    void face(const PlyProperty& property, std::uint64_t number) {
        const std::int64_t count = values_.take_integer(property.count, "face", number);
        if (count < 3) values_.fail(Status::ERROR_BAD_POLYGON, bad_polygon(number, count));
        if (static_cast<std::uint64_t>(count) > most_elements)
            values_.fail(Status::ERROR_TOO_MANY, too_many("corners"));
        mesh_.begin_face(static_cast<std::uint32_t>(count));
        for (std::int64_t corner = 0; corner < count; ++corner) {
            mesh_.add_corner(checked(values_.take_integer(property.type, "face", number), number));
        }
    }

    // Triangle strips, as the Stanford scans have them: each index makes a triangle with the two before it, every
    // other one the other way round, and -1 begins anew. Each triangle becomes a face.
    void strip(const PlyProperty& property, std::uint64_t number) {
        const std::int64_t count = values_.take_integer(property.count, "tristrips", number);
        std::array<std::uint32_t, 2> last{};
        std::uint64_t length = 0;
        for (std::int64_t i = 0; i < count; ++i) {
            const std::int64_t index = values_.take_integer(property.type, "tristrips", number);
            if (index == -1) {
                length = 0;
                continue;
            }
            const std::uint32_t corner = checked(index, mesh_.face_count());
            if (length >= 2) {
                mesh_.begin_face(3);
                mesh_.add_corner(last[length % 2 == 0 ? 0 : 1]);
                mesh_.add_corner(last[length % 2 == 0 ? 1 : 0]);
                mesh_.add_corner(corner);
            }
            last = {last[1], corner};
            ++length;
        }
    }

    std::uint32_t checked(std::int64_t index, std::uint64_t face) const {
        if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_)
            values_.fail(Status::ERROR_INDEX_OUT_OF_RANGE, bad_index(face, std::to_string(index), vertex_count_));
        return static_cast<std::uint32_t>(index);
    }

    void skip(const PlyElement& element) {
        if (element.properties.empty()) return;
        const std::string name = quoted(element.name);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) values_.skip(property, name.c_str(), i);
            values_.end_element();
        }
    }

    PlyHeader header_;
    PlyValues values_;
    FileMesh mesh_;
    std::uint64_t vertex_count_ = 0; // which faces may come before
};

} // namespace

FileMesh read_ply(std::string_view bytes) {
    const std::string_view file = without_byte_order_mark(bytes);
    return PlyReader(file, bytes.size() - file.size()).read();
}

} // namespace raywise::io
