#include "measure/fit.h"

#include "model/cost_units.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace raywise::calibration {
namespace {

// The paper's smallest scene has 528 triangles; below, a ray's fixed costs would count as costs of the tree.
constexpr double fewest_hapala_triangles = 500.0;

// What a subset of the parts has to take off the misfit for each part more.
constexpr double least_gain = 0.02;
// Smaller misfits are those of the arithmetic.
constexpr double rounding = 1e-9;

// One column for what is fixed, and one for each unit; divided by the costs, so that misfits are relative.
Eigen::MatrixXd relative_parts(const std::vector<Point>& points, std::size_t units) {
    Eigen::MatrixXd parts(points.size(), units + 1);
    for (std::size_t p = 0; p < points.size(); ++p) {
        parts(p, 0) = 1.0 / points[p].cost;
        for (std::size_t i = 0; i < units; ++i) parts(p, i + 1) = points[p].units[i] / points[p].cost;
    }
    return parts;
}

struct Fit {
    Eigen::VectorXd constants; // of the columns
    double misfit = INFINITY;  // root mean square of the logarithm of predicted over measured; infinite: not to be used
};

// Least squares of the logarithm (Gauss and Newton), from those of the relative misfit on.
Fit fit_columns(const Eigen::MatrixXd& parts) {
    constexpr int rounds = 30;
    constexpr double least_ratio = 1e-3; // what is predicted below nothing on the way
    Fit fit;
    Eigen::ArrayXd ratios = Eigen::ArrayXd::Ones(parts.rows()); // of predicted over measured
    for (int round = 0; round < rounds; ++round) {
        const Eigen::MatrixXd slopes = ratios.inverse().matrix().asDiagonal() * parts;
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposition(slopes);
        if (decomposition.rank() < parts.cols()) return fit;
        fit.constants = decomposition.solve((1.0 - ratios.log()).matrix());
        ratios = (parts * fit.constants).array().max(least_ratio);
    }
    if (fit.constants.minCoeff() >= 0.0) fit.misfit = std::sqrt(ratios.log().square().mean());
    return fit;
}

Point point_of(const CostUnits& units, const SceneFeatures& features, double cost) {
    Point point{{}, cost};
    for (std::size_t i = 0; i < units.size(); ++i) point.units[i] = units[i].of(features);
    return point;
}

LinearCost fit_builds(const Measurements& measurements, Structure structure) {
    std::vector<Point> points;
    for (const BuildMeasurement& m : measurements.builds) {
        if (m.structure == structure) points.push_back(point_of(build_units(structure), m.features, m.ns));
    }
    return fit_cost(points, build_units(structure).size());
}

LinearCost fit_bytes(const Measurements& measurements, Structure structure) {
    std::vector<Point> points;
    for (const BuildMeasurement& m : measurements.builds) {
        if (m.structure == structure) points.push_back(point_of(byte_units(structure), m.features, m.bytes));
    }
    return fit_cost(points, byte_units(structure).size());
}

LinearCost fit_rays(const Measurements& measurements, Structure structure, std::size_t kind) {
    std::vector<Point> points;
    for (const RayMeasurement& m : measurements.rays) {
        if (m.structure == structure && m.kind == kind)
            points.push_back(point_of(ray_units(structure), m.features, m.ns));
    }
    return fit_cost(points, ray_units(structure).size());
}

// The different numbers of triangles among measurements that `counts`.
template <class Measurement, class Counts>
std::size_t different_sizes(const std::vector<Measurement>& measurements, Counts counts) {
    std::set<double> sizes;
    for (const Measurement& m : measurements) {
        if (counts(m)) sizes.insert(m.features.triangles);
    }
    return sizes.size();
}

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double v : values) sum += v;
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

HapalaConstants fit_hapala(const Measurements& measurements) {
    const auto counts = [](double triangles) { return triangles >= fewest_hapala_triangles; };
    std::vector<double> builds, rays;
    for (const BuildMeasurement& m : measurements.builds) {
        if (m.structure == Structure::kd_tree && counts(m.features.triangles)) {
            builds.push_back(m.ns / (m.features.triangles * std::log2(m.features.triangles)));
        }
    }
    for (const RayMeasurement& m : measurements.rays) {
        if (m.structure == Structure::kd_tree && m.kind == ray_kind_index(RayKind::random) &&
            counts(m.features.triangles)) {
            rays.push_back(m.ns / std::log2(m.features.triangles));
        }
    }
    return {mean(builds), mean(rays)};
}

} // namespace

LinearCost fit_cost(const std::vector<Point>& all, std::size_t units) {
    // A cost of nothing has no relative misfit; only memory can be nothing.
    std::vector<Point> points;
    for (const Point& p : all) {
        if (p.cost > 0.0) points.push_back(p);
    }
    LinearCost best;
    if (points.empty()) return best;

    // Each choice of columns, fewer before more. Where the best of all has a negative part, the best without that one has not.
    const Eigen::MatrixXd parts = relative_parts(points, units);
    const auto count = [](unsigned choice) { return __builtin_popcount(choice); };
    std::vector<unsigned> choices(1u << (units + 1));
    std::iota(choices.begin(), choices.end(), 0u);
    std::stable_sort(choices.begin(), choices.end(), [&](unsigned a, unsigned b) { return count(a) < count(b); });
    // A quantity that comes nowhere to 1 was not measured: what it costs would be made of noise, and told of scenes where it is many times that.
    unsigned measured = 1; // as choices
    for (std::size_t i = 0; i < units; ++i) {
        if (std::any_of(points.begin(), points.end(), [i](const Point& p) { return p.units[i] >= 1.0; }))
            measured |= 2u << i;
    }
    double least = INFINITY;
    int columns_of_least = 0;
    for (const unsigned choice : choices) {
        std::vector<Eigen::Index> columns;
        for (Eigen::Index i = 0; i < parts.cols(); ++i) {
            if ((choice >> i & 1u) != 0) columns.push_back(i);
        }
        if (columns.empty() || columns.size() > points.size() || (choice & ~measured) != 0) continue;
        const Fit fit = fit_columns(parts(Eigen::all, columns));
        const double needed = count(choice) > columns_of_least ? 1.0 - least_gain : 1.0;
        if (!(fit.misfit < needed * least - rounding)) continue;
        least = fit.misfit;
        columns_of_least = count(choice);
        best = {};
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const double constant = fit.constants(static_cast<Eigen::Index>(i));
            if (columns[i] == 0) {
                best.fixed = constant;
            } else {
                best.per_unit[static_cast<std::size_t>(columns[i] - 1)] = constant;
            }
        }
    }
    best.residual = least;
    return best;
}

bool suffices(const Measurements& measurements, std::size_t fewest) {
    bool hapala = false;
    for (const BuildMeasurement& m : measurements.builds) {
        hapala = hapala || (m.structure == Structure::kd_tree && m.features.triangles >= fewest_hapala_triangles);
    }
    for (const Structure structure : all_structures()) {
        const auto built = [&](const BuildMeasurement& m) { return m.structure == structure; };
        if (different_sizes(measurements.builds, built) < fewest) return false;
        for (std::size_t kind = 0; kind < measured_ray_kinds.size(); ++kind) {
            const auto asked = [&](const RayMeasurement& m) { return m.structure == structure && m.kind == kind; };
            if (different_sizes(measurements.rays, asked) < fewest) return false;
        }
    }
    return hapala;
}

MachineConstants fit(const Measurements& measurements) {
    MachineConstants constants;
    for (const Structure structure : all_structures()) {
        StructureConstants& costs = constants.structures[structure];
        costs.build_ns = fit_builds(measurements, structure);
        costs.bytes = fit_bytes(measurements, structure);
        for (std::size_t kind = 0; kind < measured_ray_kinds.size(); ++kind)
            costs.ray_ns[kind] = fit_rays(measurements, structure, kind);
    }
    constants.hapala = fit_hapala(measurements);

    const std::size_t random = ray_kind_index(RayKind::random);
    constants.primitive_test_ns = measurements.primitive_test_ns;
    // What a level of the tree takes, between the sizes where it leaves no cache.
    const LinearCost& ray = constants.structures[Structure::bvh].ray_ns[random];
    const auto ray_ns = [&](std::uint64_t triangles) {
        return ray.at(ray_units(Structure::bvh), typical_features(triangles));
    };
    const double level_ns = (ray_ns(1u << 15) - ray_ns(1u << 10)) / 5.0;
    constants.node_step_ns =
        std::clamp(0.5 * level_ns, constants.primitive_test_ns / 20.0, constants.primitive_test_ns * 2.0);
    return constants;
}

} // namespace raywise::calibration
