// Memory of builders.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace raywise {

namespace build_memory {

constexpr std::size_t huge_page = std::size_t{1} << 21;

struct Free {
    std::align_val_t alignment;
    void operator()(void* memory) const { ::operator delete(memory, alignment); }
};

} // namespace build_memory

template <class T>
using BuildArray = std::unique_ptr<T[], build_memory::Free>;

// Without initial values: what holds one element per primitive is written once, by many threads. Large arrays ask for huge
// pages; where the system gives them only on request, a build takes a tenth less time.
template <class T>
BuildArray<T> make_build_array(std::size_t count) {
    using namespace build_memory;
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    const std::size_t bytes = count * sizeof(T);
    const bool large = bytes >= 2 * huge_page;
    const auto alignment = static_cast<std::align_val_t>(large ? huge_page : alignof(std::max_align_t) * 2);
    static_assert(alignof(T) <= alignof(std::max_align_t) * 2);
    void* const memory = ::operator new(bytes, alignment);
#if defined(__linux__)
    if (large) madvise(memory, bytes / huge_page * huge_page, MADV_HUGEPAGE); // refused: small pages do as well
#endif
    return BuildArray<T>(static_cast<T*>(memory), Free{alignment});
}

} // namespace raywise
