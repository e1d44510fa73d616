// What every language is asked: meshes, rays, and the triangles that the rays skip.
#pragma once

#include "oracle/scenes.h"
#include "ray/ray.h"
#include "raywise/raywise.h"

#include <functional>
#include <vector>

namespace raywise::parity {

struct Case {
    Ray ray;
    std::vector<rw_primitive_id> skip;
};

std::vector<oracle::Scene> meshes();

// all: asks for all hits of a case; skip lists are made of those.
std::vector<Case> cases(const oracle::Scene& mesh, const std::function<std::vector<rw_hit>(const Case&)>& all);

} // namespace raywise::parity
