#include "bench/memory_process.h"

#include "bench/binary.h"
#include "bench/meshes.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <malloc.h>
#include <unistd.h>

namespace raywise::bench {
namespace {

// A line of /proc/self/status, in bytes.
double status_bytes(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.compare(0, name.size() + 1, name + ":") == 0)
            return 1024.0 * std::strtod(line.c_str() + name.size() + 1, nullptr);
    }
    throw std::runtime_error("/proc/self/status has no " + name);
}

// From now on the highest resident memory is that of the present; see proc(5).
void reset_peak() {
    std::ofstream clear("/proc/self/clear_refs");
    clear << "5" << std::flush;
    if (!clear) throw std::runtime_error("/proc/self/clear_refs cannot be written");
}

std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

} // namespace

StoredMesh::StoredMesh(const workloads::Mesh& mesh) {
    std::string pattern = (std::filesystem::temp_directory_path() / "raywise-bench-XXXXXX").string();
    const int file = ::mkstemp(pattern.data());
    if (file < 0) throw std::runtime_error("no temporary file can be made");
    ::close(file);
    path_ = pattern;
    std::ofstream out(path_, std::ios::binary);
    write_values(out, mesh.vertices);
    write_values(out, mesh.indices);
    out.close();
    if (!out) throw std::runtime_error(path_ + " cannot be written");
}

StoredMesh::~StoredMesh() { ::unlink(path_.c_str()); }

MemoryFigures memory_in_a_process(const std::vector<std::string>& command, const std::string& subject,
                                  const StoredMesh& mesh) {
    std::string line;
    for (const std::string& word : command) line += quoted(word) + " ";
    line += "--memory-of " + quoted(subject) + " --stored-mesh " + quoted(mesh.path());
    FILE* const pipe = ::popen(line.c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error("a process cannot be started");
    std::string text;
    char buffer[256];
    while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) text += buffer;
    if (::pclose(pipe) != 0) throw std::runtime_error("measuring the memory of " + subject + " failed");
    const auto told = nlohmann::json::parse(text);
    return {told.at("resident"), told.at("peak_resident"), told.at("told"), told.at("peak_told")};
}

void print_memory(const Subject& subject, const std::string& stored_mesh) {
    workloads::Mesh mesh;
    {
        std::ifstream in(stored_mesh, std::ios::binary);
        mesh.vertices = read_values<float>(in);
        mesh.indices = read_values<std::uint32_t>(in);
    }
    {
        workloads::Mesh other = procedural_mesh("tiny_box", 12).mesh;
        other.vertices.reserve(other.vertices.size() + 4);
        subject.build({other});
    }
    ::malloc_trim(0);
    reset_peak();
    const double before = status_bytes("VmRSS");
    const std::unique_ptr<Built> built = subject.build({mesh});
    const double peak = status_bytes("VmHWM");
    const double after = status_bytes("VmRSS");
    const nlohmann::json figures = {{"resident", std::max(after - before, 0.0)},
                                    {"peak_resident", std::max(peak - before, 0.0)},
                                    {"told", built->bytes()},
                                    {"peak_told", built->peak_bytes()}};
    std::printf("%s\n", figures.dump().c_str());
}

} // namespace raywise::bench
