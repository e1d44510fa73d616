// What each switch of the lectures is worth today: structures are built and asked inside this process, without the C interface.
#include "bench/sections/switches.h"
#include "bench/sections/section.h"
#include "bench/table.h"

#include <algorithm>
#include <utility>

namespace raywise::bench {
namespace {

constexpr const char* scenes[] = {"bunny", "dragon", "soup"};
constexpr std::size_t random_rays = 0; // in workloads::ray_distributions()
constexpr std::uint64_t most_rays = 20000;

std::vector<SwitchRow> all_rows() {
    std::vector<SwitchRow> all;
    for (const auto& rows : {grid_switches(), kd_switches()}) all.insert(all.end(), rows.begin(), rows.end());
    return all;
}

// The scene as structures see it.
class Geometry {
public:
    explicit Geometry(const workloads::Mesh& mesh) : primitives_({triangle_mesh(mesh)}) {}
    BuildInput input() { return {primitives_, {}, {}, parallel_, progress_}; }

private:
    static std::shared_ptr<const TriangleMesh> triangle_mesh(const workloads::Mesh& mesh) {
        TriangleArrays arrays;
        arrays.vertices = {reinterpret_cast<const std::byte*>(mesh.vertices.data()), 12, 4, Scalar::float32};
        arrays.vertex_count = mesh.vertex_count();
        arrays.indices = {reinterpret_cast<const std::byte*>(mesh.indices.data()), 12, 4, Scalar::uint32};
        arrays.triangle_count = mesh.triangle_count();
        return std::make_shared<const TriangleMesh>(arrays, false, false);
    }

    Primitives primitives_;
    Parallel parallel_{1};
    Progress progress_;
};

std::vector<RayF> rays_of(const RaySet& set) {
    std::vector<RayF> rays(set.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const float* const origin = set.origin.data() + 3 * i;
        const float* const direction = set.direction.data() + 3 * i;
        rays[i].origin = {origin[0], origin[1], origin[2]};
        rays[i].direction = {direction[0], direction[1], direction[2]};
        rays[i].tmin = set.tmin[i];
        rays[i].tmax = set.tmax[i];
    }
    return rays;
}

std::string subject_of(const SwitchRow& row) { return std::string(row.structure) + ", " + row.name; }

void add(Cell& cell, const SwitchRow& row, const calibration::Timing& timing, double divisor, double hit_rate = -1.0) {
    Value value;
    value.subject = subject_of(row);
    value.structure = row.structure;
    value.value = timing.ns / divisor;
    value.spread = timing.spread;
    value.repetitions = timing.repetitions;
    value.hit_rate = hit_rate;
    cell.values.push_back(std::move(value));
}

} // namespace

void measure_switches(SceneUnderTest& scene) {
    Session& session = scene.session();
    const bool is_listed = std::find(std::begin(scenes), std::end(scenes), scene.name()) != std::end(scenes);
    if (!is_listed || !session.wants_rays("random")) return;
    const std::vector<SwitchRow> rows = all_rows();
    Geometry geometry(scene.mesh());
    const BuildInput input = geometry.input();

    session.show_progress("switches, building");
    std::vector<calibration::Timed> builds;
    for (const SwitchRow& row : rows) {
        builds.push_back(calibration::with_clock([&row, &input] { row.build(input); }, calibration::processor_ns));
    }
    const auto build_times = time_in_turns(builds, session.effort.build_timing);

    session.show_progress("switches, rays");
    const std::vector<RayF> rays = rays_of(scene.rays(random_rays, std::min(most_rays, session.effort.single_rays)));
    std::vector<std::unique_ptr<Accel>> built;
    std::vector<std::uint64_t> hits(rows.size());
    std::vector<calibration::Timed> questions;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        built.push_back(rows[i].build(input));
        const auto ask = [&rays, &accel = *built[i], &found = hits[i]] {
            found = 0;
            for (const RayF& ray : rays) found += accel.closest_f32(ray, {}).is_hit() ? 1 : 0;
        };
        questions.push_back(calibration::with_clock(ask, calibration::processor_ns));
    }
    const auto ray_times = time_in_turns(questions, session.effort.timing);

    Cell build = scene.cell("switches", "", Question::closest);
    build.query = "build";
    build.unit = "ms";
    build.higher_is_better = false;
    Cell bytes = build;
    bytes.query = "bytes";
    bytes.unit = "bytes/triangle";
    Cell ray = scene.cell("switches", "random", Question::closest);
    ray.count = rays.size();
    ray.unit = "ns/ray";
    ray.higher_is_better = false;
    const auto triangles = static_cast<double>(scene.triangles());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        add(build, rows[i], build_times[i], 1e6);
        add(ray, rows[i], ray_times[i], static_cast<double>(rays.size()),
            static_cast<double>(hits[i]) / static_cast<double>(rays.size()));
        add(bytes, rows[i], {static_cast<double>(built[i]->bytes()), 0.0, 1}, triangles);
        if (hits[i] == hits[0]) continue;
        session.failed = true;
        session.warnings.push_back(scene.name() + ", switches: " + subject_of(rows[i]) + " hits with " +
                                   with_commas(hits[i]) + " rays, " + subject_of(rows[0]) + " with " +
                                   with_commas(hits[0]));
    }
    for (Cell* cell : {&build, &ray, &bytes}) session.cells.push_back(std::move(*cell));
}

std::string switches_table(const Session& session) {
    Table table(
        "Switches, 1 thread, random rays one by one; ratios are what it costs over the first row of the structure",
        {"scene", "structure", "switch", "build ms", "", "ns a ray", "", "bytes a triangle", ""});
    const std::vector<SwitchRow> rows = all_rows();
    std::vector<std::vector<std::string>> lines;
    for (const Cell& cell : session.cells) {
        if (cell.section != "switches") continue;
        if (lines.empty()) {
            for (const SwitchRow& row : rows) lines.push_back({cell.scene, row.structure, row.name});
        }
        std::size_t standard = 0; // the first row of the structure
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (std::string(rows[standard].structure) != rows[i].structure) standard = i;
            lines[i].push_back(digits(cell.values[i].value));
            lines[i].push_back(ratio_text(cell.values[i].value / cell.values[standard].value));
        }
        if (lines.front().size() < 9) continue;
        for (auto& line : lines) table.add(std::move(line));
        lines.clear();
    }
    return table.empty() ? std::string() : table.text();
}

} // namespace raywise::bench
