#include "measure/fit.h"

#include "model/cost_functions.h"
#include "model/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace raywise::calibration {
namespace {

std::vector<Point> points_of(double fixed, double per_unit, std::initializer_list<double> units) {
    std::vector<Point> points;
    for (const double unit : units) points.push_back({unit, fixed + per_unit * unit});
    return points;
}

TEST(FitLine, RecoversAnExactLine) {
    const CostLine line = fit_line(points_of(120.0, 3.5, {1, 10, 500, 1e6, 3e7}));
    EXPECT_NEAR(line.fixed, 120.0, 1e-6);
    EXPECT_NEAR(line.per_unit, 3.5, 1e-9);
    EXPECT_NEAR(line.residual, 0.0, 1e-9);
}

TEST(FitLine, RecoversALineThatStartsAtZeroAndOneThatDoesNotGrow) {
    const CostLine growing = fit_line(points_of(0.0, 7.0, {2, 20, 2000}));
    EXPECT_NEAR(growing.fixed, 0.0, 1e-6);
    EXPECT_NEAR(growing.per_unit, 7.0, 1e-9);
    const CostLine constant = fit_line(points_of(42.0, 0.0, {2, 20, 2000}));
    EXPECT_NEAR(constant.fixed, 42.0, 1e-9);
    EXPECT_NEAR(constant.per_unit, 0.0, 1e-9);
}

TEST(FitLine, HasNoNegativePart) {
    const CostLine steep = fit_line(points_of(-10.0, 5.0, {3, 10, 100}));
    EXPECT_EQ(steep.fixed, 0.0);
    EXPECT_GT(steep.per_unit, 0.0);
    const CostLine falling = fit_line({{1, 100}, {10, 80}, {100, 60}});
    EXPECT_EQ(falling.per_unit, 0.0);
    EXPECT_GT(falling.fixed, 0.0);
    EXPECT_GT(falling.residual, 0.0);
}

TEST(FitLine, WeighsRelativeMisfit) {
    // A tenth up and a tenth down: all count alike, so the line through the middle leaves a tenth.
    std::vector<Point> points;
    for (const double unit : {1.0, 10.0, 100.0, 1e3, 1e4, 1e5}) {
        points.push_back({unit, 2.0 * unit * 1.1});
        points.push_back({unit, 2.0 * unit * 0.9});
    }
    const CostLine line = fit_line(points);
    EXPECT_NEAR(line.per_unit, 2.0, 0.05);
    EXPECT_NEAR(line.residual, 0.1, 0.005);
}

TEST(FitLine, IsTheLeastOfItsNeighbours) {
    const std::vector<Point> points = {{1, 30}, {5, 31}, {40, 90}, {300, 700}, {1000, 1500}};
    const CostLine best = fit_line(points);
    const auto misfit = [&](double fixed, double per_unit) {
        double sum = 0.0;
        for (const Point& p : points) sum += std::pow((fixed + per_unit * p.unit) / p.cost - 1.0, 2);
        return std::sqrt(sum / static_cast<double>(points.size()));
    };
    EXPECT_NEAR(best.residual, misfit(best.fixed, best.per_unit), 1e-12);
    for (const double f : {0.99, 1.0, 1.01}) {
        for (const double p : {0.99, 1.0, 1.01}) {
            EXPECT_GE(misfit(best.fixed * f, best.per_unit * p), best.residual - 1e-12);
        }
    }
}

TEST(FitLine, BearsFewPoints) {
    EXPECT_EQ(fit_line({}).fixed, 0.0);
    EXPECT_EQ(fit_line({{10.0, 0.0}}).fixed, 0.0); // memory of nothing
    const CostLine one = fit_line({{10.0, 50.0}});
    EXPECT_NEAR(one.fixed + one.per_unit * 10.0, 50.0, 1e-9);
    const CostLine same = fit_line({{10.0, 50.0}, {10.0, 50.0}});
    EXPECT_NEAR(same.fixed + same.per_unit * 10.0, 50.0, 1e-9);
}

// Constants in which all lines differ, and the measurements a machine that obeys them would deliver.
MachineConstants known_constants() {
    MachineConstants constants;
    double next = 1.0;
    for (const Structure s : all_structures()) {
        StructureConstants& lines = constants.structures[s];
        lines.build_ns = {100.0 * ++next, next, 0.0};
        for (CostLine& line : lines.ray_ns) line = {10.0 * ++next, next, 0.0};
        lines.bytes = {8.0 * ++next, next, 0.0};
    }
    constants.primitive_test_ns = 13.5;
    return constants;
}

Measurements obeying(const MachineConstants& constants) {
    Measurements m;
    m.primitive_test_ns = constants.primitive_test_ns;
    for (const Structure s : all_structures()) {
        const StructureConstants& lines = constants.structures[s];
        for (const double n : {12.0, 100.0, 1000.0, 10000.0, 300000.0}) {
            m.builds.push_back({s, n, lines.build_ns.fixed + lines.build_ns.per_unit * build_unit(s, n),
                                lines.bytes.fixed + lines.bytes.per_unit * n});
            for (std::size_t kind = 0; kind < measured_ray_kinds.size(); ++kind) {
                const CostLine& line = lines.ray_ns[kind];
                m.rays.push_back({s, kind, n, line.fixed + line.per_unit * ray_unit(s, n)});
            }
        }
    }
    return m;
}

TEST(Fit, RecoversKnownConstants) {
    const MachineConstants known = known_constants();
    const Measurements measurements = obeying(known);
    EXPECT_TRUE(suffices(measurements, 3));
    const MachineConstants found = fit(measurements);
    const auto expect_same = [](const CostLine& a, const CostLine& b, const char* name) {
        EXPECT_NEAR(a.fixed, b.fixed, 1e-4 * b.fixed) << name;
        EXPECT_NEAR(a.per_unit, b.per_unit, 1e-4 * b.per_unit) << name;
        EXPECT_NEAR(a.residual, 0.0, 1e-6) << name;
    };
    for (const Structure s : all_structures()) {
        expect_same(found.structures[s].build_ns, known.structures[s].build_ns, name_of(s));
        expect_same(found.structures[s].bytes, known.structures[s].bytes, name_of(s));
        for (std::size_t kind = 0; kind < measured_ray_kinds.size(); ++kind) {
            expect_same(found.structures[s].ray_ns[kind], known.structures[s].ray_ns[kind], name_of(s));
        }
    }
    EXPECT_EQ(found.primitive_test_ns, known.primitive_test_ns);
    EXPECT_GE(found.node_step_ns, found.primitive_test_ns / 20.0);
    EXPECT_LE(found.node_step_ns, found.primitive_test_ns * 2.0);
}

TEST(Fit, HapalaConstantsAreMeansOverScenesOfTheirSize) {
    Measurements m;
    m.builds = {{Structure::kd_tree, 1024, 1024 * 10 * 50.0, 1},
                {Structure::kd_tree, 4096, 4096 * 12 * 70.0, 1},
                {Structure::kd_tree, 100, 1e12, 1},
                {Structure::bvh, 1024, 1e12, 1}};
    m.rays = {{Structure::kd_tree, 0, 1024, 10 * 30.0},
              {Structure::kd_tree, 0, 4096, 12 * 40.0},
              {Structure::kd_tree, 0, 100, 1e12},
              {Structure::kd_tree, 1, 1024, 1e12},
              {Structure::bvh, 0, 1024, 1e12}};
    const MachineConstants found = fit(m);
    EXPECT_NEAR(found.hapala.build_ns_per_n_log_n, 60.0, 1e-9);
    EXPECT_NEAR(found.hapala.ray_ns_per_log_n, 35.0, 1e-9);
}

TEST(Fit, MissesWhatWasNotMeasured) {
    const Measurements all = obeying(known_constants());
    EXPECT_FALSE(suffices({}, 1));
    EXPECT_FALSE(suffices(all, 6));
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
