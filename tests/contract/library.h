// What a ray library has to answer to be put before the hard cases. One small adapter per library.
//
// An adapter answers as its library does: it converts numbers to the library's precision and back and does nothing to
// make an answer better. What a library has no call for it declares in its Capabilities, so that it is skipped, not failed.
#pragma once

#include "base/vec.h"
#include "ray/ray.h"

#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace raywise::contract {

// One geometry of a scene. Geometry g of the answers is the g-th mesh.
struct Mesh {
    std::string name;
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    bool float32 = false;      // handed over as float32: every coordinate is one (or a NaN, or infinite)
    bool skip_invalid = false; // triangles with bad vertices are to be left out instead of refusing the mesh
};

struct Answer {
    bool hit = false;
    double t = 0.0; // in units of the direction's length
    double u = 0.0; // weights of the second and third corner
    double v = 0.0;
    std::uint32_t geometry = 0;
    std::uint32_t primitive = 0;
};

// A mesh that the library will not take. kind: "not-finite", "coordinate-range" or "index-range"; text: what it said.
class Refusal : public std::runtime_error {
public:
    Refusal(std::string refusal_kind, const std::string& text)
        : std::runtime_error(text), kind(std::move(refusal_kind)) {}
    const std::string kind;
};

// A question for which the library has no words, such as an interval where it knows none. What depends on the answer is skipped,
// not failed.
class Inexpressible : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

struct Capabilities {
    bool has_any = true;             // tells whether anything is hit, by a call of its own
    bool has_all = true;             // lists every hit
    bool has_batch = false;          // answers many rays in one call
    bool refuses_bad_meshes = false; // says so when a mesh has a NaN, an infinity or an index out of range
    bool many_geometries = true;     // keeps several meshes apart in one scene
    bool orders_ties = true;         // promises the lowest id where several triangles are hit at the same t
    // Hits and misses are those of exact arithmetic. Of others a hit counts for the triangle touched at that t when it is within
    // t_tolerance of the one that they name.
    bool decides_exactly = true;
    // Counts each surface once where a ray passes through its edges and corners. One that promises less may list every triangle
    // that is touched there instead, and those that are met edge-on.
    bool counts_crossings = true;
    // How far t may be off, as a part of the distance between the ray's origin and the scene's farthest point: what
    // the library promises, or what its precision allows.
    double t_tolerance = 0x1p-37;
};

class Scene {
public:
    Scene() = default;
    virtual ~Scene() = default;
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    virtual Answer closest(const Ray& ray) = 0;
    // Asked only of those who have it.
    virtual bool any(const Ray& ray) = 0;
    // Replaces `answers`, sorted by t.
    virtual void all(const Ray& ray, std::vector<Answer>& answers) = 0;
    // Replaces `answers`, one for each ray.
    virtual void closest_batch(const std::vector<Ray>& rays, std::vector<Answer>& answers) = 0;
};

class Library {
public:
    Library() = default;
    virtual ~Library() = default;
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    virtual std::string name() const = 0;
    virtual Capabilities capabilities() const = 0;
    // The meshes outlive the scene. Throws Refusal for a mesh it will not take.
    virtual std::unique_ptr<Scene> build(const std::vector<Mesh>& meshes) = 0;
};

} // namespace raywise::contract
