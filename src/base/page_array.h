// A large array without initial values, in pages of 2 MiB where the system has them: rays jump all over a structure, and with
// pages of 4 KiB each jump would also miss the table of pages.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace raywise {

// Aligned to cache lines. Throws std::bad_alloc.
class PageMemory {
public:
    PageMemory() : memory_(nullptr, Release{std::align_val_t{1}}) {}
    explicit PageMemory(std::size_t bytes);

    std::byte* data() const { return memory_.get(); }

private:
    struct Release {
        std::align_val_t alignment;
        void operator()(std::byte* memory) const noexcept;
    };
    using Memory = std::unique_ptr<std::byte, Release>;
    Memory memory_;
};

template <class T>
class PageArray {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    PageArray() = default;
    explicit PageArray(std::size_t size)
        : memory_(size == 0 ? PageMemory() : PageMemory(size * sizeof(T))), size_(size) {}

    PageArray(PageArray&& other) noexcept : memory_(std::move(other.memory_)), size_(std::exchange(other.size_, 0)) {}
    PageArray& operator=(PageArray&& other) noexcept {
        memory_ = std::move(other.memory_);
        size_ = std::exchange(other.size_, 0);
        return *this;
    }

    T* data() { return reinterpret_cast<T*>(memory_.data()); }
    const T* data() const { return reinterpret_cast<const T*>(memory_.data()); }
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
    PageMemory memory_;
    std::size_t size_ = 0;
};

} // namespace raywise
