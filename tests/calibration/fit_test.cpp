#include "measure/fit.h"

#include "model/cost_units.h"
#include "model/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace raywise::calibration {
namespace {

std::vector<Point> points_of(double fixed, double per_unit, std::initializer_list<double> units) {
    std::vector<Point> points;
    for (const double unit : units) points.push_back({{unit}, fixed + per_unit * unit});
    return points;
}

TEST(FitCost, RecoversAnExactLine) {
    const LinearCost cost = fit_cost(points_of(120.0, 3.5, {1, 10, 500, 1e6, 3e7}), 1);
    EXPECT_NEAR(cost.fixed, 120.0, 1e-6);
    EXPECT_NEAR(cost.per_unit[0], 3.5, 1e-9);
    EXPECT_NEAR(cost.residual, 0.0, 1e-9);
}

TEST(FitCost, RecoversWhatGrowsWithSeveralUnits) {
    std::vector<Point> points;
    for (const double a : {1.0, 7.0, 40.0, 1000.0}) {
        for (const double b : {0.5, 30.0, 200.0}) {
            for (const double c : {2.0, 900.0}) points.push_back({{a, b, c}, 11.0 + 2.0 * a + 0.25 * c});
        }
    }
    const LinearCost cost = fit_cost(points, 3);
    EXPECT_NEAR(cost.fixed, 11.0, 1e-6);
    EXPECT_NEAR(cost.per_unit[0], 2.0, 1e-6);
    EXPECT_EQ(cost.per_unit[1], 0.0) << "costs do not grow with it";
    EXPECT_NEAR(cost.per_unit[2], 0.25, 1e-6);
    EXPECT_EQ(cost.per_unit[3], 0.0);
    EXPECT_NEAR(cost.residual, 0.0, 1e-6);
}

TEST(FitCost, TellsUnitsApartOnlyWhereTheyDiffer) {
    std::vector<Point> points;
    for (const double a : {1.0, 7.0, 40.0, 1000.0}) points.push_back({{a, 2.0 * a}, 5.0 * a});
    const LinearCost cost = fit_cost(points, 2);
    EXPECT_NEAR(cost.per_unit[0] + 2.0 * cost.per_unit[1], 5.0, 1e-9);
    EXPECT_TRUE(cost.per_unit[0] == 0.0 || cost.per_unit[1] == 0.0);
}

// What a unit costs is not told by points in which there is next to nothing of it, though it would fit them.
TEST(FitCost, LeavesOutUnitsThatNoPointHasOneOf) {
    std::vector<Point> points;
    for (const double a : {1.0, 7.0, 40.0}) {
        for (const double b : {0.0, 0.3}) points.push_back({{a, b}, 5.0 * a + 100.0 * b});
    }
    EXPECT_EQ(fit_cost(points, 2).per_unit[1], 0.0);
    points.push_back({{40.0, 1.0}, 300.0});
    EXPECT_NEAR(fit_cost(points, 2).per_unit[1], 100.0, 1e-6);
}

TEST(FitCost, RecoversALineThatStartsAtZeroAndOneThatDoesNotGrow) {
    const LinearCost growing = fit_cost(points_of(0.0, 7.0, {2, 20, 2000}), 1);
    EXPECT_NEAR(growing.fixed, 0.0, 1e-6);
    EXPECT_NEAR(growing.per_unit[0], 7.0, 1e-9);
    const LinearCost constant = fit_cost(points_of(42.0, 0.0, {2, 20, 2000}), 1);
    EXPECT_NEAR(constant.fixed, 42.0, 1e-9);
    EXPECT_NEAR(constant.per_unit[0], 0.0, 1e-9);
}

TEST(FitCost, HasNoNegativePart) {
    const LinearCost steep = fit_cost(points_of(-10.0, 5.0, {3, 10, 100}), 1);
    EXPECT_EQ(steep.fixed, 0.0);
    EXPECT_GT(steep.per_unit[0], 0.0);
    const LinearCost falling = fit_cost({{{1}, 100}, {{10}, 80}, {{100}, 60}}, 1);
    EXPECT_EQ(falling.per_unit[0], 0.0);
    EXPECT_GT(falling.fixed, 0.0);
    EXPECT_GT(falling.residual, 0.0);
}

TEST(FitCost, TwiceAndHalfCountAlike) {
    // One scene costs four times as much as foretold by the others: the middle of logarithms.
    const LinearCost cost = fit_cost({{{1}, 10}, {{1}, 40}}, 0);
    EXPECT_NEAR(cost.fixed, 20.0, 1e-3);
    EXPECT_NEAR(cost.residual, std::log(2.0), 1e-6);
    std::vector<Point> points;
    for (const double unit : {1.0, 10.0, 100.0, 1e3, 1e4, 1e5}) {
        points.push_back({{unit}, 2.0 * unit * 1.1});
        points.push_back({{unit}, 2.0 * unit / 1.1});
    }
    const LinearCost line = fit_cost(points, 1);
    EXPECT_NEAR(line.per_unit[0], 2.0, 1e-3);
    EXPECT_NEAR(line.residual, std::log(1.1), 1e-4);
}

TEST(FitCost, IsTheLeastOfItsNeighbours) {
    const std::vector<Point> points = {{{1}, 30}, {{5}, 31}, {{40}, 90}, {{300}, 700}, {{1000}, 1500}};
    const LinearCost best = fit_cost(points, 1);
    const auto misfit = [&](double fixed, double per_unit) {
        double sum = 0.0;
        for (const Point& p : points) sum += std::pow(std::log((fixed + per_unit * p.units[0]) / p.cost), 2);
        return std::sqrt(sum / static_cast<double>(points.size()));
    };
    EXPECT_NEAR(best.residual, misfit(best.fixed, best.per_unit[0]), 1e-12);
    for (const double f : {0.97, 1.0, 1.03}) {
        for (const double p : {0.97, 1.0, 1.03}) {
            EXPECT_GE(misfit(best.fixed * f, best.per_unit[0] * p), best.residual - 1e-4);
        }
    }
}

TEST(FitCost, BearsFewPoints) {
    EXPECT_EQ(fit_cost({}, 1).fixed, 0.0);
    EXPECT_EQ(fit_cost({{{10.0}, 0.0}}, 1).fixed, 0.0); // memory of nothing
    const LinearCost one = fit_cost({{{10.0}, 50.0}}, 1);
    EXPECT_NEAR(one.fixed + one.per_unit[0] * 10.0, 50.0, 1e-9);
    const LinearCost same = fit_cost({{{10.0, 3.0}, 50.0}, {{10.0, 3.0}, 50.0}}, 2);
    EXPECT_NEAR(same.fixed + same.per_unit[0] * 10.0 + same.per_unit[1] * 3.0, 50.0, 1e-9);
}

// Constants in which all costs differ, and the measurements a machine that obeys them would deliver.
MachineConstants known_constants() {
    MachineConstants constants;
    double next = 1.0;
    const auto cost_over = [&](const CostUnits& units, double fixed) {
        LinearCost cost;
        cost.fixed = fixed * ++next;
        for (std::size_t i = 0; i < units.size(); ++i) cost.per_unit[i] = next + 0.1 * static_cast<double>(i);
        return cost;
    };
    for (const Structure s : all_structures()) {
        StructureConstants& costs = constants.structures[s];
        costs.build_ns = cost_over(build_units(s), 1000.0);
        for (LinearCost& ray : costs.ray_ns) ray = cost_over(ray_units(s), 10.0);
        costs.bytes = cost_over(byte_units(s), 80.0);
    }
    constants.primitive_test_ns = 13.5;
    return constants;
}

Measurements obeying(const MachineConstants& constants) {
    std::vector<SceneFeatures> scenes;
    double other = 1.0;
    for (const double n : {12.0, 100.0, 1000.0, 10000.0, 80000.0, 300000.0}) {
        for (const double spread : {1.0, 3.0, 20.0}) {
            other = std::fmod(other * 7.0, 13.0);
            scenes.push_back(
                {n, spread * other, std::cbrt(n) + other, 5.0 / other + spread, spread * spread, 1.0 + other});
        }
    }
    Measurements m;
    m.primitive_test_ns = constants.primitive_test_ns;
    for (const Structure s : all_structures()) {
        const StructureConstants& costs = constants.structures[s];
        for (const SceneFeatures& scene : scenes) {
            m.builds.push_back(
                {s, scene, costs.build_ns.at(build_units(s), scene), costs.bytes.at(byte_units(s), scene)});
            for (std::size_t kind = 0; kind < measured_ray_kinds.size(); ++kind)
                m.rays.push_back({s, kind, scene, costs.ray_ns[kind].at(ray_units(s), scene)});
        }
    }
    return m;
}

TEST(Fit, RecoversKnownConstants) {
    const MachineConstants known = known_constants();
    const Measurements measurements = obeying(known);
    EXPECT_TRUE(suffices(measurements, 3));
    const MachineConstants found = fit(measurements);
    const auto expect_same = [&](const LinearCost& a, const LinearCost& b, const CostUnits& units, const char* name) {
        // Parts that cannot be seen beside the others are left out; what is foretold is the same.
        for (const BuildMeasurement& m : measurements.builds) {
            const double wanted = b.at(units, m.features);
            EXPECT_NEAR(a.at(units, m.features), wanted, 0.05 * wanted) << name;
        }
        EXPECT_LT(a.residual, 0.02) << name;
    };
    for (const Structure s : all_structures()) {
        expect_same(found.structures[s].build_ns, known.structures[s].build_ns, build_units(s), name_of(s));
        expect_same(found.structures[s].bytes, known.structures[s].bytes, byte_units(s), name_of(s));
        for (std::size_t kind = 0; kind < measured_ray_kinds.size(); ++kind) {
            expect_same(found.structures[s].ray_ns[kind], known.structures[s].ray_ns[kind], ray_units(s), name_of(s));
        }
    }
    EXPECT_EQ(found.primitive_test_ns, known.primitive_test_ns);
    EXPECT_GE(found.node_step_ns, found.primitive_test_ns / 20.0);
    EXPECT_LE(found.node_step_ns, found.primitive_test_ns * 2.0);
}

TEST(Fit, HapalaConstantsAreMeansOverScenesOfTheirSize) {
    Measurements m;
    m.builds = {{Structure::kd_tree, typical_features(1024), 1024 * 10 * 50.0, 1},
                {Structure::kd_tree, typical_features(4096), 4096 * 12 * 70.0, 1},
                {Structure::kd_tree, typical_features(100), 1e12, 1},
                {Structure::bvh, typical_features(1024), 1e12, 1}};
    m.rays = {{Structure::kd_tree, 0, typical_features(1024), 10 * 30.0},
              {Structure::kd_tree, 0, typical_features(4096), 12 * 40.0},
              {Structure::kd_tree, 0, typical_features(100), 1e12},
              {Structure::kd_tree, 1, typical_features(1024), 1e12},
              {Structure::bvh, 0, typical_features(1024), 1e12}};
    const MachineConstants found = fit(m);
    EXPECT_NEAR(found.hapala.build_ns_per_n_log_n, 60.0, 1e-9);
    EXPECT_NEAR(found.hapala.ray_ns_per_log_n, 35.0, 1e-9);
}

TEST(Fit, MissesWhatWasNotMeasured) {
    const Measurements all = obeying(known_constants());
    EXPECT_FALSE(suffices({}, 1));
    EXPECT_FALSE(suffices(all, 7));
    Measurements without_build = all;
    without_build.builds.erase(
        std::remove_if(without_build.builds.begin(), without_build.builds.end(),
                       [](const BuildMeasurement& b) { return b.structure == Structure::projected_bvh; }),
        without_build.builds.end());
    EXPECT_FALSE(suffices(without_build, 3));
    Measurements without_kind = all;
    without_kind.rays.erase(
        std::remove_if(without_kind.rays.begin(), without_kind.rays.end(),
                       [](const RayMeasurement& r) { return r.structure == Structure::bvh && r.kind == 3; }),
        without_kind.rays.end());
    EXPECT_FALSE(suffices(without_kind, 3));
}

TEST(Fit, MakesAProfileThatIsValid) {
    Profile profile;
    profile.machine = this_machine();
    profile.constants = fit(obeying(known_constants()));
    EXPECT_NO_THROW(parse_profile(to_json(profile)));
}

} // namespace
} // namespace raywise::calibration
