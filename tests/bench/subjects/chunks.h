// Calls of one ray or one packet, spread over threads: what a program does that has no call for many rays.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <cstdint>
#include <functional>

namespace raywise::bench {

// ask(first, last) of whole chunks, summed up. One thread: one call for all.
template <class Ask>
std::uint64_t ask_in_chunks(std::size_t first, std::size_t last, unsigned threads, const Ask& ask) {
    if (threads <= 1) return ask(first, last);
    constexpr std::size_t chunk = 1024; // a multiple of every packet
    const std::size_t chunks = (last - first + chunk - 1) / chunk;
    tbb::task_arena arena(static_cast<int>(threads));
    return arena.execute([&] {
        return tbb::parallel_reduce(
            tbb::blocked_range<std::size_t>(0, chunks), std::uint64_t{0},
            [&](const tbb::blocked_range<std::size_t>& range, std::uint64_t sum) {
                const std::size_t begin = first + range.begin() * chunk;
                const std::size_t end = std::min(last, first + range.end() * chunk);
                return sum + ask(begin, end);
            },
            std::plus<>());
    });
}

} // namespace raywise::bench
