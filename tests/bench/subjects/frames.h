// A mesh whose vertices move: what a subject makes of the next frame, in the memory of the last one as far as it can.
#pragma once

#include "bench/library.h"
#include "bench/subjects/embree_library.h"
#include "bench/subjects/subject.h"

#include <memory>
#include <vector>

namespace raywise::bench {

class Frames {
public:
    // Embree may read 16 bytes from the last vertex on.
    explicit Frames(const workloads::Mesh& mesh) : mesh_(mesh) { mesh_.vertices.reserve(mesh.vertices.size() + 1); }
    virtual ~Frames() = default;
    Frames(const Frames&) = delete;
    Frames& operator=(const Frames&) = delete;

    // Read in place: to be changed between two frames, and left alone while rays are asked.
    std::vector<float>& vertices() { return mesh_.vertices; }
    // From the vertices as they are now to a scene that can be asked.
    virtual void next() = 0;
    // Of the frame there is.
    virtual std::unique_ptr<Query> query(const QueryRequest& request) const = 0;

protected:
    workloads::Mesh mesh_;
};

enum class Renewal {
    build, // anew
    refit  // new boxes around the tree of the first frame
};

// One thread each.
std::unique_ptr<Frames> raywise_frames(const Library& library, const char* structure, Renewal renewal,
                                       const workloads::Mesh& mesh);
std::unique_ptr<Frames> embree_frames(const EmbreeLibrary& library, Renewal renewal, const workloads::Mesh& mesh);

} // namespace raywise::bench
