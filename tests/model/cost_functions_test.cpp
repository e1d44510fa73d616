#include "model/cost_functions.h"

#include <gtest/gtest.h>

#include <optional>

namespace raywise {
namespace {

MachineConstants constants_of_bvh() {
    MachineConstants constants;
    StructureConstants& bvh = constants.structures[Structure::bvh];
    bvh.build_ns = {1000, {3, 30}, 0.1};
    bvh.ray_ns = {LinearCost{50, {10}, 0.2}, LinearCost{40, {5, 2, 3}, 0.05}, LinearCost{30, {4}, 0.3},
                  LinearCost{60, {20}, 0.4}};
    bvh.bytes = {100, {64}, 0.0};
    return constants;
}

SceneFeatures features_of(std::uint64_t triangles) { return typical_features(triangles); }

TEST(Predict, AddsTheFixedPartAndThePartsThatGrow) {
    const SceneFeatures features = features_of(1024);
    const Cost cost = predict(Structure::bvh, constants_of_bvh(), features, {1000, RayKind::camera});
    EXPECT_DOUBLE_EQ(cost.build_ns, 1000 + 3 * 1024 + 30 * 1024 * 10);
    EXPECT_DOUBLE_EQ(cost.ray_ns, 40 + 5 * 10 + 2 * features.filled + 3 * features.boxes);
    EXPECT_DOUBLE_EQ(cost.bytes, 100 + 64 * 1024);
    EXPECT_DOUBLE_EQ(cost.error, 0.1);
    EXPECT_DOUBLE_EQ(cost.total_ns(10), cost.build_ns + 10 * cost.ray_ns);
}

TEST(Predict, TakesTheLineOfTheRayKind) {
    SceneFeatures features;
    features.triangles = 2.0;
    const auto ray_ns = [&](RayKind kind) {
        return predict(Structure::bvh, constants_of_bvh(), features, {std::nullopt, kind}).ray_ns;
    };
    EXPECT_DOUBLE_EQ(ray_ns(RayKind::any), 60);
    EXPECT_DOUBLE_EQ(ray_ns(RayKind::random), 60);
    EXPECT_DOUBLE_EQ(ray_ns(RayKind::camera), 45);
    EXPECT_DOUBLE_EQ(ray_ns(RayKind::shadow), 34);
    EXPECT_DOUBLE_EQ(ray_ns(RayKind::diffuse), 80);
}

TEST(Predict, TellsTheLargerMisfit) {
    const auto error = [](RayKind kind) {
        return predict(Structure::bvh, constants_of_bvh(), {}, {std::nullopt, kind}).error;
    };
    EXPECT_DOUBLE_EQ(error(RayKind::camera), 0.1);
    EXPECT_DOUBLE_EQ(error(RayKind::shadow), 0.3);
}

TEST(Within, OnlyWhatCanDoWithoutIsTakenSmaller) {
    Cost cost;
    cost.build_ns = 1e6;
    cost.ray_ns = 100;
    cost.bytes = 40'000;
    const SceneFeatures features = features_of(1000);
    MachineConstants constants;
    constants.structures[Structure::linear_scan].bytes.fixed = 120;
    const auto cost_within = [&](Structure structure, double bytes) {
        return within(structure, constants, cost, features, bytes);
    };
    const Cost half = cost_within(Structure::uniform_grid, 20'000);
    EXPECT_EQ(half.bytes, 20'000);
    EXPECT_EQ(half.ray_ns, 200);
    EXPECT_EQ(half.build_ns, 1e6);
    EXPECT_EQ(cost_within(Structure::uniform_grid, 40'000).ray_ns, 100);
    EXPECT_EQ(cost_within(Structure::uniform_grid, 7'999).bytes, 40'000) << "no room for the references";
    for (const double bytes : {1.0, 39'999.0}) {
        EXPECT_EQ(cost_within(Structure::linear_scan, bytes).bytes, 120);
        EXPECT_EQ(cost_within(Structure::linear_scan, bytes).ray_ns, 100);
    }
    EXPECT_EQ(cost_within(Structure::linear_scan, 40'000).bytes, 40'000);
    for (const Structure structure : all_structures()) {
        const bool is_smaller = cost_within(structure, 20'000).bytes < cost.bytes;
        EXPECT_EQ(is_smaller, spared(structure) != Spared::nothing) << name_of(structure);
    }
    EXPECT_EQ(spared(Structure::bvh), Spared::nothing);
}

// A scan of few rays reads the caller's arrays, and keeps nothing.
TEST(Predict, HasFewRaysScanInPlace) {
    MachineConstants constants;
    StructureConstants& scan = constants.structures[Structure::linear_scan];
    scan.build_ns = {100, {4}, 0.1};
    for (LinearCost& ray : scan.ray_ns) ray = {50, {0.5}, 0.2};
    scan.bytes = {120, {36}, 0.0};
    const SceneFeatures features = features_of(1000);
    for (const std::optional<std::uint64_t> rays :
         {std::optional<std::uint64_t>(), std::optional<std::uint64_t>(1000)}) {
        const Cost cost = predict(Structure::linear_scan, constants, features, {rays, RayKind::any});
        EXPECT_DOUBLE_EQ(cost.build_ns, 4100);
        EXPECT_DOUBLE_EQ(cost.ray_ns, 550);
        EXPECT_DOUBLE_EQ(cost.bytes, 36120);
    }
    const Cost cost = predict(Structure::linear_scan, constants, features, {1, RayKind::any});
    EXPECT_DOUBLE_EQ(cost.build_ns, 4100);
    EXPECT_DOUBLE_EQ(cost.ray_ns, 550);
    EXPECT_DOUBLE_EQ(cost.bytes, 120);
}

} // namespace
} // namespace raywise
