// Many rays over the caller's arrays, on several threads. The answers are those of Tracer, ray by ray.
#pragma once

#include "base/parallel.h"
#include "batch/batch_progress.h"
#include "batch/batch_workspace.h"
#include "batch/hit_arrays.h"
#include "batch/ray_arrays.h"
#include "scene/tracer.h"

#include <cstdint>

namespace raywise {

// Whether rays are put in order first. Answers are the same.
enum class RayOrdering {
    where_it_pays,
    always, // the others are for tests
    never
};

struct BatchOptions {
    Parallel parallel{1};
    BatchWatch watch;
    BatchWorkspace* workspace = nullptr; // null: memory of the batch's own
    RayOrdering ordering = RayOrdering::where_it_pays;
};

// Each returns how many of the rays held a NaN. The skip lists have to be checked. Throws Error(ERROR_CANCELLED) when the watch asks to
// stop: what is written by then is right.
std::uint64_t intersect_batch(const Tracer& tracer, const RayArrays& rays, const HitArrays& hits,
                              const BatchOptions& options);
std::uint64_t occluded_batch(const Tracer& tracer, const RayArrays& rays, const OutputArray& occluded,
                             const BatchOptions& options);

// Writes rays.count + 1 offsets, and the hits when they fit the capacity; nothing when it is stopped. Returns through `needed` how many there are.
std::uint64_t intersect_all_batch(const Tracer& tracer, const RayArrays& rays, std::uint64_t* offsets,
                                  const HitArrays& hits, std::uint64_t capacity, std::uint64_t& needed,
                                  const BatchOptions& options);

} // namespace raywise
