// When a way of working pays: the thresholds of builds and batches, each with its measurement. They cost time, never an answer. Which structure
// is chosen is decided in decide.h.
#pragma once

#include "model/cost_functions.h"
#include "model/workload.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace raywise {

// Builds.

// How many triangles to look at before a structure is chosen; 0: none, so few rays are coming that a look costs more than it saves.
std::uint32_t triangles_to_look_at(std::uint64_t triangles, const Workload& workload);

// Whether so many rays pay for what a linear scan makes ready for them, the triangles in blocks. Fewer read the caller's arrays.
bool worth_gathering(const Workload& workload);

// Whether so few rays are coming that a structure is likely which does not need the triangles' areas; see AreasAre in
// geometry/primitives.h. Where another one is chosen they are looked at when it is built.
bool areas_can_wait(const Workload& workload);

// Whether a build of so many primitives is shared among the library's own threads.
bool worth_build_threads(std::uint64_t primitives);

// One structure's sample is timed for no longer than this: on a large mesh a linear scan would take minutes for it.
inline constexpr double sample_time_limit_ns = 50e6;

// Whether what was chosen for `before` hittable primitives is kept where they have become `now`.
bool choice_holds(std::uint64_t before, std::uint64_t now);

// How many times what it did when it was built a refitted tree may cost; beyond that building anew pays.
double refit_limit(const Cost& predicted, const std::optional<std::uint64_t>& rays);

// Batches. threads: as many as there may be. at_a_time: how many rays the structure would like to get together; 1: none. fewest: how many are
// worth a thread.

// Of rays through a tree or a grid each thread gets at least so many: waking one for fewer costs more. So twice as many are the first that are
// not answered on the caller's thread alone. Random rays on the bunny (69,451 triangles): 256 take 25 us in a bvh and 60 in a kd_tree; 512 on
// two threads took no longer than on one even where both processors had other work (AMD EPYC, family 26, model 2, 2026-12-01).
inline constexpr std::uint64_t fewest_rays_of_thread = 256;

// How many threads trace so many rays; at least 1.
unsigned batch_threads(std::uint64_t rays, unsigned threads, std::uint64_t fewest = fewest_rays_of_thread);

// How many rays one thread takes at a time. There are at least as many blocks as batch_threads().
std::uint64_t batch_block(std::uint64_t rays, unsigned threads, std::size_t at_a_time,
                          std::uint64_t fewest = fewest_rays_of_thread);

// The most rays that are put in order together, for 48 bytes of memory each, 80 where they are float64. Windows of a quarter of a million
// made rays in random order 5 to 20 % slower: docs/decisions/0014-batches-in-order.md.
inline constexpr std::size_t ordering_window = std::size_t{1} << 20;

// Whether putting so many rays in order may pay with a structure of that size, where the first-level cache has that size; 0: not known.
bool may_pay_to_order(std::uint64_t rays, std::uint64_t structure_bytes, std::uint64_t cache_bytes);

// Then so many of them are traced as they come, to tell whether it does pay with the others.
std::uint64_t ordering_trial(std::uint64_t rays);

// Whether rays that take so long each as they come, in nanoseconds of one thread, are put in order.
bool worth_ordering(double ns_per_ray);

// Whether a block of so many rays tells how long one takes.
bool is_worth_timing(std::uint64_t rays);

// Whether rays of which so many are in another cell or octant than the one before are in order already.
bool is_coherent(std::size_t changes, std::size_t rays);

// How many threads sort so many rays; at least 1.
unsigned ordering_threads(std::uint64_t rays, unsigned threads);

} // namespace raywise
