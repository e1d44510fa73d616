// Triangle meshes made of a fuzzer's bytes, with what the header says about each: whether it may be added, and which of its
// triangles are never hit.
#pragma once

#include "fuzz/arrays.h"
#include "fuzz/failure.h"
#include "fuzz/input.h"
#include "raywise/raywise.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace raywise::fuzz {

using Point = std::array<double, 3>;

class Mesh {
public:
    explicit Mesh(Input& input);
    // The same mesh with its vertices elsewhere, for rw_scene_refit; now and then with numbers that differ, which it refuses,
    // unless the scene is built anew in any case.
    Mesh(Input& input, std::shared_ptr<const Mesh> before, bool is_built_anew);

    // As the caller describes it. The arrays belong to this object.
    const rw_triangles& triangles() const { return triangles_; }
    // The same for rw_scene_refit, which may be without the indices that the scene has already.
    rw_triangles moved_triangles() const {
        rw_triangles moved = triangles_;
        if (keeps_indices_) moved.indices.data = nullptr;
        return moved;
    }
    // The same numbers of the same type, packed, always to be copied: what the judge gets.
    rw_triangles packed() const;

    // What adding it may return, apart from the scene's own state.
    const Outcome& outcome() const { return outcome_; }

    std::uint64_t triangle_count() const { return triangles_.triangle_count; }
    std::uint64_t invalid_count() const { return invalid_count_; }
    bool is_invalid(std::uint64_t triangle) const { return invalid_[triangle]; }
    const std::vector<Point>& vertices() const { return values_; }
    const std::vector<std::array<std::uint64_t, 3>>& corners() const { return corners_; } // may be out of range

    bool is_unchanged() const;
    void describe() const; // on stderr

private:
    void describe_vertices(Input& input, const std::vector<Point>& points);
    void describe_indices(Input& input, const std::vector<std::array<std::uint64_t, 3>>& triangles);
    void pack();
    void make_arrays(Input& input);
    void spoil(Input& input);
    void judge();

    std::shared_ptr<const Mesh> before_; // its indices may be in use
    rw_triangles triangles_{};
    InputArray vertex_array_;
    InputArray index_array_;
    std::vector<Point> values_;
    std::vector<std::array<std::uint64_t, 3>> corners_;
    std::vector<bool> invalid_;
    std::uint64_t invalid_count_ = 0;
    std::vector<float> packed_floats_;
    std::vector<double> packed_doubles_;
    std::vector<std::uint64_t> packed_indices_;
    bool is_described_wrongly_ = false;
    bool keeps_indices_ = false;
    Outcome outcome_{"add a mesh"};
};

} // namespace raywise::fuzz
