// From primitives to their meshes, for those who go through many: neighbours are of one mesh, mostly.
#pragma once

#include "geometry/primitives.h"

#include <cstdint>

namespace raywise {

class MeshCursor {
public:
    explicit MeshCursor(const Primitives& primitives) : primitives_(primitives) {}

    // Moves to the mesh of a primitive, which the following tell about.
    void move_to(std::uint32_t primitive) {
        if (contains(primitive)) return;
        const std::uint32_t geometry = primitives_.locate(primitive).geometry;
        mesh_ = primitives_.meshes()[geometry].get();
        first_ = primitives_.number({geometry, 0});
        count_ = mesh_->triangle_count();
    }
    const TriangleMesh& mesh() const { return *mesh_; }
    bool contains(std::uint32_t primitive) const { return primitive - first_ < count_; }
    std::uint32_t triangle(std::uint32_t primitive) const { return primitive - first_; }
    std::uint32_t end() const { return first_ + count_; } // the first primitive of the next mesh

private:
    const Primitives& primitives_;
    const TriangleMesh* mesh_ = nullptr;
    std::uint32_t first_ = 0;
    std::uint32_t count_ = 0;
};

} // namespace raywise
