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

    Elements part(std::size_t begin, std::size_t count) const {
        return numbers_ != nullptr ? Elements(first_, numbers_ + begin, count) : Elements(first_ + begin, count);
    }

private:
    std::uint64_t first_;
    std::size_t count_;
    const std::uint32_t* numbers_ = nullptr;
};

} // namespace raywise
