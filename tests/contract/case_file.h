// The case files in cases/: what a line may say, and what was said. cases/README.md describes the format.
//
// Reading a file neither makes meshes nor rays, so it never depends on the machine; expand.h does that.
#pragma once

#include "contract/expectation.h"
#include "ray/ray.h"

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace raywise::contract {

// Names file and line, and says what was expected there.
class CaseFileError : public std::runtime_error {
public:
    CaseFileError(const std::string& file, int line, const std::string& text)
        : std::runtime_error(file + ":" + std::to_string(line) + ": " + text) {}
};

// The kinds of refusal that a case can ask for.
const std::vector<std::string>& refusal_kinds();

// One line that makes or changes a geometry: "v", "f", a generator's name, "scale", "move" or "grid".
struct MeshStep {
    std::string verb;
    std::vector<double> numbers;
    std::string text; // of a generator that takes a name
    int line = 0;
};

struct GeometryLines {
    bool float32 = false;
    bool skip_invalid = false;
    std::vector<MeshStep> steps;
};

// A ray, or a sweep of rays, and what is expected of each.
struct RayLines {
    std::string sweep; // kind; empty for a single ray
    Ray ray;
    std::uint64_t count = 0; // 0: all there are
    std::uint64_t seed = 0;
    std::vector<double> numbers; // what the sweep takes beyond count and seed
    std::vector<Expectation> expectations;
    int line = 0;
};

struct Case {
    std::string name;
    std::string about;
    std::string source;     // URL
    std::string convention; // what others may see differently; empty where there is nothing to argue about
    bool float32 = false;
    std::vector<GeometryLines> geometries;
    std::vector<RayLines> rays;
    std::string refusal; // kind of error that the meshes have to be refused with; empty: none
    std::string mention; // what the error's text has to hold
    int line = 0;
};

struct Family {
    std::string name;
    std::string about;
    std::string file;
    std::vector<Case> cases;
};

// Throws CaseFileError. `file` is how errors call it.
Family parse_cases(const std::string& text, const std::string& file);

Family read_case_file(const std::filesystem::path& path);

// Every .txt file of a folder, in the order of their names.
std::vector<Family> read_case_folder(const std::filesystem::path& folder);

// The folder of the repository.
std::filesystem::path case_folder();

} // namespace raywise::contract
