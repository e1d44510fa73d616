#include "model/cost_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace raywise {
namespace {

TEST(CostFunctions, GrowAsTheirNamesSay) {
    const auto value = [](const std::string& name, double n) {
        if (name == "N") return n;
        if (name == "N log2 N") return n * std::log2(n);
        if (name == "log2 N") return std::log2(n);
        if (name == "N^(1/3)") return std::cbrt(n);
        ADD_FAILURE() << "unknown unit " << name;
        return 0.0;
    };
    for (const Structure s : all_structures()) {
        for (const double n : {2.0, 12.0, 1000.0, 1e6}) {
            EXPECT_DOUBLE_EQ(build_unit(s, n), value(build_unit_name(s), n)) << name_of(s);
            EXPECT_DOUBLE_EQ(ray_unit(s, n), value(ray_unit_name(s), n)) << name_of(s);
        }
    }
}

TEST(CostFunctions, HaveTheExpectedUnits) {
    EXPECT_STREQ(build_unit_name(Structure::linear_scan), "N");
    EXPECT_STREQ(ray_unit_name(Structure::linear_scan), "N");
    EXPECT_STREQ(build_unit_name(Structure::uniform_grid), "N");
    EXPECT_STREQ(ray_unit_name(Structure::uniform_grid), "N^(1/3)");
    for (const Structure s : {Structure::kd_tree, Structure::bvh, Structure::projected_bvh, Structure::bvh_quality}) {
        EXPECT_STREQ(build_unit_name(s), "N log2 N");
        EXPECT_STREQ(ray_unit_name(s), "log2 N");
    }
    EXPECT_STREQ(build_unit_name(Structure::bvh_morton), "N");
    EXPECT_STREQ(ray_unit_name(Structure::bvh_morton), "log2 N");
}

TEST(CostFunctions, AreSoundForNoneAndOneTriangle) {
    for (const Structure s : all_structures()) {
        for (const double n : {0.0, 1.0}) {
            EXPECT_TRUE(std::isfinite(build_unit(s, n)) && build_unit(s, n) >= 0.0) << name_of(s) << n;
            EXPECT_TRUE(std::isfinite(ray_unit(s, n)) && ray_unit(s, n) >= 0.0) << name_of(s) << n;
        }
        EXPECT_LE(build_unit(s, 0), build_unit(s, 1));
        EXPECT_LE(build_unit(s, 1), build_unit(s, 2));
        EXPECT_LE(ray_unit(s, 1), ray_unit(s, 2));
    }
}

TEST(CostFunctions, OnlyTheProjectedStructureNeedsAView) {
    for (const Structure s : all_structures()) EXPECT_EQ(needs_view(s), s == Structure::projected_bvh) << name_of(s);
}

MachineConstants constants_of_bvh() {
    MachineConstants constants;
    StructureConstants& bvh = constants.structures[Structure::bvh];
    bvh.build_ns = {1000, 30, 0.1};
    bvh.ray_ns = {CostLine{50, 10, 0.2}, CostLine{40, 5, 0.05}, CostLine{30, 4, 0.3}, CostLine{60, 20, 0.4}};
    bvh.bytes = {100, 64, 0.0};
    return constants;
}

TEST(Predict, AddsTheFixedPartAndThePartThatGrows) {
    SceneFeatures features;
    features.triangles = 1024;
    const Cost cost = predict(Structure::bvh, constants_of_bvh(), features, {1000, RayKind::camera});
    EXPECT_DOUBLE_EQ(cost.build_ns, 1000 + 30 * 1024 * 10);
    EXPECT_DOUBLE_EQ(cost.ray_ns, 40 + 5 * 10);
    EXPECT_DOUBLE_EQ(cost.bytes, 100 + 64 * 1024);
    EXPECT_DOUBLE_EQ(cost.error, 0.1);
    EXPECT_DOUBLE_EQ(cost.total_ns(10), cost.build_ns + 10 * cost.ray_ns);
}

TEST(Predict, TakesTheLineOfTheRayKind) {
    SceneFeatures features;
    features.triangles = 2;
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

// A scan that reads the caller's arrays builds and keeps nothing; its rays gather on their way.
TEST(Predict, HasFewRaysScanInPlace) {
    MachineConstants constants;
    StructureConstants& scan = constants.structures[Structure::linear_scan];
    scan.build_ns = {100, 4, 0.1};
    for (CostLine& line : scan.ray_ns) line = {50, 0.5, 0.2};
    scan.bytes = {120, 36, 0.0};
    SceneFeatures features;
    features.triangles = 1000;
    for (const std::optional<std::uint64_t> rays :
         {std::optional<std::uint64_t>(), std::optional<std::uint64_t>(1000)}) {
        const Cost cost = predict(Structure::linear_scan, constants, features, {rays, RayKind::any});
        EXPECT_DOUBLE_EQ(cost.build_ns, 4100);
        EXPECT_DOUBLE_EQ(cost.ray_ns, 550);
        EXPECT_DOUBLE_EQ(cost.bytes, 36120);
    }
    const Cost cost = predict(Structure::linear_scan, constants, features, {1, RayKind::any});
    EXPECT_DOUBLE_EQ(cost.build_ns, 100);
    EXPECT_DOUBLE_EQ(cost.ray_ns, 4550);
    EXPECT_DOUBLE_EQ(cost.bytes, 120);
}

} // namespace
} // namespace raywise
