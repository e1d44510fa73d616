// The pieces that the pool of pages deals in: memory of the system, with a head that tells how much it is.
#pragma once

#include <cstddef>
#include <new>

namespace raywise {

// In front of the memory that is handed out. As long as a node of a tree, four cache lines, so that nodes do not lie across pages.
struct alignas(256) PageBlock {
    std::size_t capacity; // behind this
    std::align_val_t alignment;
    bool has_room;   // beyond what it was asked for, for an array that grows from frame to frame
    PageBlock* next; // of a list

    std::byte* memory() { return reinterpret_cast<std::byte*>(this + 1); }
    static PageBlock* of(std::byte* memory) { return reinterpret_cast<PageBlock*>(memory) - 1; }
};

// In pages of 2 MiB where it is large and the system has them. Throws std::bad_alloc.
PageBlock* allocate_block(std::size_t capacity, bool has_room);
// All blocks of a list.
void release_blocks(PageBlock* first) noexcept;

// Nobody may touch the memory of a block that is kept, nor what is beyond the bytes that its owner asked for; nor may anybody rely on what
// was in it. The address sanitizer sees to that.
void close_block(PageBlock* block) noexcept;
void open_block(PageBlock* block, std::size_t bytes) noexcept;

} // namespace raywise
