#include "batch/ray_window.h"

#include "model/policy.h"

#include <algorithm>

namespace raywise {
namespace {

constexpr std::size_t run = RayKeys::most; // rays whose keys are made together

// So many rays ahead of the one that is read their copies are asked for.
constexpr std::size_t ahead = 16;

} // namespace

// Of every sixteenth run.
template <class AnyRay>
bool RayWindow<AnyRay>::come_in_order(std::uint64_t first, std::size_t count) const {
    AnyRay rays[run];
    std::uint32_t keys[run];
    std::size_t looked_at = 0;
    std::size_t changes = 0;
    for (std::size_t begin = 0; begin < count; begin += 16 * run) {
        const std::size_t n = std::min(run, count - begin);
        rays_.read({first + begin, n}, rays);
        keys_.of(rays, n, keys);
        for (std::size_t k = 1; k < n; ++k) changes += RayKeys::is_near(keys[k], keys[k - 1]) ? 0 : 1;
        looked_at += n;
    }
    return is_coherent(changes, looked_at);
}

template <class AnyRay>
const std::uint32_t* RayWindow<AnyRay>::sort(std::uint64_t first, std::size_t count) {
    if (copies_.size() < count) copies_ = PageArray<AnyRay>(count);
    std::uint32_t* const all_keys = order_.keys(count);
    parallel_.for_blocks(count, 16 * run, [&](std::uint64_t block_begin, std::uint64_t block_end) {
        AnyRay rays[run];
        std::uint32_t keys[run];
        for (std::size_t begin = block_begin; begin < block_end; begin += run) {
            progress_.poll();
            const std::size_t n = std::min<std::size_t>(run, block_end - begin);
            rays_.read({first + begin, n}, rays);
            keys_.of(rays, n, keys);
            std::copy_n(rays, n, copies_.data() + begin);
            std::copy_n(keys, n, all_keys + begin);
        }
    });
    return order_.sort(parallel_);
}

template <class AnyRay>
void RayWindow<AnyRay>::move_to(std::uint64_t first, std::size_t count, bool sorted) {
    first_ = first;
    is_sorted_ = sorted;
    elements_ = sorted ? Elements(first, sort(first, count), count) : Elements(first, count);
}

template <class AnyRay>
void RayWindow<AnyRay>::read(const Elements& part, AnyRay* rays) const {
    if (!is_sorted_) {
        rays_.read(part, rays);
        return;
    }
    const AnyRay* const copies = copies_.data();
    const std::size_t count = part.count();
    for (std::size_t k = 0; k < count; ++k) {
        __builtin_prefetch(copies + (part[std::min(k + ahead, count - 1)] - first_));
        rays[k] = copies[part[k] - first_];
    }
}

template <class AnyRay>
void RayWindow<AnyRay>::keep(const Elements& part, const PrimitiveHit* hits) {
    for (std::size_t k = 0; k < part.count(); ++k)
        std::memcpy(static_cast<void*>(copies_.data() + (part[k] - first_)), hits + k, sizeof *hits);
}

template class RayWindow<Ray>;
template class RayWindow<RayF>;

} // namespace raywise
