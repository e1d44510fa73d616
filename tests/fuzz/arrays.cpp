#include "fuzz/arrays.h"

#include <algorithm>
#include <cstdlib>
#include <initializer_list>

namespace raywise::fuzz {
namespace {

std::size_t size_of(std::int32_t type) {
    return type == RW_UINT8 ? 1 : type == RW_FLOAT32 || type == RW_UINT32 ? 4 : 8;
}

// Fills in the strides that 0 and RW_REPEAT stand for.
std::int64_t real_stride(const Layout& layout) {
    if (layout.stride == RW_REPEAT) return 0;
    return layout.stride == 0 ? static_cast<std::int64_t>(layout.scalar) * layout.components : layout.stride;
}
std::int64_t real_component_stride(const Layout& layout) {
    return layout.component_stride == 0 ? static_cast<std::int64_t>(layout.scalar) : layout.component_stride;
}

std::int64_t offset(const Layout& layout, std::uint64_t element, int component) {
    return static_cast<std::int64_t>(element) * real_stride(layout) + component * real_component_stride(layout);
}

// The lowest and the highest byte are those of corners of the index range.
void measure(Layout& layout) {
    std::int64_t lowest = 0;
    std::int64_t highest = 0;
    if (layout.count > 0) {
        for (const std::uint64_t element : {std::uint64_t{0}, layout.count - 1}) {
            for (const int component : {0, layout.components - 1}) {
                lowest = std::min(lowest, offset(layout, element, component));
                highest =
                    std::max(highest, offset(layout, element, component) + static_cast<std::int64_t>(layout.scalar));
            }
        }
    }
    layout.first = -lowest;
    layout.bytes = static_cast<std::size_t>(highest - lowest);
}

enum class Shape {
    packed,
    rows,             // one element behind the other, with room between
    columns,          // all x, then all y, then all z
    backwards,        // the last element first
    columns_reversed, // z before y before x
    any,              // whatever the bytes say: elements may overlap
    repeat
};

Layout make_layout(Input& input, std::uint64_t count, int components, std::size_t scalar) {
    static constexpr Shape shapes[] = {Shape::packed,    Shape::packed,           Shape::rows, Shape::columns,
                                       Shape::backwards, Shape::columns_reversed, Shape::any,  Shape::repeat};
    Layout layout;
    layout.count = count;
    layout.components = components;
    layout.scalar = scalar;
    const auto size = static_cast<std::int64_t>(scalar);
    const auto room = [&] { return input.between<std::int64_t>(0, 5); };
    switch (input.pick(shapes)) {
        case Shape::packed:
            break;
        case Shape::rows:
            layout.component_stride = size + room();
            layout.stride = components * layout.component_stride + room();
            break;
        case Shape::columns:
            layout.stride = size + room();
            layout.component_stride = static_cast<std::int64_t>(count) * layout.stride + room();
            break;
        case Shape::backwards:
            layout.stride = -(components * size + room());
            break;
        case Shape::columns_reversed:
            layout.stride = size + room();
            layout.component_stride = -(static_cast<std::int64_t>(count) * layout.stride + room());
            break;
        case Shape::any:
            layout.stride = input.between<std::int64_t>(-40, 40);
            layout.component_stride = input.between<std::int64_t>(-40, 40);
            break;
        case Shape::repeat:
            layout.stride = RW_REPEAT;
            break;
    }
    measure(layout);
    return layout;
}

// Memory that the address sanitizer watches the end of; the first element need not be aligned.
std::vector<unsigned char> memory(Input& input, Layout& layout) {
    const auto lead = input.between<std::int64_t>(0, 3);
    layout.first += lead;
    std::vector<unsigned char> bytes(layout.bytes + static_cast<std::size_t>(lead), 0xA5);
    bytes.reserve(std::max<std::size_t>(bytes.size(), 1)); // also without an element there is an address
    return bytes;
}

} // namespace

std::size_t Layout::at(std::uint64_t element, int component) const {
    return static_cast<std::size_t>(first + offset(*this, element, component));
}

bool Layout::overlaps() const {
    std::vector<std::size_t> starts;
    for (std::uint64_t i = 0; i < count; ++i) {
        for (int c = 0; c < components; ++c) starts.push_back(at(i, c));
    }
    std::sort(starts.begin(), starts.end());
    for (std::size_t i = 1; i < starts.size(); ++i) {
        if (starts[i] - starts[i - 1] < scalar) return true;
    }
    return false;
}

InputArray::InputArray(Input& input, std::uint64_t count, int components, std::int32_t type, std::int32_t usual)
    : type_(type), layout_(make_layout(input, count, components, size_of(type))) {
    bytes_ = std::make_shared<std::vector<unsigned char>>(memory(input, layout_));
    array_.data = bytes_->data() + layout_.first;
    array_.stride = layout_.stride;
    array_.component_stride = layout_.component_stride;
    array_.type = type == usual && input.one_in(2) ? RW_TYPE_DEFAULT : type;
}

InputArray InputArray::numbers(Input& input, std::uint64_t count, int components,
                               const std::function<double(std::uint64_t, int)>& value) {
    InputArray result(input, count, components, input.one_in(2) ? RW_FLOAT64 : RW_FLOAT32, RW_FLOAT32);
    for (std::uint64_t i = 0; i < count; ++i) {
        for (int c = 0; c < components; ++c) {
            const double number = value(i, c);
            const auto single = static_cast<float>(number);
            unsigned char* target = result.bytes_->data() + result.layout_.at(i, c);
            if (result.type_ == RW_FLOAT32) {
                std::memcpy(target, &single, sizeof single);
            } else {
                std::memcpy(target, &number, sizeof number);
            }
        }
    }
    result.before_ = *result.bytes_;
    return result;
}

InputArray InputArray::ids(Input& input, std::uint64_t count, int components,
                           const std::function<std::uint64_t(std::uint64_t, int)>& value) {
    InputArray result(input, count, components, input.one_in(2) ? RW_UINT64 : RW_UINT32, RW_UINT32);
    for (std::uint64_t i = 0; i < count; ++i) {
        for (int c = 0; c < components; ++c) {
            const std::uint64_t id = value(i, c);
            const auto narrow = static_cast<std::uint32_t>(id);
            unsigned char* target = result.bytes_->data() + result.layout_.at(i, c);
            if (result.type_ == RW_UINT32) {
                std::memcpy(target, &narrow, sizeof narrow);
            } else {
                std::memcpy(target, &id, sizeof id);
            }
        }
    }
    result.before_ = *result.bytes_;
    return result;
}

const unsigned char* InputArray::address(std::uint64_t element, int component) const {
    return bytes_->data() + layout_.at(element, component);
}

double InputArray::number(std::uint64_t element, int component) const {
    if (type_ == RW_FLOAT32) {
        float value;
        std::memcpy(&value, address(element, component), sizeof value);
        return static_cast<double>(value);
    }
    double value;
    std::memcpy(&value, address(element, component), sizeof value);
    return value;
}

std::uint64_t InputArray::id(std::uint64_t element, int component) const {
    if (type_ == RW_UINT32) {
        std::uint32_t value;
        std::memcpy(&value, address(element, component), sizeof value);
        return value;
    }
    std::uint64_t value;
    std::memcpy(&value, address(element, component), sizeof value);
    return value;
}

OutputArray::OutputArray(Input& input, std::uint64_t count, int components, OutputKind kind) {
    static constexpr std::int32_t types[3][3] = {
        {RW_FLOAT32, RW_FLOAT64, RW_FLOAT64}, {RW_UINT32, RW_UINT64, RW_UINT64}, {RW_UINT8, RW_UINT32, RW_UINT64}};
    const auto& choice = types[static_cast<std::size_t>(kind)];
    type_ = input.pick(choice);
    layout_ = make_layout(input, count, components, size_of(type_));
    bytes_ = memory(input, layout_);
    blank_ = expected_ = bytes_;
    output_.data = bytes_.data() + layout_.first;
    output_.stride = layout_.stride;
    output_.component_stride = layout_.component_stride;
    output_.type = type_ == choice[0] && input.one_in(2) ? RW_TYPE_DEFAULT : type_;
    has_wrong_strides_ = layout_.stride == RW_REPEAT || layout_.overlaps();
    if (input.one_in(64)) {
        static constexpr std::int32_t wrong[3] = {RW_UINT32, RW_FLOAT32, RW_FLOAT64};
        output_.type = input.one_in(2) ? wrong[static_cast<std::size_t>(kind)] : 6 + input.between(0, 2);
        has_wrong_type_ = true;
    }
    if (input.one_in(64)) {
        output_.reserved = 1 << input.below(31);
        has_wrong_reserved_ = true;
    }
    if (count == 0 && !has_wrong_strides_) {
        Layout one = layout_;
        one.count = 1;
        measure(one);
        is_doubtful_ = one.overlaps();
    }
}

void OutputArray::complain(Outcome& outcome) const {
    outcome.fails_if(has_wrong_type_, RW_ERROR_INVALID_ARGUMENT)
        .fails_if(has_wrong_reserved_, RW_ERROR_RESERVED)
        .fails_if(has_wrong_strides_, RW_ERROR_OVERLAP)
        .may_fail_if(is_doubtful_, RW_ERROR_OVERLAP);
}

template <class T>
void OutputArray::store(std::uint64_t element, int component, T value) {
    std::memcpy(expected_.data() + layout_.at(element, component), &value, sizeof value);
}

void OutputArray::expect_number(std::uint64_t element, int component, double value) {
    if (!is_wanted() || is_wrong()) return;
    if (type_ == RW_FLOAT32) {
        store(element, component, static_cast<float>(value));
    } else {
        store(element, component, value);
    }
}

void OutputArray::expect_id(std::uint64_t element, std::uint32_t id) {
    if (!is_wanted() || is_wrong()) return;
    if (type_ == RW_UINT32) {
        store(element, 0, id);
    } else {
        store(element, 0, id == RW_INVALID_ID ? ~std::uint64_t{0} : std::uint64_t{id});
    }
}

void OutputArray::expect_flag(std::uint64_t element, bool flag) {
    if (!is_wanted() || is_wrong()) return;
    if (type_ == RW_UINT8) {
        store(element, 0, static_cast<std::uint8_t>(flag));
    } else if (type_ == RW_UINT32) {
        store(element, 0, static_cast<std::uint32_t>(flag));
    } else {
        store(element, 0, static_cast<std::uint64_t>(flag));
    }
}

bool OutputArray::is_partly_answered() {
    for (std::size_t i = 0; i < bytes_.size(); ++i) {
        if (bytes_[i] != blank_[i] && bytes_[i] != expected_[i]) return was(false);
    }
    return was(true);
}

} // namespace raywise::fuzz
