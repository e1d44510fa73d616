#include "model/cost_units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>

namespace raywise {
namespace {

SceneFeatures all_different(double triangles) { return {triangles, 5.5, 42.0, 3.25, 7.5, 2.125}; }

TEST(CostUnits, GrowAsTheirNamesSay) {
    for (const double n : {2.0, 12.0, 1000.0, 1e6}) {
        const SceneFeatures scene = all_different(n);
        const std::map<std::string, double> values = {{"N", n},
                                                      {"log2 N", std::log2(n)},
                                                      {"N log2 N", n * std::log2(n)},
                                                      {"references", n * 2.125},
                                                      {"boxes", 5.5},
                                                      {"cells", 42.0},
                                                      {"filled", 3.25},
                                                      {"crowding", 7.5},
                                                      {"far levels", std::fmax(0.0, std::log2(n / 32768))}};
        for (const Structure structure : all_structures()) {
            for (const auto* units : {&build_units(structure), &ray_units(structure), &byte_units(structure)}) {
                ASSERT_GE(units->size(), 1u);
                std::set<std::string> names;
                for (const CostUnit& unit : *units) {
                    ASSERT_EQ(values.count(unit.name), 1u) << unit.name;
                    EXPECT_DOUBLE_EQ(unit.of(scene), values.at(unit.name)) << unit.name;
                    EXPECT_TRUE(names.insert(unit.name).second) << unit.name << " twice";
                }
            }
        }
    }
}

TEST(CostUnits, AreSoundForNoneAndOneTriangle) {
    for (const Structure structure : all_structures()) {
        for (const auto* units : {&build_units(structure), &ray_units(structure), &byte_units(structure)}) {
            for (const CostUnit& unit : *units) {
                double before = 0.0;
                for (const double n : {0.0, 1.0, 2.0, 1e9}) {
                    const double value = unit.of(all_different(n));
                    EXPECT_TRUE(std::isfinite(value) && value >= before) << unit.name << " " << n;
                    before = value;
                }
            }
        }
    }
}

TEST(CostUnits, OnlyTheProjectedStructureNeedsAView) {
    for (const Structure s : all_structures()) EXPECT_EQ(needs_view(s), s == Structure::projected_bvh) << name_of(s);
}

} // namespace
} // namespace raywise
