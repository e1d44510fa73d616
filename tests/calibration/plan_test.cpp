#include "measure/plan.h"

#include "scenes/scenes.h"

#include <gtest/gtest.h>

#include <ostream>
#include <set>
#include <string>

namespace raywise::calibration {

void PrintTo(const Plan& plan, std::ostream* out) { *out << plan.mode; } // found by GoogleTest

namespace {

class Plans : public testing::TestWithParam<Plan> {};

TEST_P(Plans, CoverEveryScene) {
    std::set<std::string> planned;
    for (const MeshPlan& mesh : GetParam().meshes) {
        EXPECT_NE(workloads::scene_named(mesh.scene.c_str()), nullptr) << mesh.scene;
        planned.insert(mesh.scene);
    }
    EXPECT_EQ(planned.size(), workloads::scenes().size());
}

// Small, middle and large come first, so that a time limit leaves lines that can be drawn.
TEST_P(Plans, BeginWithSizesFarApart) {
    std::set<std::uint64_t> sizes;
    const std::vector<MeshPlan>& meshes = GetParam().meshes;
    for (std::size_t i = 0; i < meshes.size() / 2; ++i) sizes.insert(meshes[i].triangles);
    ASSERT_GE(sizes.size(), 3u);
    EXPECT_GT(static_cast<double>(*sizes.rbegin()), 100.0 * static_cast<double>(*sizes.begin()));
}

TEST_P(Plans, RepeatOftenEnoughForASpread) {
    EXPECT_GE(GetParam().ray_timing.repetitions, 3u);
    EXPECT_GE(GetParam().build_timing.repetitions, 3u);
    EXPECT_GT(GetParam().rays, 0u);
}

INSTANTIATE_TEST_SUITE_P(Both, Plans, testing::Values(quick_plan(), full_plan()),
                         [](const auto& test) { return test.param.mode; });

} // namespace
} // namespace raywise::calibration
