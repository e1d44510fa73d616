#pragma once

#include "bench/library.h"
#include "bench/subjects/subject.h"

namespace raywise::bench {

struct RaywiseSettings {
    std::string name;
    const char* structure;       // forced by name; nullptr: the library chooses
    std::string instruction_set; // what the library's kernels are dispatched to
};

// raywise through its C interface.
std::unique_ptr<Subject> raywise_subject(const RaywiseSettings& settings, const Library& library);

// Whether the library has a structure of that name.
bool has_structure(const Library& library, const std::string& structure);

} // namespace raywise::bench
