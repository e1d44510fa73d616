// The library's own threads, oneTBB's.
#pragma once

#include <cstddef>
#include <cstdint>

namespace raywise {

// Calls body(data) up to `times` times on up to `threads` threads, the caller's included, and returns when all calls have. It
// may be called fewer times, and not at all where there is no memory or no thread to be had: the body looks itself for what
// is left to do, and throws nothing.
void run_on_threads(unsigned threads, std::uint64_t times, void (*body)(void* data) noexcept, void* data) noexcept;

// Arenas kept for the next call: for each number of threads as many as there were calls at once.
std::size_t kept_arenas();

} // namespace raywise
