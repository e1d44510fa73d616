// raywise_bench: raywise beside its peers, on the same rays, in one process, taking turns.
#include "bench/export_scene.h"
#include "bench/memory_process.h"
#include "bench/report.h"
#include "bench/sections/section.h"
#include "bench/session.h"
#include "bench/subjects/subject_list.h"
#include "bench/summary.h"

#include "model/machine.h"
#include "progress_bar.h"
#include "rays/rays.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <thread>

#include <unistd.h>

namespace raywise::bench {
namespace {

struct CommandLine {
    Options options;
    SubjectFiles subject_files{{}, {}, "libembree3.so.3", {}};
    SceneFiles scene_files;
    std::string json;
    std::string commit;
    std::string command;
    bool list = false;
    std::string export_folder;
    std::uint64_t export_rays = 0; // of each kind; 0: as many as single calls are asked
    std::string memory_of;         // what a process of its own is started for
    std::string stored_mesh;
};

std::vector<std::string> section_names() {
    std::vector<std::string> names;
    for (const Section& section : sections()) names.emplace_back(section.name);
    return names;
}

std::vector<std::string> kind_names() {
    std::vector<std::string> names;
    for (const auto& kind : workloads::ray_distributions()) names.emplace_back(kind.name);
    return names;
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const SceneRow& row : scene_rows()) names.emplace_back(row.name);
    return names;
}

bool wanted(const std::vector<std::string>& list, const std::string& name) {
    return list.empty() || std::find(list.begin(), list.end(), name) != list.end();
}

Report report_of(const Session& session, const TakingPart& all, const CommandLine& line) {
    Report report{"bench", line.commit, line.command, rows_of(session.cells), summary_of(session)};
    report.more = {{"quick", line.options.quick},
                   {"threads", session.all_threads},
                   {"profile", std::getenv("RAYWISE_CALIBRATION")},
                   {"peers", all.versions},
                   {"left_out", all.left_out},
                   {"warnings", session.warnings}};
    return report;
}

// Runs this program with the same libraries.
std::vector<std::string> own_command(const CommandLine& line) {
    return {"/proc/" + std::to_string(::getpid()) + "/exe",
            "--library",
            line.subject_files.ours,
            "--embree3",
            line.subject_files.embree3,
            "--embree4",
            line.subject_files.embree4};
}

// Processors that this process keeps busy while it does nothing: threads of some library that wait for work by asking for it.
double busy_while_idle() {
    std::this_thread::sleep_for(std::chrono::milliseconds(50)); // who has just worked may wait like that for a while
    const auto start = std::chrono::steady_clock::now();
    const double before = calibration::processor_ns();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const double busy = calibration::processor_ns() - before;
    return busy / std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

// Returns whether all checks held.
bool run(const CommandLine& line) {
    TakingPart all = who_takes_part(line.subject_files, line.options.subjects, line.options.quick);
    if (line.list) {
        for (const auto& subject : all.subjects) std::printf("%s\n", subject->name().c_str());
        for (const auto& subject : all.avx2) std::printf("%s, AVX2\n", subject->name().c_str());
        for (const auto& subject : all.yardstick) std::printf("%s\n", subject->name().c_str());
        for (const std::string& reason : all.left_out) std::printf("left out: %s\n", reason.c_str());
        return true;
    }
    if (!line.memory_of.empty()) {
        for (const auto& subject : all.subjects)
            if (subject->name() == line.memory_of) {
                print_memory(*subject, line.stored_mesh);
                return true;
            }
        throw std::runtime_error("nobody is called " + line.memory_of);
    }
    const bool has_embree3 = !all.embrees.empty() && all.embrees.front()->major() == 3;
    const EmbreeLibrary* const embree3 = has_embree3 ? all.embrees.front().get() : nullptr;
    Session session{
        line.options,           effort_of(line.options), *all.ours, all.subjects, all.yardstick, all.avx2, embree3,
        this_machine().threads, own_command(line),       {},        {},           false,         {}};
    std::vector<const SceneRow*> rows;
    for (const SceneRow& row : scene_rows()) {
        if (line.options.scenes.empty() ? row.quick || !line.options.quick : wanted(line.options.scenes, row.name))
            rows.push_back(&row);
    }
    std::vector<const Section*> parts;
    for (const Section& section : sections())
        if (wanted(line.options.sections, section.name)) parts.push_back(&section);

    calibration::ProgressBar progress(false);
    const double steps = static_cast<double>(rows.size() * parts.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto at = [&](std::size_t part) { return static_cast<double>(i * parts.size() + part) / steps; };
        progress.show(at(0), std::string(rows[i]->name) + ", making the scene");
        TestScene test_scene;
        try {
            test_scene = make_scene(*rows[i], line.options.quick, *all.ours, line.scene_files);
        } catch (const MissingFile& missing) {
            all.left_out.push_back(std::string("scene ") + rows[i]->name + ": there is no " + missing.what());
            continue;
        }
        SceneUnderTest scene(session, rows[i]->name, std::move(test_scene));
        if (!line.export_folder.empty()) {
            if (!rows[i]->far_apart)
                export_scene(scene, line.export_folder,
                             line.export_rays != 0 ? line.export_rays : session.effort.single_rays);
            continue;
        }
        for (std::size_t part = 0; part < parts.size(); ++part) {
            if (rows[i]->far_apart && !parts[part]->far_apart) continue;
            session.show_progress = [&](const std::string& what) {
                progress.show(at(part), scene.name() + ", " + what);
            };
            session.show_progress(parts[part]->description);
            parts[part]->measure(scene);
        }
        if (const double busy = busy_while_idle(); busy > 0.1)
            session.warnings.push_back(scene.name() + ": while nobody is asked, threads of this process take " +
                                       std::to_string(std::lround(100.0 * busy)) +
                                       " % of a processor, which is in all times above");
        // After each scene: an hour's work should not hang on its last minute.
        if (!line.json.empty()) save(report_of(session, all, line), line.json);
    }
    progress.finish();
    if (!line.export_folder.empty()) return true;

    const Machine& machine = this_machine();
    std::printf("%s, %u threads, %s\n", machine.brand.c_str(), machine.threads, machine.instruction_set.c_str());
    for (const std::string& version : all.versions) std::printf("beside %s\n", version.c_str());
    for (const Section* part : parts) std::fputs(part->table(session).c_str(), stdout);
    const Report report = report_of(session, all, line);
    std::fputs(summary_text(report.summary).c_str(), stdout);
    std::printf("\n");
    for (const std::string& reason : all.left_out) std::printf("left out: %s\n", reason.c_str());
    for (const std::string& warning : session.warnings) std::printf("warning: %s\n", warning.c_str());
    if (!line.json.empty()) save(report, line.json);
    return !session.failed;
}

int main_of(int argc, char** argv) {
    CLI::App app(
        "raywise beside other ray tracing libraries: the same rays in one process, taking turns, medians. One thread "
        "is timed "
        "in processor time, several in wall time.");
    CommandLine line;
    Options& options = line.options;
    app.add_option("--library", line.subject_files.ours, "libraywise.so")->required()->type_name("FILE");
    app.add_option("--library-avx2", line.subject_files.ours_avx2, "the same, compiled to use AVX2 and nothing wider")
        ->type_name("FILE");
    app.add_option("--embree3", line.subject_files.embree3, "libembree3.so")->type_name("FILE")->capture_default_str();
    app.add_option("--embree4", line.subject_files.embree4, "libembree4.so")->type_name("FILE");
    app.add_option("--meshes", line.scene_files.meshes, "folder with stanford-bunny.obj and igea.ply");
    app.add_option("--spd", line.scene_files.spd, "folder with NFF scenes");
    app.add_option("--dragon", line.scene_files.dragon, "the Stanford dragon's PLY file");
    app.add_flag("--quick", options.quick, "few and small scenes, short timings: to see that it runs");
    app.add_option("--repetitions", options.repetitions, "of each timing")
        ->capture_default_str()
        ->check(CLI::Range(1, 99));
    app.add_option("--scene", options.scenes, "only these")->delimiter(',')->check(CLI::IsMember(scene_names()));
    app.add_option("--rays", options.rays, "only these kinds")->delimiter(',')->check(CLI::IsMember(kind_names()));
    app.add_option("--query", options.queries, "only these")->delimiter(',')->check(CLI::IsMember({"closest", "any"}));
    app.add_option("--section", options.sections, "only these")->delimiter(',')->check(CLI::IsMember(section_names()));
    app.add_option("--subject", options.subjects, "only those whose name begins so, beside raywise's bvh")
        ->delimiter(',');
    app.add_option("--json", line.json, "where the report goes");
    app.add_option("--commit", line.commit, "of the sources, for the report");
    app.add_option("--command", line.command, "what was typed, for the report");
    app.add_option("--export", line.export_folder, "only write scenes and rays into this folder, for other benchmarks");
    app.add_option("--export-rays", line.export_rays, "how many of each kind (as many as single calls are asked)")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{100'000'000}));
    app.add_flag("--list", line.list, "who would take part");
    app.add_option("--memory-of", line.memory_of)->group("");
    app.add_option("--stored-mesh", line.stored_mesh)->group("");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    if (line.command.empty()) {
        for (int i = 0; i < argc; ++i) line.command += std::string(i > 0 ? " " : "") + argv[i];
    }
    // The same choices whatever profiles lie around, unless one is asked for.
    ::setenv("RAYWISE_CALIBRATION", "builtin", 0);
    return run(line) ? 0 : 1;
}

} // namespace
} // namespace raywise::bench

int main(int argc, char** argv) {
    try {
        return raywise::bench::main_of(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "raywise_bench: %s\n", error.what());
        return 1;
    }
}
