// Rays as all subjects are given them: float32, because that is what the others take. Each turns them into its own form
// before the clock starts.
#pragma once

#include "rays/rays.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace raywise::bench {

struct RaySet {
    std::vector<float> origin;    // x y z of each
    std::vector<float> direction; // x y z of each
    std::vector<float> tmin;
    std::vector<float> tmax;

    std::size_t size() const { return tmin.size(); }
};

RaySet rounded(const workloads::Rays& rays);

// One ray in so many, from the first on: the same spread, only thinner.
RaySet one_in(const RaySet& rays, std::size_t stride);

// In random order.
RaySet shuffled(const RaySet& rays, std::uint64_t seed);

} // namespace raywise::bench
