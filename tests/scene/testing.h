// What the tests of scenes share: a mesh, rays, a profile whose constants a test sets.
#pragma once

#include "scene/scene.h"

#include <functional>
#include <memory>
#include <vector>

namespace raywise::testing {

// Triangles of about the same size, anywhere in a cube of side 2 around the origin.
struct Soup {
    std::vector<float> vertices;
    TriangleArrays arrays() const;
};
Soup make_soup(std::uint32_t triangles, unsigned seed = 1);

// A callback that looks at what it is told and keeps the fraction in `last`.
Progress::Callback expect_within_ends(double& last);

std::vector<Ray> make_chords(std::size_t count, unsigned seed = 1);

// Every structure costs nothing, except what `change` sets.
std::shared_ptr<const Profile> make_profile(const std::function<void(MachineConstants&)>& change);

// A committed scene. `prepare` may set expectations before the commit.
std::shared_ptr<Scene> make_scene(const Soup& soup, std::shared_ptr<const Profile> profile,
                                  const std::function<void(Scene&)>& prepare = {});

// Whether two answers are the same bits.
bool same_bits(const Hit& a, const Hit& b);

} // namespace raywise::testing
