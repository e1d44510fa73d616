// Structs that begin with their size, as callers of all versions hand them over: in memory that ends where their size says.
#pragma once

#include "fuzz/failure.h"
#include "fuzz/input.h"
#include "raywise/raywise.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace raywise::fuzz {

// What an older program passes: to be specialised for structs that grow.
template <class T>
inline constexpr std::uint32_t oldest_size = sizeof(T);
template <>
inline constexpr std::uint32_t oldest_size<rw_commit_options> = offsetof(rw_commit_options, refit);
template <>
inline constexpr std::uint32_t oldest_size<rw_query_options> = offsetof(rw_query_options, workspace);

template <class T>
class CallerStruct {
public:
    // The size that fits, or, now and then, one of a newer program or a wrong one.
    CallerStruct(Input& input, const T& value) {
        std::uint32_t size = sizeof(T);
        if (oldest_size<T> < sizeof(T) && input.one_in(8)) {
            size = oldest_size<T>;
        } else if (input.one_in(32)) {
            static constexpr std::uint32_t odd[] = {sizeof(T) + 8, sizeof(T) + 24, sizeof(T) + 24, 0,          4,
                                                    sizeof(T) - 1, sizeof(T) - 8,  4097,           0xFFFFFFFFu};
            size = input.pick(odd);
        }
        is_wrong_ = (size < sizeof(T) && size != oldest_size<T>) || size > 4096;
        fill(size, value);
        if (size > sizeof(T) && !is_wrong_ && input.one_in(3)) { // sets a member this version does not know
            bytes_.back() = 1;
            is_wrong_ = true;
        }
        before_ = bytes_;
    }
    explicit CallerStruct(const T& value) {
        fill(sizeof(T), value);
        before_ = bytes_;
    }

    T* get() { return reinterpret_cast<T*>(bytes_.data()); }
    const T* get() const { return reinterpret_cast<const T*>(bytes_.data()); }
    bool is_wrong() const { return is_wrong_; }
    bool is_of_an_older_program() const { return size_ == oldest_size<T> && size_ < sizeof(T); }

    bool is_unchanged() const { return bytes_ == before_; }
    // For results: the size and whatever comes behind the known members stay as they are. Members that its program does not know are
    // zero.
    T result() const {
        const std::size_t known = std::min(bytes_.size(), sizeof(T));
        demand(std::memcmp(bytes_.data(), before_.data(), sizeof size_) == 0,
               "a result struct's struct_size was changed");
        demand(std::equal(bytes_.begin() + static_cast<std::ptrdiff_t>(known), bytes_.end(),
                          before_.begin() + static_cast<std::ptrdiff_t>(known)),
               "a result struct was written to behind its known members");
        T value{};
        std::memcpy(&value, bytes_.data(), known);
        return value;
    }

private:
    void fill(std::uint32_t size, const T& value) {
        size_ = size;
        // A vector's memory is exactly as large as asked for, and the address sanitizer watches its end.
        const std::size_t room = size > 4096 ? sizeof(T) : std::max<std::size_t>(size, sizeof size);
        bytes_.assign(room, 0);
        bytes_.shrink_to_fit();
        std::memcpy(bytes_.data(), &value, std::min(room, sizeof value));
        std::memcpy(bytes_.data(), &size, sizeof size);
    }

    std::vector<unsigned char> bytes_;
    std::vector<unsigned char> before_;
    std::uint32_t size_ = 0;
    bool is_wrong_ = false;
};

} // namespace raywise::fuzz
