// Frame after frame: vertices move, the structure follows, some rays are asked. Moving them is the program's, and not counted.
#include "bench/subjects/frames.h"
#include "bench/sections/section.h"
#include "bench/subjects/raywise_subject.h"
#include "bench/table.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raywise::bench {
namespace {

constexpr const char* moving_scenes[] = {"bunny", "dragon"};
constexpr std::size_t rays_of_frame = 10000;
constexpr std::size_t frames_to_settle = 3;

struct OursRow {
    const char* label;
    const char* structure;
    Renewal renewal;
};
constexpr OursRow ours_rows[] = {
    {"raywise uniform_grid", "uniform_grid", Renewal::build},
    {"raywise bvh_morton", "bvh_morton", Renewal::build},
    {"raywise bvh", "bvh", Renewal::build},
    {"raywise bvh_morton, refit", "bvh_morton", Renewal::refit},
    {"raywise bvh, refit", "bvh", Renewal::refit},
};
constexpr std::pair<const char*, Renewal> embree_rows[] = {{"Embree 3 LOW, dynamic", Renewal::build},
                                                           {"Embree 3 REFIT, dynamic", Renewal::refit}};

struct Taking {
    std::string label;
    bool peer;
    std::unique_ptr<Frames> frames;
    std::vector<double> renew_ms;
    std::vector<double> rays_ms;
};

std::vector<Taking> all_taking_part(const SceneUnderTest& scene) {
    const Session& session = scene.session();
    std::vector<Taking> all;
    for (const OursRow& row : ours_rows) {
        if (!has_structure(session.library, row.structure)) continue;
        all.push_back(
            {row.label, false, raywise_frames(session.library, row.structure, row.renewal, scene.mesh()), {}, {}});
    }
    if (session.embree3 == nullptr) return all;
    for (const auto& [label, renewal] : embree_rows)
        all.push_back({label, true, embree_frames(*session.embree3, renewal, scene.mesh()), {}, {}});
    return all;
}

// A wave that runs along the mesh.
void move(const std::vector<float>& rest, const Box& bounds, std::size_t frame, std::vector<float>& vertices) {
    const double size = max_component(bounds.size());
    const double phase = 0.3 * static_cast<double>(frame);
    for (std::size_t i = 0; i + 2 < rest.size(); i += 3) {
        const double along = 6.0 * static_cast<double>(rest[i]) / size;
        vertices[i + 1] = rest[i + 1] + static_cast<float>(0.02 * size * std::sin(along + phase));
    }
}

Cell cell_of(const SceneUnderTest& scene, const std::vector<Taking>& all, const char* query,
             std::vector<double> Taking::*times) {
    Cell cell = scene.cell("frames", "random", Question::closest);
    cell.query = query;
    cell.count = rays_of_frame;
    cell.unit = "ms";
    cell.higher_is_better = false;
    for (const Taking& each : all) {
        Value value;
        value.subject = each.label;
        value.peer = each.peer;
        value.value = calibration::median(each.*times);
        value.repetitions = static_cast<unsigned>((each.*times).size());
        cell.values.push_back(std::move(value));
    }
    return cell;
}

} // namespace

void measure_frames(SceneUnderTest& scene) {
    Session& session = scene.session();
    if (std::find(std::begin(moving_scenes), std::end(moving_scenes), scene.name()) == std::end(moving_scenes)) return;
    const std::size_t frames = frames_to_settle + (session.options.quick ? 2 : 4 * session.options.repetitions);
    std::vector<Taking> all = all_taking_part(scene);
    const RaySet rays = scene.rays(0, rays_of_frame);
    const Box bounds = scene.mesh().bounds();
    for (std::size_t frame = 0; frame < frames; ++frame) {
        session.show_progress("frame " + std::to_string(frame + 1) + " of " + std::to_string(frames));
        for (Taking& each : all) {
            move(scene.mesh().vertices, bounds, frame, each.frames->vertices());
            const double begin = calibration::processor_ns();
            each.frames->next();
            const double renewed = calibration::processor_ns();
            const std::unique_ptr<Query> query = each.frames->query({rays});
            const double ready = calibration::processor_ns();
            query->ask(0, rays.size());
            const double end = calibration::processor_ns();
            if (frame < frames_to_settle) continue;
            each.renew_ms.push_back(1e-6 * (renewed - begin));
            each.rays_ms.push_back(1e-6 * (end - ready));
        }
    }
    session.cells.push_back(cell_of(scene, all, "renew", &Taking::renew_ms));
    session.cells.push_back(cell_of(scene, all, "rays", &Taking::rays_ms));
}

std::string frames_table(const Session& session) {
    Table table(
        "A frame in ms, one thread: the structure made to follow the moved vertices, and 10,000 random rays one by one",
        {"scene", "", "structure", "ns/triangle", "rays", "both"});
    for (std::size_t i = 0; i + 1 < session.cells.size(); ++i) {
        const Cell& renew = session.cells[i];
        if (renew.section != "frames" || renew.query != "renew") continue;
        const Cell& rays = session.cells[i + 1];
        for (const Value& value : renew.values) {
            const double asked = rays.of(value.subject)->value;
            table.add({renew.scene, value.subject, digits(value.value),
                       digits(1e6 * value.value / static_cast<double>(renew.triangles)), digits(asked),
                       digits(value.value + asked)});
        }
    }
    return table.empty() ? std::string() : table.text();
}

} // namespace raywise::bench
