#include "model/policy.h"

#include <algorithm>

namespace raywise {
namespace {

// Rays. Gathering takes 2 to 12 ns per triangle, most of it for the memory; a ray over gathered triangles then takes 0.6 to 1.6 ns per
// triangle less than one that reads the caller's arrays. The break-even lies between 3 rays (soup of a million triangles) and 12
// (terrain of a million), at 4 to 7 for smaller scenes. Measured with a loop over scenes of calibration/scenes from 1,000 to a million
// triangles on an Intel Xeon with AVX-512 (family 6, model 207), 2026-11-26: docs/decisions/0012-linear-scan.md.
constexpr std::uint64_t gathering_pays_from = 8;

// A look at the triangles. One costs 0.05 us in a cache and 0.25 us beyond, so that of one in 128 is 2 ns per triangle at most, a twentieth of the
// quickest build that is worth a choice, and 2,048 of a larger scene are less. A crowding of some triangles in a cell takes some hundred to be seen.
// For fewer rays than 32 only scans and grids come into question, which differ by more than features can tell. AMD EPYC, 2026-12-01.
constexpr std::uint64_t one_looked_at_of = 128;
constexpr std::uint64_t fewest_looked_at = 128;
constexpr std::uint64_t most_looked_at = 2048;
constexpr std::uint64_t fewest_rays_to_look = 32;

// For more rays something else than a linear scan is chosen anyway, on scenes that are not tiny; for that the number of triangles with area is
// worth knowing before.
constexpr std::uint64_t areas_matter_from = 256;

// Scenes of fewer triangles are built on the caller's thread: that takes 0.1 ms (a kd_tree 1), and what could be shared of it is over
// before another thread is awake.
constexpr std::uint64_t fewest_for_build_threads = 1024;

// How many times as many primitives, or as few, the choice of before is good for. By the generic profile, over 16 to 10^7 triangles and 1 to
// 10^8 random rays: at twice or half the number the best structure is another in 7 of 100 cases, and the one of before takes 0.5 % longer
// on average and 29 % at worst; at four times 2 % and 73 %.
constexpr std::uint64_t choice_holds_for = 2;

// How many times what it did when it was built a refitted tree may cost where nobody knows how many rays are coming. Twice the cost is
// about twice the time of a ray, and 10^6 rays of 0.5 us each, twice as slow, take what building 10^6 triangles at 0.3 us and the
// refit that was in vain do.
constexpr double refit_limit_without_count = 2.0;

// Several blocks for each thread balance uneven work: what the last thread is late by is a block at most.
constexpr std::uint64_t blocks_per_thread = 8;

// Rays in a block, where the structure takes one at a time: 136 bytes each, of the ray and its hits, stay in the second-level cache. 512, 2,048
// and 8,192 took the same time but for the noise of 4 % (uniform_grid and kd_tree on the bunny, 10^6 random and camera rays, one
// thread; AMD EPYC, family 26, model 2, 2026-12-01).
constexpr std::uint64_t single_rays_per_block = 2048;

// Rays are put in order where there are so many. Fewer are in the noise of the call: 4,096 gain a tenth or nothing (bunny and a soup of a
// million triangles, random and diffuse rays, AMD EPYC, family 26, model 2, 2026-12-01).
constexpr std::uint64_t fewest_in_order = 4096;

// ... and where each takes so long as they come, in nanoseconds of one thread: putting them in order costs some 17 and takes away up to half
// of what tracing does. As they come and in order, ns a ray: stadium 62 and 67, gears 69 and 71, tree 60 and 67 and 20 and 37; gears, diffuse,
// 114 and 89, bunny 146 and 97, interior 293 and 164 (AMD EPYC, family 26, model 2, 2026-12-01; docs/decisions/0025).
constexpr double shortest_in_order = 75.0;

// That is told by the first of them, a sixteenth and at most so many: eight blocks of 512, of which the quickest is believed. In random order
// one tells of all.
constexpr std::uint64_t trial_part = 16;
constexpr std::uint64_t most_on_trial = 4096;

// Rays are in order already where less than this part of them changes cell or octant. Bunny, igea and teapot: of 10^6 camera rays 0.03 do, of
// 10^4 0.32; of shadow rays from the hits of as many 0.09 to 0.11 and 0.6 to 0.8; of diffuse rays from them 0.9 and more (2026-12-01).
constexpr double most_changes = 0.25;

// Fewer rays are not worth a thread that sorts: at 15 ns each (0014) they take 0.25 ms.
constexpr std::uint64_t fewest_sorted_by_thread = 16384;

unsigned threads_for(std::uint64_t rays, std::uint64_t fewest, unsigned threads) {
    return static_cast<unsigned>(std::clamp<std::uint64_t>(rays / fewest, 1, threads));
}

} // namespace

bool worth_gathering(const Workload& workload) { return !workload.rays || *workload.rays >= gathering_pays_from; }

std::uint32_t triangles_to_look_at(std::uint64_t triangles, const Workload& workload) {
    if (workload.rays && *workload.rays < fewest_rays_to_look) return 0;
    const std::uint64_t wanted = std::clamp(triangles / one_looked_at_of, fewest_looked_at, most_looked_at);
    return static_cast<std::uint32_t>(std::min(wanted, triangles));
}

bool areas_can_wait(const Workload& workload) { return workload.rays && *workload.rays < areas_matter_from; }

bool worth_build_threads(std::uint64_t primitives) { return primitives >= fewest_for_build_threads; }

bool choice_holds(std::uint64_t before, std::uint64_t now) {
    return now <= choice_holds_for * before && before <= choice_holds_for * now;
}

double refit_limit(const Cost& predicted, const std::optional<std::uint64_t>& rays) {
    if (!rays) return refit_limit_without_count;
    // Where they are counted: the cost at which what the rays lose is what building takes.
    return 1.0 + predicted.build_ns / (static_cast<double>(*rays) * predicted.ray_ns);
}

unsigned batch_threads(std::uint64_t rays, unsigned threads, std::uint64_t fewest) {
    return threads_for(rays, fewest, threads);
}

std::uint64_t batch_block(std::uint64_t rays, unsigned threads, std::size_t at_a_time, std::uint64_t fewest) {
    const std::uint64_t most = at_a_time > 1 ? at_a_time : single_rays_per_block;
    if (threads == 1) fewest = fewest_rays_of_thread; // nobody to share with
    const std::uint64_t even = (rays + threads - 1) / threads;
    return std::min(std::max(even / blocks_per_thread, fewest), most);
}

bool may_pay_to_order(std::uint64_t rays, std::uint64_t structure_bytes, std::uint64_t cache_bytes) {
    return rays >= fewest_in_order && structure_bytes > cache_bytes;
}

std::uint64_t ordering_trial(std::uint64_t rays) { return std::min(rays / trial_part, most_on_trial); }

bool is_worth_timing(std::uint64_t rays) { return rays >= fewest_rays_of_thread; }

bool worth_ordering(double ns_per_ray) { return ns_per_ray >= shortest_in_order; }

bool is_coherent(std::size_t changes, std::size_t rays) {
    return static_cast<double>(changes) < most_changes * static_cast<double>(rays);
}

unsigned ordering_threads(std::uint64_t rays, unsigned threads) {
    return threads_for(rays, fewest_sorted_by_thread, threads);
}

} // namespace raywise
