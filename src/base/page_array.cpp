#include "base/page_array.h"

#include <cstdint>

#include <sys/mman.h>

namespace raywise {
namespace {

constexpr std::align_val_t alignment{64};
constexpr std::size_t large_page = std::size_t{2} << 20;

// A wish: where the system does not grant it everything works as before.
void ask_for_large_pages(std::byte* memory, std::size_t bytes) {
#ifdef MADV_HUGEPAGE
    const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + large_page - 1) / large_page * large_page;
    const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / large_page * large_page;
    if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#else
    static_cast<void>(memory);
    static_cast<void>(bytes);
#endif
}

} // namespace

PageMemory::PageMemory(std::size_t bytes) : memory_(static_cast<std::byte*>(::operator new(bytes, alignment))) {
    ask_for_large_pages(memory_.get(), bytes);
}

void PageMemory::Release::operator()(std::byte* memory) const noexcept { ::operator delete(memory, alignment); }

} // namespace raywise
