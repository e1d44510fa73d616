// Does every structure, view, call, order and number of threads give the same answers on a scene?
#pragma once

#include "contract/sweep_subject.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace raywise::sweep {

// What one block of rays, or all of a scene's, came to.
struct AgreementCount {
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;          // rays that hit something
    std::uint64_t comparisons = 0;   // one ray's answer by one subject, compared with the reference's
    std::uint64_t disagreements = 0; // comparisons that found a difference
    std::uint64_t judge_rays = 0;
    std::uint64_t judge_disagreements = 0;
    double seconds = 0.0;
    std::vector<std::string> faults; // with everything it takes to see one again

    void add(const AgreementCount& other);
    // What the block is reckoned with when time is shared out: answers of scenes that are hardly ever hit take next to no
    // time, and prove as little.
    double share() const;
};

// One block of a scene: its rays and the manners of asking depend on seed, scene and block alone.
AgreementCount agreement_block(const SweepScene& scene, const Subject& reference, const std::vector<Subject>& subjects,
                               std::uint64_t seed, std::uint64_t block);

class AgreementScene {
public:
    AgreementScene(SweepScene scene, std::size_t index, std::uint64_t seed);

    const SweepScene& scene() const { return scene_; }

    // The structures are built by the first call. Any number of threads may call.
    AgreementCount run(std::uint64_t block);

private:
    struct Built {
        Subject reference;
        std::vector<Subject> subjects;
    };
    const Built& built();

    SweepScene scene_;
    std::size_t index_;
    std::uint64_t seed_;
    std::once_flag once_;
    std::unique_ptr<const Built> built_;
};

} // namespace raywise::sweep
