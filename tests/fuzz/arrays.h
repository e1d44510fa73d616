// Arrays of the caller's in every layout that rw_array and rw_output can describe, in memory that ends with the last element.
#pragma once

#include "fuzz/failure.h"
#include "fuzz/input.h"
#include "raywise/raywise.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace raywise::fuzz {

// Where component c of element i is, relative to the lowest byte any of them has.
struct Layout {
    std::int64_t stride = 0;           // as handed to the library; 0: packed
    std::int64_t component_stride = 0; // 0: size of the type
    std::int64_t first = 0;            // of element 0, component 0
    std::size_t bytes = 0;             // that the whole array spans
    std::size_t scalar = 0;            // size of one number
    std::uint64_t count = 0;
    int components = 0;

    std::size_t at(std::uint64_t element, int component) const;
    bool overlaps() const; // whether two numbers share a byte
};

// An input: whatever layout, elements that overlap included.
class InputArray {
public:
    InputArray() = default; // absent
    // numbers: RW_FLOAT32 or RW_FLOAT64, ids: RW_UINT32 or RW_UINT64. The values are written in order; where elements overlap the
    // last one stays.
    static InputArray numbers(Input& input, std::uint64_t count, int components,
                              const std::function<double(std::uint64_t, int)>& value);
    static InputArray ids(Input& input, std::uint64_t count, int components,
                          const std::function<std::uint64_t(std::uint64_t, int)>& value);

    bool is_absent() const { return array_.data == nullptr; }
    const rw_array& array() const { return array_; }
    std::int32_t type() const { return type_; }
    // As it stands in memory.
    double number(std::uint64_t element, int component) const;
    std::uint64_t id(std::uint64_t element, int component) const;

    bool is_unchanged() const { return *bytes_ == before_; }

private:
    InputArray(Input& input, std::uint64_t count, int components, std::int32_t type, std::int32_t usual);
    const unsigned char* address(std::uint64_t element, int component) const;

    rw_array array_{};
    std::int32_t type_ = RW_TYPE_DEFAULT;
    Layout layout_;
    std::shared_ptr<std::vector<unsigned char>> bytes_; // shared: copies describe the same memory
    std::vector<unsigned char> before_;
};

enum class OutputKind {
    numbers,
    ids,
    flags
};

// An output, and what is to be in it afterwards.
class OutputArray {
public:
    OutputArray() = default; // not wanted
    OutputArray(Input& input, std::uint64_t count, int components, OutputKind kind);
    OutputArray(OutputArray&&) = default; // its description points into its memory
    OutputArray& operator=(OutputArray&&) = default;

    bool is_wanted() const { return output_.data != nullptr; }
    bool is_wrong() const { return has_wrong_type_ || has_wrong_reserved_ || has_wrong_strides_; } // must be refused
    // What is wrong and may be wrong. The doubtful: no element, yet a layout in which elements would overlap.
    void complain(Outcome& outcome) const;
    const rw_output& output() const { return output_; }

    void expect_number(std::uint64_t element, int component, double value);
    void expect_id(std::uint64_t element, std::uint32_t id);
    void expect_flag(std::uint64_t element, bool flag);

    // Whether the memory is now as expected, as it was, or (every byte) one or the other. Each makes it as it was before.
    bool is_answered() { return was(bytes_ == expected_); }
    bool is_untouched() { return was(bytes_ == blank_); }
    bool is_partly_answered();

private:
    bool was(bool holds) {
        bytes_ = blank_;
        return holds;
    }
    template <class T>
    void store(std::uint64_t element, int component, T value);

    rw_output output_{};
    std::int32_t type_ = RW_TYPE_DEFAULT;
    Layout layout_;
    bool has_wrong_type_ = false;
    bool has_wrong_reserved_ = false;
    bool has_wrong_strides_ = false;
    bool is_doubtful_ = false;
    std::vector<unsigned char> bytes_;
    std::vector<unsigned char> blank_;
    std::vector<unsigned char> expected_;
};

} // namespace raywise::fuzz
