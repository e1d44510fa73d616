// Rays made of a fuzzer's bytes: at corners, along edges and axes, from surfaces, and nonsense.
#pragma once

#include "fuzz/arrays.h"
#include "fuzz/caller_struct.h"
#include "fuzz/meshes.h"

#include <memory>
#include <vector>

namespace raywise::fuzz {

// Triangles that a ray passes through.
using Skips = std::vector<rw_primitive_id>;

// Of those that are there, with repeats and entries that stand for nothing.
Skips make_skips(Input& input, const std::vector<std::shared_ptr<Mesh>>& meshes);

rw_ray make_ray(Input& input, const std::vector<std::shared_ptr<Mesh>>& meshes);

bool has_nan(const rw_ray& ray);
void describe(const rw_ray& ray); // on stderr

// Many rays in arrays of some layout.
class RayBatch {
public:
    RayBatch(Input& input, const std::vector<std::shared_ptr<Mesh>>& meshes);

    const rw_rays* get() const { return struct_->get(); }
    const std::vector<rw_ray>& rays() const { return rays_; } // as they stand in memory
    const Skips& skips(std::size_t ray) const { return skips_[ray]; }
    std::uint64_t nan_count() const;
    // Whether the arrays are in order, and whether what they skip is there.
    const Outcome& outcome() const { return outcome_; }
    const Outcome& skip_outcome() const { return skip_outcome_; }
    bool is_unchanged() const;

private:
    void make_skip_arrays(Input& input, const std::vector<std::shared_ptr<Mesh>>& meshes);

    InputArray origin_;
    InputArray direction_;
    InputArray tmin_;
    InputArray tmax_;
    InputArray skip_geometry_;
    InputArray skip_primitive_;
    std::vector<std::uint64_t> skip_offsets_;
    std::vector<rw_ray> rays_;
    std::vector<Skips> skips_;
    std::unique_ptr<CallerStruct<rw_rays>> struct_;
    Outcome outcome_{"rays"};
    Outcome skip_outcome_{"skip lists"};
};

} // namespace raywise::fuzz
