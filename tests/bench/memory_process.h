// Memory of one subject and one mesh, measured in a process that does nothing else, so that no other subject's freed blocks are
// found and used again. The same for all, whatever allocator they use: resident memory before, after, and at its highest, as the
// kernel counts it. Device and threads are warmed up first with another mesh; they belong to the program, not to a scene.
#pragma once

#include "bench/subjects/subject.h"
#include "scenes/scenes.h"

#include <string>
#include <vector>

namespace raywise::bench {

struct MemoryFigures { // bytes
    double resident = 0.0;
    double peak_resident = 0.0;
    double told = -1.0; // by the library; negative: not
    double peak_told = -1.0;
};

// A mesh in a temporary file, which goes when this goes.
class StoredMesh {
public:
    explicit StoredMesh(const workloads::Mesh& mesh);
    ~StoredMesh();
    StoredMesh(const StoredMesh&) = delete;
    StoredMesh& operator=(const StoredMesh&) = delete;
    const std::string& path() const { return path_; }

private:
    std::string path_;
};

// Runs `command` with --memory-of SUBJECT --stored-mesh FILE behind it, and reads what that prints. Throws std::runtime_error when
// it fails.
MemoryFigures memory_in_a_process(const std::vector<std::string>& command, const std::string& subject,
                                  const StoredMesh& mesh);

// The other end: measures here and prints.
void print_memory(const Subject& subject, const std::string& stored_mesh);

} // namespace raywise::bench
