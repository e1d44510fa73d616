#pragma once

#include "bench/library.h"
#include "bench/subjects/subject.h"

namespace raywise::bench {

// raywise through its C interface. structure: forced by name; nullptr: the library chooses.
std::unique_ptr<Subject> raywise_subject(std::string name, const Library& library, const char* structure);

// Whether the library has a structure of that name.
bool has_structure(const Library& library, const std::string& structure);

} // namespace raywise::bench
