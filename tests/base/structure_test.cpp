#include "base/structure.h"

#include <gtest/gtest.h>

namespace raywise {
namespace {

TEST(Structure, NamesAndValuesAgree) {
    for (const Structure structure : all_structures()) EXPECT_EQ(structure_named(name_of(structure)), structure);
    EXPECT_FALSE(structure_named("octree"));
    EXPECT_FALSE(structure_named(""));
    EXPECT_FALSE(structure_named("BVH"));
}

TEST(PerStructure, HoldsOneValueEach) {
    PerStructure<int> values;
    int next = 1;
    for (const Structure structure : all_structures()) values[structure] = next++;
    next = 1;
    for (const Structure structure : all_structures()) EXPECT_EQ(values[structure], next++);
}

} // namespace
} // namespace raywise
