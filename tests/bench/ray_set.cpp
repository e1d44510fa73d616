#include "bench/ray_set.h"

#include "scenes/random.h"

#include <numeric>
#include <utility>

namespace raywise::bench {
namespace {

void append(RaySet& to, const RaySet& from, std::size_t i) {
    to.origin.insert(to.origin.end(), &from.origin[3 * i], &from.origin[3 * i] + 3);
    to.direction.insert(to.direction.end(), &from.direction[3 * i], &from.direction[3 * i] + 3);
    to.tmin.push_back(from.tmin[i]);
    to.tmax.push_back(from.tmax[i]);
}

std::vector<float> to_float(const std::vector<double>& values) {
    std::vector<float> result(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) result[i] = static_cast<float>(values[i]);
    return result;
}

} // namespace

RaySet rounded(const workloads::Rays& rays) {
    return {to_float(rays.origin), to_float(rays.direction), to_float(rays.tmin), to_float(rays.tmax)};
}

RaySet one_in(const RaySet& rays, std::size_t stride) {
    RaySet result;
    for (std::size_t i = 0; i < rays.size(); i += stride) append(result, rays, i);
    return result;
}

RaySet shuffled(const RaySet& rays, std::uint64_t seed) {
    std::vector<std::size_t> order(rays.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    workloads::Random random(seed);
    // Fisher and Yates.
    for (std::size_t left = order.size(); left > 1; --left) std::swap(order[left - 1], order[random.bits() % left]);
    RaySet result;
    for (const std::size_t i : order) append(result, rays, i);
    return result;
}

} // namespace raywise::bench
