// One set of meshes committed on every structure: the linear scan is the judge, the others have to say what it says.
#pragma once

#include "fuzz/asked.h"
#include "fuzz/meshes.h"
#include "fuzz/rays.h"

#include <memory>
#include <string>
#include <vector>

namespace raywise::fuzz {

using Meshes = std::vector<std::shared_ptr<Mesh>>;

// The names of rw_structure_name.
const std::vector<std::string>& structure_names();

class Reference {
public:
    // everywhere: all structures; otherwise the judge alone.
    Reference(Meshes meshes, bool everywhere);
    ~Reference();
    Reference(const Reference&) = delete;
    Reference& operator=(const Reference&) = delete;

    const Meshes& meshes() const { return meshes_; }
    const std::vector<Asked>& scenes() const { return asked_; }

    // The judge's answers, each checked by itself: order, limits of the ray, ids of triangles that may be hit.
    std::vector<rw_hit> all(const rw_ray& ray, const Skips& skips = {}) const;
    rw_hit closest(const rw_ray& ray, const Skips& skips = {}) const; // of those, the first
    const rw_scene* judge() const { return scenes_.front(); }

private:
    void check(const rw_ray& ray, const Skips& skips, const std::vector<rw_hit>& hits) const;

    Meshes meshes_;
    std::vector<rw_scene*> scenes_;
    std::vector<Asked> asked_;
};

rw_hit miss();

rw_ray_options options_of(const Skips& skips);

} // namespace raywise::fuzz
