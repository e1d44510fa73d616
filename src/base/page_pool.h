// Memory of large arrays, handed from one that is released to the next one of about that size. A page that comes fresh from the system
// is cleared when it is first touched, which takes as long as much of what builders do with it (docs/decisions/0026-frames.md).
//
// Released memory is kept while a KeepPages lives, and otherwise as far as keep_pages() allows: with what is in use up to twice of what
// was in use at once during the last builds, so that what a smaller scene does not need any more goes back. Memory from here holds
// whatever was in it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace raywise {

// Smaller arrays are malloc's, which keeps what it can use again itself.
inline constexpr std::size_t least_pooled_bytes = std::size_t{256} << 10;

// Builds in which memory can go without use before it goes back to the system: what one of so many scenes that move needs stays
// while the others are built. In a second of frames of one scene it is gone.
inline constexpr std::size_t builds_remembered = 32;

// At least `bytes` > 0, aligned to cache lines, not cleared. What is kept is taken where it is as large or up to a quarter larger.
// Throws std::bad_alloc.
std::byte* take_pages(std::size_t bytes);
// bytes: as they were asked for.
void give_pages(std::byte* memory, std::size_t bytes) noexcept;

// While one lives, what is released is kept. Any thread.
class KeepPages {
public:
    KeepPages() noexcept;
    ~KeepPages();
    KeepPages(const KeepPages&) = delete;
    KeepPages& operator=(const KeepPages&) = delete;
};

// A build is done: by these the time is counted that memory is kept for.
void note_build() noexcept;

// How many bytes are kept where no KeepPages lives; 0 at first. What is kept beyond that is given back at once, in any case.
void keep_pages(std::uint64_t most) noexcept;

// Of pooled arrays, in bytes of whole blocks.
struct PagePoolFigures {
    std::uint64_t in_use = 0;
    std::uint64_t kept = 0;
    std::uint64_t fresh_blocks = 0; // from the system, since the process began
    std::uint64_t fresh_bytes = 0;
};
PagePoolFigures page_pool_figures() noexcept;

} // namespace raywise
