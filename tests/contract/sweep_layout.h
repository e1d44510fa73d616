// A mesh in the caller's memory, laid out in one of the ways the library has to read.
#pragma once

#include "contract/sweep_handles.h"
#include "oracle/scenes.h"

#include <cstddef>
#include <vector>

namespace raywise::sweep {

struct MeshLayout {
    bool float32 = false;      // only where every coordinate is a float32 number
    bool wide_indices = false; // uint64
    bool padded = false;       // elements a few bytes apart, so that most are not aligned
    bool unindexed = false;    // three vertices of its own for each triangle
};

class LaidOutMesh {
public:
    LaidOutMesh(const oracle::Scene& mesh, const MeshLayout& layout);
    const rw_triangles& triangles() const { return triangles_; }

private:
    std::vector<std::byte> vertices_;
    std::vector<std::byte> indices_;
    rw_triangles triangles_ = sized<rw_triangles>();
};

} // namespace raywise::sweep
