// Does any ray slip through a closed mesh?
#pragma once

#include "contract/sweep_closed_scenes.h"
#include "contract/sweep_subject.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace raywise::sweep {

struct WatertightCount {
    std::uint64_t rays = 0;        // at edges and vertices from inside, each asked for the closest and for any hit
    std::uint64_t leaks = 0;       // of those that missed
    std::uint64_t parity_rays = 0; // from inside and outside, asked for all hits
    std::uint64_t parity_errors = 0;
    double seconds = 0.0;
    std::vector<std::string> faults;

    void add(const WatertightCount& other);
    double share() const { return seconds; } // what the block is reckoned with when time is shared out
};

// One block of a mesh: its rays depend on seed, mesh and block alone.
WatertightCount watertight_block(const ClosedScene& scene, const Subject& subject, std::uint64_t seed,
                                 std::uint64_t block);

class WatertightScene {
public:
    WatertightScene(ClosedScene scene, std::uint64_t seed);

    const ClosedScene& scene() const { return scene_; }

    // Structures take turns from block to block. As AgreementScene::run.
    WatertightCount run(std::uint64_t block);

private:
    const std::vector<Subject>& built();

    ClosedScene scene_;
    std::uint64_t seed_;
    std::once_flag once_;
    std::vector<Subject> subjects_;
    SceneHandle viewed_; // what the views among the subjects look at
};

// Whether a number of crossings is right: one from inside a convex body, odd or even as the winding number from inside others,
// even from outside.
bool crossings_are_right(std::uint64_t crossings, bool from_inside, bool odd, bool convex);

} // namespace raywise::sweep
