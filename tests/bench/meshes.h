// The meshes of the benchmarks: procedural ones by name, and files of the data folder.
#pragma once

#include "bench/library.h"

#include <cstdint>
#include <string>
#include <vector>

namespace raywise::bench {

struct NamedMesh {
    std::string name;
    workloads::Mesh mesh;
};

// scene: of workloads::scenes().
NamedMesh procedural_mesh(const char* scene, std::uint64_t triangles);

// Empty when the folder has no such file.
std::vector<NamedMesh> mesh_file(const Library& library, const std::string& folder, const std::string& file);

} // namespace raywise::bench
