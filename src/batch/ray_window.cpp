#include "batch/ray_window.h"

#include "model/policy.h"

#include <algorithm>

namespace raywise {
namespace {

constexpr std::size_t together = RayKeys::most; // rays or hits, that stay at hand from one loop to the next

// Calls body(begin, n) for runs of [begin, end).
template <class Body>
void for_runs(std::size_t begin, std::size_t end, const Body& body) {
    for (; begin < end; begin += together) body(begin, std::min(together, end - begin));
}

} // namespace

RayWindow::RayWindow(const RayArrays& rays, const Primitives& primitives, const Parallel& parallel,
                     BatchProgress& progress)
    : rays_(rays), primitives_(primitives), parallel_(parallel), progress_(progress), order_(parallel) {}

// Whether most rays are in the cell and octant of the one before: of every sixteenth run.
bool RayWindow::come_in_order(std::uint64_t first, std::size_t count) const {
    Ray rays[together];
    std::uint32_t keys[together];
    std::size_t looked_at = 0;
    std::size_t changes = 0;
    for (std::size_t begin = 0; begin < count; begin += 16 * together) {
        const std::size_t n = std::min(together, count - begin);
        rays_.read({first + begin, n}, rays);
        keys_->of(rays, n, keys);
        for (std::size_t k = 1; k < n; ++k) changes += RayKeys::is_near(keys[k], keys[k - 1]) ? 0 : 1;
        looked_at += n;
    }
    return is_coherent(changes, looked_at);
}

void RayWindow::read_to_slots(std::uint64_t first, std::size_t count) {
    if (slots_.size() < count) slots_ = PageArray<Slot>(count);
    std::uint32_t* const all_keys = order_.keys(count);
    parallel_.for_blocks(count, 16 * together, [&](std::uint64_t block_begin, std::uint64_t block_end) {
        Ray rays[together];
        std::uint32_t keys[together];
        for_runs(block_begin, block_end, [&](std::size_t begin, std::size_t n) {
            progress_.poll();
            rays_.read({first + begin, n}, rays);
            keys_->of(rays, n, keys);
            std::copy_n(keys, n, all_keys + begin);
            for (std::size_t k = 0; k < n; ++k) slots_[begin + k].put(rays[k]);
        });
    });
}

void RayWindow::move_to(std::uint64_t first, std::size_t count, bool in_order) {
    first_ = first;
    if (in_order && !keys_) keys_.emplace(primitives_.bounds());
    has_slots_ = in_order && !come_in_order(first, count);
    if (!has_slots_) {
        elements_ = {first, count};
        return;
    }
    read_to_slots(first, count);
    elements_ = {first, order_.sort(), count};
}

void RayWindow::read(const Elements& part, Ray* rays) {
    if (!has_slots_) {
        rays_.read(part, rays);
        return;
    }
    for (std::size_t k = 0; k < part.count(); ++k) rays[k] = slots_[slot(part, k)].get<Ray>();
}

void RayWindow::write(const Elements& part, const Hit* found, const HitArrays& hits) {
    if (!has_slots_) {
        hits.write(part, found, primitives_);
        return;
    }
    const bool with_normals = hits.normal.wanted();
    for (std::size_t k = 0; k < part.count(); ++k)
        slots_[slot(part, k)].put(Answer{found[k], with_normals ? normal_of(found[k], primitives_) : Vec3(0.0)});
}

void RayWindow::finish(const HitArrays& hits) const {
    if (!has_slots_) return;
    parallel_.for_blocks(elements_.count(), 16 * together, [&](std::uint64_t block_begin, std::uint64_t block_end) {
        Hit found[together];
        Vec3 normals[together];
        for_runs(block_begin, block_end, [&](std::size_t begin, std::size_t n) {
            for (std::size_t k = 0; k < n; ++k) {
                const Answer& answer = slots_[begin + k].get<Answer>();
                found[k] = answer.hit;
                normals[k] = answer.normal;
            }
            hits.write_found({first_ + begin, n}, found);
            hits.write_normals({first_ + begin, n}, normals);
        });
    });
}

} // namespace raywise
