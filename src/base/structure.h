// The structures as an enumeration, made from structure_list.def.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace raywise {

enum class Structure {
#define RW_STRUCTURE(name, type) name,
#include "base/structure_list.def"
#undef RW_STRUCTURE
};

inline constexpr std::array structure_names = {
#define RW_STRUCTURE(name, type) #name,
#include "base/structure_list.def"
#undef RW_STRUCTURE
};

inline constexpr std::size_t structure_count = structure_names.size();

constexpr const char* name_of(Structure structure) { return structure_names[static_cast<std::size_t>(structure)]; }

inline std::optional<Structure> structure_named(std::string_view name) {
    for (std::size_t i = 0; i < structure_count; ++i) {
        if (name == structure_names[i]) return static_cast<Structure>(i);
    }
    return std::nullopt;
}

// A value for each structure, indexed by the enumeration.
template <class T>
class PerStructure {
public:
    T& operator[](Structure structure) { return values_[static_cast<std::size_t>(structure)]; }
    const T& operator[](Structure structure) const { return values_[static_cast<std::size_t>(structure)]; }

private:
    std::array<T, structure_count> values_{};
};

// for (Structure s : all_structures()) ...
inline constexpr auto all_structures() {
    std::array<Structure, structure_count> all{};
    for (std::size_t i = 0; i < structure_count; ++i) all[i] = static_cast<Structure>(i);
    return all;
}

} // namespace raywise
