// The library as its users have it, through raywise.h: what is measured here is what they will wait for.
#pragma once

#include "model/scene_features.h"
#include "rays/rays.h"
#include "scenes/scenes.h"

#include "raywise/raywise.h"

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace raywise::calibration {

class LibraryError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// Throws LibraryError with the library's message when the status is not RW_OK.
void check(std::int32_t status, const char* function);

struct Release {
    void operator()(rw_scene* scene) const { rw_scene_release(scene); }
    void operator()(rw_profile* profile) const { rw_profile_release(profile); }
    void operator()(rw_mesh* mesh) const { rw_mesh_release(mesh); }
};
template <class T>
using Handle = std::unique_ptr<T, Release>;

// Names in the library's order. Throws when they are not those this program was built for.
void check_structures();

// The library's compiled-in profile: builders are to use the same costs whatever profiles lie around.
Handle<rw_profile> builtin_profile();

// Every `step`th of a distribution's rays, `count` of them.
struct RaySelection {
    const workloads::Rays& rays;
    std::uint64_t count;
    std::uint64_t step = 1;
};

// Something built that can be asked: a scene, or a view of one.
class Built {
public:
    double build_ns() const { return build_ns_; } // as the library timed it, in wall time
    double bytes() const { return bytes_; }
    const SceneFeatures& features() const { return features_; } // as the library saw them

    // Answers all; any_hit: only whether there is a hit.
    void ask(const RaySelection& selection, bool any_hit, std::uint32_t threads);
    std::vector<workloads::SurfacePoint> closest(const workloads::Rays& rays, std::uint32_t threads);

protected:
    Built() = default;
    Handle<rw_scene> scene_;
    double build_ns_ = 0.0;
    double bytes_ = 0.0;
    SceneFeatures features_;

private:
    std::vector<float> t_;
    std::vector<std::uint32_t> primitive_;
    std::vector<std::uint8_t> occluded_;
};

class BuiltScene : public Built {
public:
    // The mesh is used in place and has to outlive the scene.
    BuiltScene(const workloads::Mesh& mesh, const char* structure, const rw_profile* profile, std::uint32_t threads);
    const rw_scene* handle() const { return scene_.get(); }
};

struct ViewPlace {
    Vec3 origin;
    Vec3 direction;    // zero: all around
    double half_angle; // radians; 0 when all around
    std::int32_t ray_kind;
};

class BuiltView : public Built {
public:
    BuiltView(const BuiltScene& scene, const ViewPlace& place, const char* structure, std::uint32_t threads);
};

} // namespace raywise::calibration
