// The meshes that a case file can name, and what it can do to them.
#pragma once

#include "contract/case_file.h"
#include "contract/library.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace raywise::contract {

// A number that a line takes.
struct Parameter {
    const char* name;
    double lowest;
    double highest;
    bool whole;
};

// "mesh NAME ..." in a case file.
struct Generator {
    const char* name;
    std::vector<Parameter> parameters;
    bool takes_text; // one name instead of numbers
    void (*make)(const MeshStep& step, Mesh& mesh);
};
const std::vector<Generator>& generators();
const Generator* generator_named(const std::string& name);

// "scale", "move" and "grid": what they take.
struct Change {
    const char* name;
    std::vector<Parameter> parameters;
    std::size_t fewest; // the parameters after those may be left out
    Vec3 (*apply)(const std::vector<double>& numbers, const Vec3& vertex);
};
const std::vector<Change>& changes();
const Change* change_named(const std::string& name);

// A mesh file that is not on this machine.
class MeshFileAbsent : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// Follows the lines of a geometry. Each vertex is rounded to float32 after every step where the geometry is float32.
// Throws MeshFileAbsent.
Mesh make_mesh(const GeometryLines& lines);

} // namespace raywise::contract
