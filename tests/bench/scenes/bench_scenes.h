// The scenes of the benchmark, in one table: files of the data folder, and procedural ones that are always there.
#pragma once

#include "bench/library.h"
#include "scenes/scenes.h"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace raywise::bench {

// Where files are looked for. Empty: nowhere.
struct SceneFiles {
    std::string meshes; // bunny, igea
    std::string spd;    // NFF scenes
    std::string dragon; // a file
};

// A mesh, and what float32 arrays do not tell about it.
struct TestScene {
    TestScene() = default;
    TestScene(workloads::Mesh all) : mesh(std::move(all)) {} // NOLINT: most scenes are nothing but a mesh

    workloads::Mesh mesh;
    std::optional<workloads::Mesh> aimed_at; // what rays are made for; empty: the whole mesh
    Vec3 offset = Vec3(0.0);                 // where it lies for who takes float64; the others find it at the origin
    double rays_from_height = 0.0;           // above 0: rays come straight down from there, so that float32 holds them
};

struct SceneRow {
    const char* name;
    bool quick;                    // part of the short form
    bool far_apart;                // sizes or places that no camera sees at once: single rays only
    std::uint64_t triangles;       // wanted of procedural scenes
    std::uint64_t quick_triangles; // in the short form
    // Throws MissingFile when what it is made from is not there.
    TestScene (*make)(const SceneRow& row, std::uint64_t triangles, const Library& library, const SceneFiles& files);
};

struct MissingFile : std::runtime_error {
    using std::runtime_error::runtime_error;
};

const std::vector<SceneRow>& scene_rows();

// Of scene_rows(). The vertices can be read up to 16 bytes from the beginning of the last one, as Embree wants it.
TestScene make_scene(const SceneRow& row, bool quick, const Library& library, const SceneFiles& files);

} // namespace raywise::bench
