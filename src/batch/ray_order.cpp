#include "batch/ray_order.h"

#include <array>
#include <cmath>

namespace raywise {
namespace {

// Spreads the lowest bits so that two zeros follow each.
std::uint32_t spread(std::uint32_t bits) {
    bits = (bits | bits << 8) & 0x0300F00Fu;
    bits = (bits | bits << 4) & 0x030C30C3u;
    return (bits | bits << 2) & 0x09249249u;
}

// x in [0, cells) to its cell; anything else, a NaN too, to the first or the last.
std::uint32_t cell_of(double x, std::uint32_t cells) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(larger(smaller(x, cells - 1.0), 0.0)));
}

} // namespace

RayOrder::RayOrder(const Box& bounds) : bounds_(bounds), cells_per_unit_(0.0) {
    for (int axis = 0; axis < 3; ++axis) {
        const double size = bounds.upper[axis] - bounds.lower[axis];
        const double cells = static_cast<double>(1u << cell_bits) / size;
        if (size > 0.0 && std::isfinite(cells)) cells_per_unit_[axis] = cells;
    }
}

// Whatever it returns, answers are the same: it need not be exact, and no input may be harmful.
std::uint32_t RayOrder::key_of(const Ray& ray) const {
    double near = larger(ray.tmin, 0.0);
    std::uint32_t octant = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double direction = at(ray.direction, axis);
        const bool backwards = std::signbit(direction);
        const double plane = at(backwards ? bounds_.upper : bounds_.lower, axis);
        const double distance = (plane - at(ray.origin, axis)) / direction;
        near = larger(smaller(distance, 0x1p1000), near);
        octant |= static_cast<std::uint32_t>(backwards) << axis;
    }
    std::uint32_t cell = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double entry = at(ray.origin, axis) + near * at(ray.direction, axis);
        cell |= spread(cell_of((entry - at(bounds_.lower, axis)) * at(cells_per_unit_, axis), 1u << cell_bits)) << axis;
    }
    constexpr std::uint32_t steps = 1u << direction_bits;
    const Vec3 magnitude = magnitudes(ray.direction);
    const double scale = steps / max_component(magnitude);
    const std::uint32_t direction =
        cell_of(magnitude.x * scale, steps) << direction_bits | cell_of(magnitude.y * scale, steps);
    return (octant << 3 * cell_bits | cell) << 2 * direction_bits | direction;
}

// Whether most rays are in the cell and octant of the one before.
bool RayOrder::is_in_order_already() const {
    std::size_t changes = 0;
    for (std::size_t i = 1; i < entries_.size(); ++i)
        changes += (entries_[i].key ^ entries_[i - 1].key) >> 2 * direction_bits != 0 ? 1 : 0;
    return changes < entries_.size() / 4;
}

void RayOrder::sort_by_digit(int shift, const std::vector<Entry>& from, std::vector<Entry>& to) {
    constexpr std::uint32_t digits = 1u << digit_bits;
    std::array<std::uint32_t, digits> next{};
    for (const Entry& entry : from) ++next[entry.key >> shift & (digits - 1)];
    std::uint32_t sum = 0;
    for (std::uint32_t& first : next) {
        const std::uint32_t count = first;
        first = sum;
        sum += count;
    }
    for (const Entry& entry : from) to[next[entry.key >> shift & (digits - 1)]++] = entry;
}

const std::vector<std::uint32_t>& RayOrder::sort(const Ray* rays, std::size_t count) {
    entries_.resize(count);
    scratch_.resize(count);
    order_.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) entries_[i] = {key_of(rays[i]), i};
    if (!is_in_order_already()) {
        sort_by_digit(0, entries_, scratch_);
        sort_by_digit(digit_bits, scratch_, entries_);
    }
    for (std::size_t i = 0; i < count; ++i) order_[i] = entries_[i].ray;
    return order_;
}

} // namespace raywise
