// Which elements of the caller's arrays a piece of a batch is about, one after the other.
#pragma once

#include <cstddef>
#include <cstdint>

namespace raywise {

class Elements {
public:
    // Those that follow `first`.
    Elements(std::uint64_t first, std::size_t count) : first_(first), count_(count) {}
    // first + numbers[k] for each k below count.
    Elements(std::uint64_t first, const std::uint32_t* numbers, std::size_t count)
        : first_(first), count_(count), numbers_(numbers) {}

    std::size_t count() const { return count_; }
    std::uint64_t operator[](std::size_t k) const { return first_ + (numbers_ != nullptr ? numbers_[k] : k); }

    bool are_scattered() const { return numbers_ != nullptr; } // else they follow each other

    Elements part(std::size_t begin, std::size_t count) const {
        return numbers_ != nullptr ? Elements(first_, numbers_ + begin, count) : Elements(first_ + begin, count);
    }

    // body(k, element k, in bytes from the first element of an array with that stride), for each k below the count: a loop for either kind.
    template <class Body>
    void for_each_offset(std::ptrdiff_t stride, const Body& body) const {
        const Elements each = *this; // bytes that body writes might be those of *this, as far as the compiler knows
        const auto first = static_cast<std::ptrdiff_t>(each.first_) * stride;
        if (each.numbers_ != nullptr) {
            for (std::size_t k = 0; k < each.count_; ++k)
                body(k, first + static_cast<std::ptrdiff_t>(each.numbers_[k]) * stride);
        } else {
            for (std::size_t k = 0; k < each.count_; ++k) body(k, first + static_cast<std::ptrdiff_t>(k) * stride);
        }
    }

private:
    std::uint64_t first_;
    std::size_t count_;
    const std::uint32_t* numbers_ = nullptr;
};

} // namespace raywise
