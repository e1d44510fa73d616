// contract_sweep: do all structures give the same answers, and is no closed mesh left through an edge?
#include "contract/sweep_result.h"
#include "contract/sweep_schedule.h"

#include "base/parallel.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>

namespace raywise::sweep {
namespace {

constexpr int exit_wrong =
    1; // a disagreement, a leak, a wrong number of crossings, the judge's objection, a failed call
constexpr int exit_usage = 2;      // the command line
constexpr int exit_incomplete = 3; // less was done than was asked for
constexpr int exit_interrupted = 130;

struct Options {
    std::uint64_t comparisons = 1000000000;
    std::uint64_t edge_rays = 100000000;
    std::uint64_t seed = 1;
    unsigned threads = 0;
    std::vector<std::string> families = {"hard", "procedural", "real"};
    std::vector<std::uint64_t> sizes = {300, 30000};
    std::uint64_t most_triangles = 1000000;
    std::string json;
    std::string only;
    std::optional<std::uint64_t> block;
    bool quiet = false;

    bool has(const char* family) const { return std::find(families.begin(), families.end(), family) != families.end(); }
};

std::atomic<bool> stop{false};

extern "C" void on_interrupt(int) { stop = true; }

// Whole numbers, in the form 1e9 as well.
std::string whole_number(const std::string& text) {
    std::size_t used = 0;
    double value = -1.0;
    try {
        value = std::stod(text, &used);
    } catch (const std::exception&) {
        used = 0;
    }
    if (used != text.size() || !(value >= 0.0 && value <= 1e15) || value != std::floor(value))
        throw CLI::ValidationError("\"" + text + "\" is no whole number from 0 to 10^15");
    return std::to_string(static_cast<std::uint64_t>(value));
}

void add_options(CLI::App& app, Options& options) {
    app.add_option("--comparisons", options.comparisons, "answers to compare with the reference's")
        ->type_name("N")
        ->transform(whole_number)
        ->capture_default_str();
    app.add_option("--edge-rays", options.edge_rays, "rays at edges and vertices of closed meshes")
        ->type_name("N")
        ->transform(whole_number)
        ->capture_default_str();
    app.add_option("--seed", options.seed, "of all rays")->type_name("N")->capture_default_str();
    app.add_option("--threads", options.threads, "blocks run side by side (default: as many as there are)")
        ->type_name("N")
        ->check(CLI::Range(1u, 256u));
    app.add_option("--families", options.families, "of scenes: hard, procedural, real")
        ->type_name("LIST")
        ->delimiter(',')
        ->check(CLI::IsMember({"hard", "procedural", "real"}))
        ->capture_default_str();
    app.add_option("--sizes", options.sizes, "triangles of the procedural scenes")
        ->type_name("LIST")
        ->delimiter(',')
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{10000000}))
        ->capture_default_str();
    app.add_option("--most-triangles", options.most_triangles, "leave out larger closed and real meshes")
        ->type_name("N")
        ->capture_default_str();
    app.add_option("--json", options.json, "write the rows and the summary to this file")->type_name("FILE");
    CLI::Option* only =
        app.add_option("--only", options.only, "run one scene or mesh, by the name in the table")->type_name("NAME");
    app.add_option("--block", options.block, "run one block of it, to see a fault again")->type_name("K")->needs(only);
    app.add_flag("--quiet,-q", options.quiet, "no progress");
    app.footer(
        "Every block of rays depends on the seed, its scene and its number alone; how many blocks a scene gets\n"
        "depends on time. A fault names its block: --only NAME --block K runs it again.\n"
        "Exit codes: 0 all agree; 1 a disagreement, a leak, a wrong number of crossings; 2 usage;\n"
        "3 fewer comparisons than asked for; 130 interrupted (the report tells what was done).\n");
}

// Faults are told when they are found: a long run is not to be waited for.
class FaultTeller {
public:
    void tell(const std::vector<std::string>& faults) {
        const std::lock_guard<std::mutex> lock(mutex_);
        for (const std::string& fault : faults) {
            if (told_++ < most) std::fprintf(stderr, "\nFAULT: %s\n", fault.c_str());
        }
    }

private:
    static constexpr unsigned most = 20;
    std::mutex mutex_;
    unsigned told_ = 0;
};

// Runs blocks of scenes until so many answers are there. Row: has a `count` that Scene::run's result can be added to.
template <class Scene, class Row, class AnswersOf>
void run_blocks(const std::string& name, std::vector<std::unique_ptr<Scene>>& scenes, std::vector<Row>& rows,
                std::uint64_t wanted, const Options& options, FaultTeller& teller, AnswersOf answers_of) {
    std::mutex mutex;
    std::atomic<std::uint64_t> done{0};
    const auto run_block = [&](std::size_t part, std::uint64_t block) {
        const auto count = scenes[part]->run(block);
        teller.tell(count.faults);
        const std::lock_guard<std::mutex> lock(mutex);
        rows[part].count.add(count);
        done += answers_of(count);
        return count.share();
    };
    if (options.block) {
        for (std::size_t part = 0; part < scenes.size(); ++part) run_block(part, *options.block);
        return;
    }
    if (wanted == 0) return;
    const Phase phase{name, scenes.size(),
                      [&](const TimeShares::Turn& turn) { return run_block(turn.part, turn.block); },
                      [&] { return static_cast<double>(done.load()) / static_cast<double>(wanted); }};
    run_phase(phase, options.threads, stop, options.quiet);
}

void sweep_agreement(const Options& options, SweepResult& result, FaultTeller& teller) {
    if (options.comparisons == 0) return;
    SceneChoice choice;
    choice.hard = options.has("hard");
    choice.procedural = options.has("procedural");
    choice.real = options.has("real");
    choice.sizes = options.sizes;
    choice.most_triangles = options.most_triangles;
    std::vector<std::unique_ptr<AgreementScene>> scenes;
    std::size_t index = 0;
    for (SweepScene& scene : sweep_scenes(choice)) {
        ++index;
        if (!options.only.empty() && scene.mesh.name != options.only) continue;
        result.agreement.push_back({scene.family, scene.mesh.name, scene.mesh.triangles.size(), {}});
        scenes.push_back(std::make_unique<AgreementScene>(std::move(scene), index, options.seed));
    }
    run_blocks("agreement", scenes, result.agreement, options.comparisons, options, teller,
               [](const AgreementCount& count) { return count.comparisons; });
}

void sweep_watertightness(const Options& options, SweepResult& result, FaultTeller& teller) {
    if (options.edge_rays == 0) return;
    std::vector<std::unique_ptr<WatertightScene>> scenes;
    for (ClosedScene& scene : closed_scenes(options.most_triangles, options.has("real"))) {
        if (!options.only.empty() && scene.mesh.name != options.only) continue;
        result.watertight.push_back({scene.mesh.name, scene.mesh.triangles.size(), scene.convex, {}});
        scenes.push_back(std::make_unique<WatertightScene>(std::move(scene), options.seed));
    }
    run_blocks("watertightness", scenes, result.watertight, options.edge_rays, options, teller,
               [](const WatertightCount& count) { return count.rays; });
}

int run(int argc, char** argv) {
    CLI::App app(
        "Compares the answers of every structure, view, call, order and number of threads bit for bit, and looks\n"
        "for rays that slip through closed meshes.");
    app.name("contract_sweep");
    app.get_formatter()->column_width(30);
    Options options;
    add_options(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : exit_usage;
    }
    if (options.threads == 0) options.threads = Parallel::usable_threads();
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);

    SweepResult result;
    result.seed = options.seed;
    if (!options.block) {
        result.comparisons_wanted = options.comparisons;
        result.edge_rays_wanted = options.edge_rays;
    }
    FaultTeller teller;
    sweep_agreement(options, result, teller);
    if (!stop) sweep_watertightness(options, result, teller);
    result.interrupted = stop;
    if (result.agreement.empty() && result.watertight.empty()) {
        std::fprintf(stderr, "contract_sweep: there is no scene of that name or family\n");
        return exit_usage;
    }

    std::fputs(table_of(result).c_str(), stdout);
    if (!options.json.empty()) write_json(options.json, part_of(result));
    if (!result.right()) return exit_wrong;
    if (result.interrupted) return exit_interrupted;
    return result.complete() ? 0 : exit_incomplete;
}

} // namespace
} // namespace raywise::sweep

int main(int argc, char** argv) {
    try {
        return raywise::sweep::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "contract_sweep: %s\n", error.what());
        return raywise::sweep::exit_wrong;
    }
}
