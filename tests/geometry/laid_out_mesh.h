// One mesh in every layout that callers may have it in. Each array has its own memory, not a byte longer than it has to be.
#pragma once

#include "geometry/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace raywise {

struct Layout {
    const char* name;
    Scalar coordinates = Scalar::float32;
    std::size_t vertex_gap = 0;    // bytes between vertices
    bool components_apart = false; // all x, then all y, then all z
    bool indexed = true;
    Scalar indices = Scalar::uint32;
    std::size_t index_gap = 0;
};

inline const std::vector<Layout>& every_layout() {
    static const std::vector<Layout> layouts = {
        {"packed float32 and uint32"},
        {"float32 in threes", Scalar::float32, 0, false, false},
        {"float32 and uint64", Scalar::float32, 0, false, true, Scalar::uint64},
        {"float32 of 16 bytes", Scalar::float32, 4},
        {"float32, unaligned", Scalar::float32, 1, false, true, Scalar::uint32, 3},
        {"float32, components apart", Scalar::float32, 0, true},
        {"packed float64 and uint32", Scalar::float64},
        {"packed float64 and uint64", Scalar::float64, 0, false, true, Scalar::uint64},
        {"float64 in threes", Scalar::float64, 0, false, false},
        {"float64, unaligned", Scalar::float64, 5, false, true, Scalar::uint64, 1},
        {"float64, components apart", Scalar::float64, 0, true},
    };
    return layouts;
}

class LaidOutMesh {
public:
    // indices: three for each triangle. Coordinates are rounded where the layout is of float32.
    LaidOutMesh(const std::vector<Vec3>& vertices, const std::vector<std::uint64_t>& indices, const Layout& layout) {
        std::vector<Vec3> points = vertices;
        if (!layout.indexed) {
            points.clear();
            for (const std::uint64_t i : indices) points.push_back(vertices[i]);
        }
        const std::size_t size = size_of(layout.coordinates);
        const std::size_t component = layout.components_apart ? points.size() * size : size;
        const std::size_t stride = layout.components_apart ? size : 3 * size + layout.vertex_gap;
        if (!points.empty()) vertices_.resize((points.size() - 1) * stride + 2 * component + size);
        for (std::size_t i = 0; i < points.size(); ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                std::byte* const place = vertices_.data() + i * stride + axis * component;
                const double number = points[i][static_cast<glm::length_t>(axis)];
                if (layout.coordinates == Scalar::float32) {
                    put(place, static_cast<float>(number));
                } else {
                    put(place, number);
                }
            }
        }
        arrays_.vertices = {vertices_.data(), static_cast<std::ptrdiff_t>(stride),
                            static_cast<std::ptrdiff_t>(component), layout.coordinates};
        arrays_.vertex_count = points.size();
        arrays_.triangle_count = indices.size() / 3;
        if (!layout.indexed) return;
        const std::size_t index_size = size_of(layout.indices);
        const std::size_t index_stride = 3 * index_size + layout.index_gap;
        indices_.resize(1 + arrays_.triangle_count * index_stride); // never null, which would mean none
        for (std::size_t i = 0; i < indices.size(); ++i) {
            std::byte* const place = indices_.data() + i / 3 * index_stride + i % 3 * index_size;
            if (layout.indices == Scalar::uint32) {
                put(place, static_cast<std::uint32_t>(indices[i]));
            } else {
                put(place, indices[i]);
            }
        }
        arrays_.indices = {indices_.data(), static_cast<std::ptrdiff_t>(index_stride),
                           static_cast<std::ptrdiff_t>(index_size), layout.indices};
    }
    LaidOutMesh(const LaidOutMesh&) = delete;

    std::shared_ptr<const TriangleMesh> shared(bool skip_invalid = false) const {
        return std::make_shared<const TriangleMesh>(arrays_, false, skip_invalid);
    }

private:
    template <class T>
    static void put(std::byte* place, T value) {
        std::memcpy(place, &value, sizeof value);
    }

    std::vector<std::byte> vertices_;
    std::vector<std::byte> indices_;
    TriangleArrays arrays_;
};

} // namespace raywise
