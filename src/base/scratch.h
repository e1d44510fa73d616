// Memory for the arrays of one piece of work after the other: taken from the system once, not for each piece. What is taken fresh
// costs a page fault for every 4 kB.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace raywise {

class Scratch {
public:
    // Room for n values, which are not initialised; it lasts until the next reset(). For values that need no destruction.
    template <class T>
    T* take(std::size_t n) {
        static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T> && alignof(T) <= line);
        return static_cast<T*>(take_bytes(n * sizeof(T)));
    }

    // All that was taken is free again, and stays at hand in one piece.
    void reset() {
        if (chunks_.size() > 1) {
            std::size_t size = 0;
            for (const Chunk& chunk : chunks_) size += chunk.size;
            chunks_.clear();
            add_chunk(size);
        }
        used_ = 0;
    }

private:
    static constexpr std::size_t line = 64;

    struct Free {
        void operator()(std::byte* memory) const { ::operator delete (memory, std::align_val_t{line}); }
    };
    struct Chunk {
        std::unique_ptr<std::byte, Free> memory;
        std::size_t size;
    };

    void add_chunk(std::size_t size) {
        chunks_.reserve(chunks_.size() + 1);
        auto* const memory = static_cast<std::byte*>(::operator new (size, std::align_val_t{line}));
        chunks_.push_back({std::unique_ptr<std::byte, Free>(memory), size});
    }

    void* take_bytes(std::size_t size) {
        size = (size + line - 1) / line * line;
        if (chunks_.empty() || chunks_.back().size - used_ < size) {
            add_chunk(size);
            used_ = 0;
        }
        void* const result = chunks_.back().memory.get() + used_;
        used_ += size;
        return result;
    }

    std::vector<Chunk> chunks_; // the last one is in use
    std::size_t used_ = 0;      // of it
};

} // namespace raywise
