// What comes with a ray beside its numbers: whatever narrows down what it may hit.
#pragma once

#include "ray/skip_list.h"

namespace raywise {

struct Query {
    SkipList skip; // primitives that the ray passes through

    bool passes_through(std::uint32_t primitive) const { return !skip.empty() && skip.contains(primitive); }
};

} // namespace raywise
