// operator new and its family, which can refuse. Under a sanitizer, whose malloc is behind them.
#include "refusing.h"

#include <cstddef>
#include <cstdlib>
#include <new>

#include <malloc.h>

namespace {

long size_of(void* memory) noexcept { return static_cast<long>(malloc_usable_size(memory)); }

void* allocate(std::size_t size, std::size_t alignment) noexcept {
    if (is_refused()) return nullptr;
    void* memory = nullptr;
    if (alignment <= alignof(std::max_align_t)) {
        memory = std::malloc(size == 0 ? 1 : size);
    } else if (posix_memalign(&memory, alignment, size) != 0) {
        return nullptr;
    }
    if (memory != nullptr) count_live(1, size_of(memory));
    return memory;
}

// As the standard wants it: the handler may find memory, or throw.
void* allocate_or_throw(std::size_t size, std::size_t alignment) {
    for (;;) {
        void* memory = allocate(size, alignment);
        if (memory != nullptr) return memory;
        const std::new_handler handler = std::get_new_handler();
        if (handler == nullptr) throw std::bad_alloc();
        handler();
    }
}

void* allocate_or_null(std::size_t size, std::size_t alignment) noexcept {
    try {
        return allocate_or_throw(size, alignment);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}

void give_back(void* memory) noexcept {
    if (memory != nullptr) count_live(-1, -size_of(memory));
    std::free(memory);
}

} // namespace

using Size = std::size_t;
using Align = std::align_val_t;
using NoThrow = const std::nothrow_t&;

EXPORTED void* operator new(Size size) { return allocate_or_throw(size, 1); }
EXPORTED void* operator new[](Size size) { return allocate_or_throw(size, 1); }
EXPORTED void* operator new(Size size, Align align) { return allocate_or_throw(size, static_cast<Size>(align)); }
EXPORTED void* operator new[](Size size, Align align) { return allocate_or_throw(size, static_cast<Size>(align)); }
EXPORTED void* operator new(Size size, NoThrow) noexcept { return allocate_or_null(size, 1); }
EXPORTED void* operator new[](Size size, NoThrow) noexcept { return allocate_or_null(size, 1); }
EXPORTED void* operator new(Size size, Align align, NoThrow) noexcept {
    return allocate_or_null(size, static_cast<Size>(align));
}
EXPORTED void* operator new[](Size size, Align align, NoThrow) noexcept {
    return allocate_or_null(size, static_cast<Size>(align));
}
EXPORTED void operator delete(void* memory) noexcept { give_back(memory); }
EXPORTED void operator delete[](void* memory) noexcept { give_back(memory); }
EXPORTED void operator delete(void* memory, Size) noexcept { give_back(memory); }
EXPORTED void operator delete[](void* memory, Size) noexcept { give_back(memory); }
EXPORTED void operator delete(void* memory, Align) noexcept { give_back(memory); }
EXPORTED void operator delete[](void* memory, Align) noexcept { give_back(memory); }
EXPORTED void operator delete(void* memory, Size, Align) noexcept { give_back(memory); }
EXPORTED void operator delete[](void* memory, Size, Align) noexcept { give_back(memory); }
EXPORTED void operator delete(void* memory, NoThrow) noexcept { give_back(memory); }
EXPORTED void operator delete[](void* memory, NoThrow) noexcept { give_back(memory); }
EXPORTED void operator delete(void* memory, Align, NoThrow) noexcept { give_back(memory); }
EXPORTED void operator delete[](void* memory, Align, NoThrow) noexcept { give_back(memory); }
