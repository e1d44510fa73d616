// Rays made of a fuzzer's bytes: at corners, along edges and axes, from surfaces, and nonsense.
#pragma once

#include "fuzz/arrays.h"
#include "fuzz/caller_struct.h"
#include "fuzz/meshes.h"

#include <memory>
#include <vector>

namespace raywise::fuzz {

rw_ray make_ray(Input& input, const std::vector<std::shared_ptr<Mesh>>& meshes);

bool has_nan(const rw_ray& ray);
void describe(const rw_ray& ray); // on stderr

// Many rays in arrays of some layout.
class RayBatch {
public:
    RayBatch(Input& input, const std::vector<std::shared_ptr<Mesh>>& meshes);

    const rw_rays* get() const { return struct_->get(); }
    const std::vector<rw_ray>& rays() const { return rays_; } // as they stand in memory
    std::uint64_t nan_count() const;
    const Outcome& outcome() const { return outcome_; }
    bool is_unchanged() const;

private:
    InputArray origin_;
    InputArray direction_;
    InputArray tmin_;
    InputArray tmax_;
    std::vector<rw_ray> rays_;
    std::unique_ptr<CallerStruct<rw_rays>> struct_;
    Outcome outcome_{"rays"};
};

} // namespace raywise::fuzz
