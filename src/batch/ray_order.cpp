#include "batch/ray_order.h"

#include "model/policy.h"

#include <utility>

namespace raywise {

std::uint32_t* RayOrder::keys(std::size_t count) {
    count_ = count;
    if (keys_.size() < count) {
        keys_ = PageArray<std::uint32_t>(count);
        numbers_ = PageArray<std::uint32_t>(count);
        entries_ = PageArray<Entry>(count);
    }
    return keys_.data();
}

void RayOrder::divide(unsigned threads) {
    parts_.resize(ordering_threads(count_, threads));
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        parts_[i].begin = count_ * i / parts_.size();
        parts_[i].end = count_ * (i + 1) / parts_.size();
    }
}

template <class DigitOf, class Place>
void RayOrder::sort_by(const Parallel& parallel, const DigitOf& digit_of, const Place& place) {
    parallel.for_each(parts_.size(), [&](std::uint64_t p) {
        Part& part = parts_[p];
        part.next.fill(0);
        for (std::size_t i = part.begin; i < part.end; ++i) ++part.next[digit_of(i)];
    });
    std::uint32_t sum = 0;
    for (std::uint32_t digit = 0; digit < digits; ++digit) {
        for (Part& part : parts_) sum += std::exchange(part.next[digit], sum);
    }
    parallel.for_each(parts_.size(), [&](std::uint64_t p) {
        Part& part = parts_[p];
        for (std::size_t i = part.begin; i < part.end; ++i) place(i, part.next[digit_of(i)]++);
    });
}

const std::uint32_t* RayOrder::sort(const Parallel& parallel) {
    divide(parallel.threads());
    sort_by(
        parallel, [this](std::size_t i) { return keys_[i] & (digits - 1); },
        [this](std::size_t i, std::size_t where) {
            entries_[where] = {keys_[i], static_cast<std::uint32_t>(i)};
        });
    sort_by(
        parallel, [this](std::size_t i) { return entries_[i].key >> digit_bits; },
        [this](std::size_t i, std::size_t where) { numbers_[where] = entries_[i].ray; });
    return numbers_.data();
}

} // namespace raywise
