#include "measure/fit.h"

#include "model/cost_functions.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace raywise::calibration {
namespace {

// The paper's smallest scene has 528 triangles; below, a ray's fixed costs would count as costs of the tree.
constexpr double fewest_hapala_triangles = 500.0;

double squared_misfit(const std::vector<Point>& points, const CostLine& line) {
    double sum = 0.0;
    for (const Point& p : points) {
        const double misfit = (line.fixed + line.per_unit * p.unit) / p.cost - 1.0;
        sum += misfit * misfit;
    }
    return sum;
}

std::vector<Point> build_points(const Measurements& measurements, Structure structure) {
    std::vector<Point> points;
    for (const BuildMeasurement& m : measurements.builds) {
        if (m.structure == structure) points.push_back({build_unit(structure, m.triangles), m.ns});
    }
    return points;
}

std::vector<Point> byte_points(const Measurements& measurements, Structure structure) {
    std::vector<Point> points;
    for (const BuildMeasurement& m : measurements.builds) {
        if (m.structure == structure) points.push_back({m.triangles, m.bytes});
    }
    return points;
}

std::vector<Point> ray_points(const Measurements& measurements, Structure structure, std::size_t kind) {
    std::vector<Point> points;
    for (const RayMeasurement& m : measurements.rays) {
        if (m.structure == structure && m.kind == kind) points.push_back({ray_unit(structure, m.triangles), m.ns});
    }
    return points;
}

std::size_t different_units(const std::vector<Point>& points) {
    std::set<double> units;
    for (const Point& p : points) units.insert(p.unit);
    return units.size();
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
        if (m.structure == Structure::kd_tree && counts(m.triangles)) {
            builds.push_back(m.ns / (m.triangles * std::log2(m.triangles)));
        }
    }
    for (const RayMeasurement& m : measurements.rays) {
        if (m.structure == Structure::kd_tree && m.kind == ray_kind_index(RayKind::random) && counts(m.triangles)) {
            rays.push_back(m.ns / std::log2(m.triangles));
        }
    }
    return {mean(builds), mean(rays)};
}

} // namespace

CostLine fit_line(const std::vector<Point>& all) {
    // A cost of nothing has no relative misfit; only memory can be nothing.
    std::vector<Point> points;
    for (const Point& p : all) {
        if (p.cost > 0.0) points.push_back(p);
    }
    CostLine best;
    if (points.empty()) return best;

    // Normal equations of: fixed * (1 / cost) + per_unit * (unit / cost) = 1
    double aa = 0.0, ab = 0.0, bb = 0.0, a1 = 0.0, b1 = 0.0;
    for (const Point& p : points) {
        const double a = 1.0 / p.cost, b = p.unit / p.cost;
        aa += a * a, ab += a * b, bb += b * b, a1 += a, b1 += b;
    }
    const double determinant = aa * bb - ab * ab;
    // The best with either part alone; the best with both, if neither comes out negative, is better than those.
    std::vector<CostLine> lines = {{a1 / aa, 0.0, 0.0}};
    if (bb > 0.0) lines.push_back({0.0, b1 / bb, 0.0});
    if (determinant > 1e-12 * aa * bb) {
        lines.push_back({(a1 * bb - b1 * ab) / determinant, (b1 * aa - a1 * ab) / determinant, 0.0});
    }
    double least = INFINITY;
    for (const CostLine& line : lines) {
        if (line.fixed < 0.0 || line.per_unit < 0.0) continue;
        const double misfit = squared_misfit(points, line);
        if (misfit < least) {
            least = misfit;
            best = line;
        }
    }
    best.residual = std::sqrt(least / static_cast<double>(points.size()));
    return best;
}

bool suffices(const Measurements& measurements, std::size_t fewest) {
    bool hapala = false;
    for (const BuildMeasurement& m : measurements.builds) {
        hapala = hapala || (m.structure == Structure::kd_tree && m.triangles >= fewest_hapala_triangles);
    }
    for (const Structure structure : all_structures()) {
        if (different_units(build_points(measurements, structure)) < fewest) return false;
        for (std::size_t kind = 0; kind < measured_ray_kinds.size(); ++kind) {
            if (different_units(ray_points(measurements, structure, kind)) < fewest) return false;
        }
    }
    return hapala;
}

MachineConstants fit(const Measurements& measurements) {
    MachineConstants constants;
    for (const Structure structure : all_structures()) {
        StructureConstants& lines = constants.structures[structure];
        lines.build_ns = fit_line(build_points(measurements, structure));
        lines.bytes = fit_line(byte_points(measurements, structure));
        for (std::size_t kind = 0; kind < measured_ray_kinds.size(); ++kind) {
            lines.ray_ns[kind] = fit_line(ray_points(measurements, structure, kind));
        }
    }
    constants.hapala = fit_hapala(measurements);

    const std::size_t random = ray_kind_index(RayKind::random);
    constants.primitive_test_ns = measurements.primitive_test_ns;
    const double level_ns = constants.structures[Structure::bvh].ray_ns[random].per_unit;
    constants.node_step_ns =
        std::clamp(0.5 * level_ns, constants.primitive_test_ns / 20.0, constants.primitive_test_ns * 2.0);
    return constants;
}

} // namespace raywise::calibration
