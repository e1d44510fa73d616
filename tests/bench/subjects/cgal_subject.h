#pragma once

#include "bench/subjects/subject.h"

#include <string>

namespace raywise::bench {

// CGAL's AABB tree over triangles of double, without exact arithmetic: the fastest it offers.
std::unique_ptr<Subject> cgal_subject();

std::string cgal_version();

} // namespace raywise::bench
