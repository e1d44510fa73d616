#include "io/openmesh_reader.h"

#include "base/error.h"
#include "io/allocation_watch.h"

#include <OpenMesh/Core/IO/IOManager.hh>
#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <OpenMesh/Core/IO/reader/PLYReader.hh>
#include <OpenMesh/Core/System/omstream.hh>

#include <istream>
#include <locale>
#include <mutex>
#include <new>
#include <streambuf>

#include <pthread.h>

namespace raywise::io {
namespace {

using namespace OpenMesh;

// Takes positions and faces down, and has no use for anything else a reader may offer.
class Importer final : public IO::BaseImporter {
public:
    explicit Importer(RawMesh& mesh) : mesh_(mesh) {}

    using BaseImporter::add_vertex;
    VertexHandle add_vertex(const Vec3f& p) override {
        mesh_.vertices.insert(mesh_.vertices.end(), {p[0], p[1], p[2]});
        return VertexHandle(static_cast<int>(n_vertices() - 1));
    }
    VertexHandle add_vertex() override { return add_vertex(Vec3f(0.0f, 0.0f, 0.0f)); }
    void set_point(VertexHandle vertex, const Vec3f& p) override {
        const auto first = 3 * static_cast<std::size_t>(vertex.idx());
        for (std::size_t axis = 0; axis < 3; ++axis) mesh_.vertices.at(first + axis) = p[axis];
    }
    FaceHandle add_face(const VHandles& corners) override {
        for (const VertexHandle corner : corners) mesh_.corners.push_back(static_cast<std::uint32_t>(corner.idx()));
        mesh_.face_ends.push_back(mesh_.corners.size());
        return FaceHandle(static_cast<int>(n_faces() - 1));
    }
    std::size_t n_vertices() const override { return mesh_.vertices.size() / 3; }
    std::size_t n_faces() const override { return mesh_.face_ends.size(); }
    std::size_t n_edges() const override { return 0; }

    HalfedgeHandle add_edge(VertexHandle, VertexHandle) override { return HalfedgeHandle(); }
    FaceHandle add_face(HalfedgeHandle) override { return FaceHandle(); }
    void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<Vec2f>&) override {}
    void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<Vec3f>&) override {}
    void set_face_texindex(FaceHandle, int) override {}
    void set_halfedge(VertexHandle, HalfedgeHandle) override {}
    void set_normal(VertexHandle, const Vec3f&) override {}
    void set_normal(VertexHandle, const Vec3d&) override {}
    void set_normal(FaceHandle, const Vec3f&) override {}
    void set_normal(FaceHandle, const Vec3d&) override {}
    void set_color(VertexHandle, const Vec3uc&) override {}
    void set_color(VertexHandle, const Vec4uc&) override {}
    void set_color(VertexHandle, const Vec3f&) override {}
    void set_color(VertexHandle, const Vec4f&) override {}
    void set_color(EdgeHandle, const Vec3uc&) override {}
    void set_color(EdgeHandle, const Vec4uc&) override {}
    void set_color(EdgeHandle, const Vec3f&) override {}
    void set_color(EdgeHandle, const Vec4f&) override {}
    void set_color(FaceHandle, const Vec3uc&) override {}
    void set_color(FaceHandle, const Vec4uc&) override {}
    void set_color(FaceHandle, const Vec3f&) override {}
    void set_color(FaceHandle, const Vec4f&) override {}
    void set_texcoord(VertexHandle, const Vec2f&) override {}
    void set_texcoord(VertexHandle, const Vec3f&) override {}
    void set_texcoord(HalfedgeHandle, const Vec2f&) override {}
    void set_texcoord(HalfedgeHandle, const Vec3f&) override {}
    void set_status(VertexHandle, const Attributes::StatusInfo&) override {}
    void set_status(HalfedgeHandle, const Attributes::StatusInfo&) override {}
    void set_status(EdgeHandle, const Attributes::StatusInfo&) override {}
    void set_status(FaceHandle, const Attributes::StatusInfo&) override {}
    void set_next(HalfedgeHandle, HalfedgeHandle) override {}
    void set_face(HalfedgeHandle, FaceHandle) override {}
    void request_face_texcoords2D() override {}
    void add_texture_information(int, std::string) override {}

private:
    RawMesh& mesh_;
};

// Keeps OpenMesh's streams quiet for as long as it lives.
class Silence {
public:
    Silence() : errors_(omerr().is_enabled()), log_(omlog().is_enabled()) {
        omerr().disable();
        omlog().disable();
    }
    ~Silence() {
        if (errors_) omerr().enable();
        if (log_) omlog().enable();
    }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;

private:
    bool errors_;
    bool log_;
};

// A text in memory as a stream, without another copy of it.
class TextBuffer final : public std::streambuf {
public:
    explicit TextBuffer(std::string& text) { setg(text.data(), text.data(), text.data() + text.size()); }

private:
    pos_type seekoff(off_type offset, std::ios_base::seekdir direction, std::ios_base::openmode) override {
        const off_type base = direction == std::ios_base::beg   ? 0
                              : direction == std::ios_base::end ? egptr() - eback()
                                                                : gptr() - eback();
        const off_type position = base + offset;
        if (position < 0 || position > egptr() - eback()) return pos_type(off_type(-1));
        setg(eback(), eback() + position, egptr());
        return pos_type(position);
    }
    pos_type seekpos(pos_type position, std::ios_base::openmode which) override {
        return seekoff(position, std::ios_base::beg, which);
    }
};

// OpenMesh is for one thread at a time. Whoever reads while another thread forks does not go on in the child, where the lock is new.
std::mutex one_reader;
[[maybe_unused]] const int after_fork = pthread_atfork(nullptr, nullptr, [] { new (&one_reader) std::mutex; });

} // namespace

RawMesh read_with_openmesh(std::string ply) {
    const std::lock_guard lock(one_reader);
    const Silence silence;
    RawMesh mesh;
    Importer importer(mesh);
    TextBuffer buffer(ply);
    std::istream stream(&buffer);
    stream.imbue(std::locale::classic()); // the host's may write numbers differently
    IO::Options options;
    const AllocationWatch watch;
    const bool good = IO::IOManager().read(stream, "ply", importer, options);
    watch.require_none_refused();
    if (!good) throw Error(Status::ERROR_FILE_FORMAT, "OpenMesh cannot read the file");
    return mesh;
}

} // namespace raywise::io
