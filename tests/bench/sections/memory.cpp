// Memory: what is kept, and what it takes at most to build it in one thread. Each subject has a process of its own for it.
#include "bench/memory_process.h"
#include "bench/sections/section.h"
#include "bench/table.h"

namespace raywise::bench {
namespace {

// Resident memory is counted in pages, and by the kernel not to the last one: too coarse for less.
constexpr std::uint64_t fewest_triangles = 10000;

Value value_of(const Subject& subject, double bytes, double told, std::uint64_t triangles) {
    Value value;
    value.subject = subject.name();
    value.peer = subject.traits().peer;
    value.robust = subject.traits().robust;
    value.value = bytes / static_cast<double>(triangles);
    if (told >= 0.0) value.told = told / static_cast<double>(triangles);
    value.repetitions = 1;
    return value;
}

} // namespace

void measure_memory(SceneUnderTest& scene) {
    Session& session = scene.session();
    if (scene.triangles() < fewest_triangles) return;
    Cell steady = scene.cell("memory", "", Question::closest);
    steady.unit = "bytes/triangle";
    steady.higher_is_better = false;
    Cell peak = steady;
    steady.query = "steady";
    peak.query = "peak";
    const StoredMesh stored(scene.mesh());
    for (const auto& subject : session.subjects) {
        if (subject->traits().chooses || !session.fits(*subject, scene.triangles())) continue;
        session.show_progress("memory, " + subject->name());
        const MemoryFigures figures = memory_in_a_process(session.own_command, subject->name(), stored);
        steady.values.push_back(value_of(*subject, figures.resident, figures.told, scene.triangles()));
        peak.values.push_back(value_of(*subject, figures.peak_resident, figures.peak_told, scene.triangles()));
    }
    session.cells.push_back(std::move(steady));
    session.cells.push_back(std::move(peak));
}

std::string memory_table(const Session& session) {
    Table table(
        "Bytes per triangle, beyond the caller's arrays, built in 1 thread: resident memory of a process, and in\n"
        "brackets what the library itself tells",
        {"scene", "", "bvh", "bvh_quality", "bvh_morton", "E3 LOW", "E3 MEDIUM", "E3 HIGH", "E3 MEDIUM compact"});
    for (const Cell& cell : session.cells) {
        if (cell.section != "memory") continue;
        const auto bytes = [&](const std::string& subject) {
            const Value* const value = cell.of(subject);
            if (value == nullptr) return std::string("-");
            return digits(value->value) + (value->told >= 0.0 ? " (" + digits(value->told) + ")" : "");
        };
        table.add({cell.scene, cell.query, bytes(ours_forced), bytes(ours_quality), bytes(ours_morton),
                   bytes("Embree 3 LOW"), bytes("Embree 3 MEDIUM"), bytes("Embree 3 HIGH"),
                   bytes("Embree 3 MEDIUM compact")});
    }
    return table.empty() ? std::string() : table.text();
}

} // namespace raywise::bench
