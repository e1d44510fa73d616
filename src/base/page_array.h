// A large array without initial values, in pages of 2 MiB where the system has them: rays jump all over a structure, and with
// pages of 4 KiB each jump would also miss the table of pages. Its memory may be that of an array released before (base/page_pool.h): it
// holds anything, and whoever reads an element has written it or knows that it is masked out.
#pragma once

#include "base/page_pool.h"

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace raywise {

template <class T>
class PageArray {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    PageArray() = default;
    // Aligned to cache lines. Throws std::bad_alloc.
    explicit PageArray(std::size_t size)
        : memory_(size == 0 ? nullptr : take_pages(size * sizeof(T)), Release{size * sizeof(T)}), size_(size) {}

    PageArray(PageArray&& other) noexcept : memory_(std::move(other.memory_)), size_(std::exchange(other.size_, 0)) {}
    PageArray& operator=(PageArray&& other) noexcept {
        memory_ = std::move(other.memory_);
        size_ = std::exchange(other.size_, 0);
        return *this;
    }

    T* data() { return reinterpret_cast<T*>(memory_.get()); }
    const T* data() const { return reinterpret_cast<const T*>(memory_.get()); }
    T& operator[](std::size_t i) { return data()[i]; }
    const T& operator[](std::size_t i) const { return data()[i]; }
    T* begin() { return data(); }
    T* end() { return data() + size_; }
    const T* begin() const { return data(); }
    const T* end() const { return data() + size_; }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    std::size_t bytes() const { return size_ * sizeof(T); }

private:
    struct Release {
        std::size_t bytes;
        void operator()(std::byte* memory) const noexcept { give_pages(memory, bytes); }
    };

    std::unique_ptr<std::byte, Release> memory_{nullptr, Release{0}};
    std::size_t size_ = 0;
};

// The same memory for arrays that grow, or begin with values.
template <class T>
struct PageAllocator {
    using value_type = T;

    PageAllocator() = default;
    template <class Other>
    PageAllocator(const PageAllocator<Other>&) noexcept {} // NOLINT: containers convert it

    T* allocate(std::size_t n) { return reinterpret_cast<T*>(take_pages(n * sizeof(T))); }
    void deallocate(T* memory, std::size_t n) noexcept {
        give_pages(reinterpret_cast<std::byte*>(memory), n * sizeof(T));
    }

    template <class Other>
    bool operator==(const PageAllocator<Other>&) const noexcept {
        return true;
    }
    template <class Other>
    bool operator!=(const PageAllocator<Other>&) const noexcept {
        return false;
    }
};

template <class T>
using PageVector = std::vector<T, PageAllocator<T>>;

} // namespace raywise
