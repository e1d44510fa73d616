// From cold to R answers: a structure is built, and asked by one batch call.
#pragma once

#include "bench/session.h"

#include <cstdint>
#include <string>
#include <vector>

namespace raywise::bench {

// Powers of ten, from 1 on: how many rays there are.
std::vector<std::uint64_t> decades_up_to(std::uint64_t most);
std::string power_of_ten(std::uint64_t count);

// What fits into a narrow column: "morton" of "bvh_morton".
std::string short_name(const std::string& structure);

// The rays of one kind that are asked of a scene. Of more than can be asked in a sensible time the rest is reckoned.
class ColdRays {
public:
    // most: decades end there. kind: of workloads::ray_distributions().
    ColdRays(SceneUnderTest& scene, std::size_t kind, const std::vector<std::uint64_t>& decades);

    bool are_there() const { return rays_.size() == most_; }
    std::uint64_t most() const { return most_; } // that are asked
    Question question() const { return question_; }
    const RaySet& rays() const { return rays_; }
    BuildRequest request(std::uint64_t count) const;

private:
    const SceneUnderTest& scene_;
    std::size_t kind_;
    Question question_;
    std::uint64_t most_ = 1;
    RaySet rays_;
};

struct ColdTime {
    double build_ns;
    double ns_per_ray;
    std::string structure;

    double total_ms(std::uint64_t count) const { return (build_ns + ns_per_ray * static_cast<double>(count)) * 1e-6; }
};

// Of one thread, in processor time, for a subject that is told how many rays are coming. Laying out the rays is not counted: they are the
// caller's.
ColdTime time_from_cold(const Subject& subject, const ColdRays& rays, std::uint64_t count);

// Median, spread and number of repeated times; whose they are is for the caller to say.
Value value_of_times(const std::vector<double>& ms);

} // namespace raywise::bench
