// CGAL's AABB tree before the hard cases, with two kernels: plain float64 arithmetic, and exact predicates with
// float64 constructions.
#pragma once

#include "contract/library.h"

#include <memory>
#include <string>

namespace raywise::contract {

std::unique_ptr<Library> make_cgal_simple_cartesian();
std::unique_ptr<Library> make_cgal_exact_predicates();
std::string cgal_version();

} // namespace raywise::contract
