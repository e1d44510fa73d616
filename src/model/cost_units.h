// The quantities that costs grow with. One line per structure in cost_units.cpp.
#pragma once

#include "base/structure.h"
#include "model/scene_features.h"

#include <array>
#include <cstddef>

namespace raywise {

struct CostUnit {
    const char* name = nullptr;
    double (*of)(const SceneFeatures& features) = nullptr;
};

// So many at most for one cost.
inline constexpr std::size_t most_cost_units = 4;

class CostUnits {
public:
    template <class... Units>
    constexpr explicit CostUnits(const Units&... units) : units_{units...}, count_(sizeof...(units)) {}

    constexpr std::size_t size() const { return count_; }
    constexpr const CostUnit& operator[](std::size_t i) const { return units_[i]; }
    constexpr const CostUnit* begin() const { return units_.data(); }
    constexpr const CostUnit* end() const { return units_.data() + count_; }

private:
    std::array<CostUnit, most_cost_units> units_;
    std::size_t count_;
};

const CostUnits& build_units(Structure structure);
const CostUnits& ray_units(Structure structure);
const CostUnits& byte_units(Structure structure);

// Whether the structure needs a view to differ from another candidate; without one it is no candidate.
bool needs_view(Structure structure);
// Whether it is made otherwise for few rays than for many.
bool differs_by_rays(Structure structure);

// What a structure does without where memory is short.
enum class Spared {
    nothing,
    blocks, // that a scan copies its triangles to
    cells   // of a grid, which are fewer then
};
Spared spared(Structure structure);

} // namespace raywise
