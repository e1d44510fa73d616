// Answers against answers, bit for bit.
#pragma once

#include "contract/sweep_manner.h"

#include <cstdint>
#include <string>
#include <vector>

namespace raywise::sweep {

// A ray on which two answers differ.
struct Difference {
    std::size_t ray;
    std::string text; // the question and both answers
};

// Of the first answers.size() rays; wanted may be longer.
std::vector<Difference> compare_closest(const std::vector<rw_hit>& wanted, const std::vector<rw_hit>& answers);
// wanted: the closest hits, which say whether there are any.
std::vector<Difference> compare_any(const std::vector<rw_hit>& wanted, const std::vector<std::uint8_t>& answers);
std::vector<Difference> compare_all(const AllHits& wanted, const AllHits& answers);
// Whether the closest hit is the first of all.
std::vector<Difference> compare_first(const std::vector<rw_hit>& closest, const AllHits& all);

bool is_hit(const rw_hit& hit);
// With every bit, as C's %a.
std::string text_of(const rw_ray& ray);
std::string text_of(const rw_hit& hit);

} // namespace raywise::sweep
