// The scenes of the benchmark, in one table: files of the data folder, and procedural ones that are always there.
#pragma once

#include "bench/library.h"
#include "scenes/scenes.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace raywise::bench {

// Where files are looked for. Empty: nowhere.
struct SceneFiles {
    std::string meshes; // bunny, igea
    std::string spd;    // NFF scenes
    std::string dragon; // a file
};

struct SceneRow {
    const char* name;
    bool quick;                    // part of the short form
    std::uint64_t triangles;       // wanted of procedural scenes
    std::uint64_t quick_triangles; // in the short form
    // Throws MissingFile when what it is made from is not there.
    workloads::Mesh (*make)(const SceneRow& row, std::uint64_t triangles, const Library& library,
                            const SceneFiles& files);
};

struct MissingFile : std::runtime_error {
    using std::runtime_error::runtime_error;
};

const std::vector<SceneRow>& scene_rows();

// Of scene_rows(). The vertices can be read up to 16 bytes from the beginning of the last one, as Embree wants it.
workloads::Mesh make_scene(const SceneRow& row, bool quick, const Library& library, const SceneFiles& files);

} // namespace raywise::bench
