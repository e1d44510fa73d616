// Embree 3 before the hard cases: float32, closest and any hit by its own calls, all hits through its filter function.
#pragma once

#include "contract/library.h"

#include <memory>
#include <string>

namespace raywise::contract {

enum class EmbreeFlags {
    plain,
    robust
};

std::unique_ptr<Library> make_embree(EmbreeFlags flags);
std::string embree_version();

} // namespace raywise::contract
