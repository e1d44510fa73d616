// bench_triangle_test: what the exact triangle test costs, as single-ray throughput against the same library with another
// triangle test. All in one process, taking turns; the structures they build are alike.
#include "bench/library.h"
#include "bench/meshes.h"
#include "bench/report.h"
#include "bench/subjects/raywise_subject.h"
#include "bench/surface_points.h"

#include "measure/timing.h"
#include "rays/rays.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <map>
#include <memory>

#include <unistd.h>

namespace raywise::bench {
namespace {

constexpr std::uint64_t ray_seed = 2;
constexpr const char* structures[] = {"bvh", "kd_tree", "uniform_grid"};

struct Options {
    std::vector<std::string> libraries; // name=path; the first is ours
    std::string data;
    std::string json;
    std::string commit;
    std::string command;
    std::string only; // a mesh
    bool quick = false;
};

struct Effort {
    std::uint64_t triangles; // of procedural scenes
    std::uint64_t rays;
    std::vector<const char*> scenes;
    std::vector<const char*> files;
    calibration::TimingLimits timing;
};

Effort effort_of(bool quick) {
    constexpr double ms = 1e6;
    if (quick) return {10000, 2000, {"sphereflake", "terrain"}, {"teapot.obj"}, {2 * ms, 7, 1000 * ms}};
    return {100000,
            20000,
            {"sphereflake", "terrain", "soup", "sticks", "stadium", "interior"},
            {"teapot.obj", "stanford-bunny.obj", "igea.ply"},
            {20 * ms, 11, 5000 * ms}};
}

// The figures of all scenes, and how they are shown.
class Table {
public:
    explicit Table(const std::vector<std::unique_ptr<Library>>& libraries) : libraries_(libraries) {
        std::printf("%-16s %-13s %-8s", "scene", "structure", "rays");
        for (const auto& library : libraries_) {
            std::printf("  %12s", library->name().c_str());
            if (library != libraries_.front()) std::printf("  ratio");
        }
        std::printf("   Mray/s, single calls, 1 thread; ratio: %s over it\n", libraries_.front()->name().c_str());
    }

    void add(const std::string& scene, const char* structure, const workloads::RayDistribution& rays,
             const std::vector<calibration::Timing>& timings, std::size_t ray_count, double hit_rate) {
        std::printf("%-16s %-13s %-8s", scene.c_str(), structure, rays.name);
        nlohmann::ordered_json row = {{"scene", scene},
                                      {"structure", structure},
                                      {"rays", rays.name},
                                      {"any_hit", rays.any_hit},
                                      {"hit_rate", hit_rate}};
        const auto rate = [&](std::size_t i) { return 1e3 * static_cast<double>(ray_count) / timings[i].ns; };
        for (std::size_t i = 0; i < libraries_.size(); ++i) {
            const std::string& name = libraries_[i]->name();
            std::printf("  %12.3f", rate(i));
            row[name] = {
                {"mray_per_s", rate(i)}, {"spread", timings[i].spread}, {"repetitions", timings[i].repetitions}};
            if (i == 0) continue;
            const double ratio = rate(0) / rate(i);
            std::printf("  %5.3f", ratio);
            row[name]["ratio"] = ratio;
            const std::string where = scene + ", " + structure + ", " + rays.name;
            for (const std::string& group : {std::string("all"), std::string(structure), std::string(rays.name)}) {
                ratios_[i][group].add(ratio, where);
            }
        }
        std::printf("\n");
        std::fflush(stdout);
        rows.push_back(std::move(row));
    }

    // Geometric means over everything, for each structure and for each kind of ray.
    nlohmann::ordered_json summary() const {
        nlohmann::ordered_json summary;
        for (const auto& [i, groups] : ratios_) {
            const std::string& name = libraries_[i]->name();
            for (const auto& [group, ratios] : groups) {
                std::printf("%-13s over %-12s  geometric mean %.3f   worst %.3f (%s)\n", group.c_str(), name.c_str(),
                            ratios.geomean(), ratios.worst(), ratios.worst_scene().c_str());
                summary[name][group] = ratios.json();
            }
        }
        return summary;
    }

    nlohmann::ordered_json rows = nlohmann::ordered_json::array();

private:
    const std::vector<std::unique_ptr<Library>>& libraries_;
    std::map<std::size_t, std::map<std::string, Ratios>> ratios_; // by library and group
};

class Benchmark {
public:
    explicit Benchmark(const Options& options) : options_(options), effort_(effort_of(options.quick)) {
        for (const std::string& argument : options.libraries) {
            const std::size_t equals = argument.find('=');
            libraries_.push_back(std::make_unique<Library>(argument.substr(0, equals), argument.substr(equals + 1)));
        }
    }

    void run() {
        std::vector<NamedMesh> meshes;
        for (const char* file : effort_.files) {
            if (!wanted(file)) continue;
            for (NamedMesh& mesh : mesh_file(*libraries_.front(), options_.data, file))
                meshes.push_back(std::move(mesh));
        }
        for (const char* scene : effort_.scenes) {
            if (wanted(scene)) meshes.push_back(procedural_mesh(scene, effort_.triangles));
        }
        if (meshes.empty()) throw std::runtime_error("no scene has that name");
        Table table(libraries_);
        std::size_t done = 0;
        for (const NamedMesh& mesh : meshes) {
            for (const char* structure : structures) {
                show_progress(done++, meshes.size() * std::size(structures), mesh.name + ", " + structure);
                measure(mesh, structure, table);
            }
        }
        Report report;
        report.target = "triangle-test";
        report.commit = options_.commit;
        report.command = options_.command;
        report.summary = table.summary();
        report.rows = std::move(table.rows);
        if (!options_.json.empty()) save(report, options_.json);
    }

private:
    bool wanted(const std::string& name) const { return options_.only.empty() || name.find(options_.only) == 0; }

    static void show_progress(std::size_t done, std::size_t of, const std::string& what) {
        if (::isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "\r[%zu of %zu] %-40s\r", done + 1, of, what.c_str());
    }

    void measure(const NamedMesh& named, const char* structure, Table& table) {
        std::vector<std::unique_ptr<Built>> scenes;
        for (const auto& library : libraries_) {
            scenes.push_back(raywise_subject({library->name(), structure, {}}, *library)->build({named.mesh}));
        }
        for (const workloads::RayDistribution& distribution : workloads::ray_distributions()) {
            const auto closest = [&](const workloads::Rays& asked) {
                return surface_points(named.mesh, *scenes.front(), asked, 1);
            };
            const RaySet rays = rounded(distribution.make({named.mesh, effort_.rays, ray_seed, closest}));
            if (rays.size() == 0) continue;
            QueryRequest request{rays};
            request.question = distribution.any_hit ? Question::any : Question::closest;
            std::vector<std::unique_ptr<Query>> queries;
            std::vector<calibration::Timed> candidates;
            for (const auto& scene : scenes) {
                queries.push_back(scene->query(request));
                candidates.push_back(calibration::with_clock(
                    [this, &query = *queries.back(), &rays] { hits_ = query.ask(0, rays.size()); },
                    calibration::processor_ns));
            }
            const std::vector<calibration::Timing> timings = time_in_turns(candidates, effort_.timing);
            const double hit_rate =
                static_cast<double>(queries.front()->ask(0, rays.size())) / static_cast<double>(rays.size());
            table.add(named.name, structure, distribution, timings, rays.size(), hit_rate);
        }
    }

    const Options& options_;
    Effort effort_;
    std::vector<std::unique_ptr<Library>> libraries_;
    volatile std::uint64_t hits_ = 0; // so that no answer can be left out
};

int run(int argc, char** argv) {
    CLI::App app(
        "What the exact triangle test costs: single-ray throughput against other triangle tests in the same "
        "structures.");
    Options options;
    app.add_option("libraries", options.libraries, "builds of libraywise, ours first")
        ->type_name("NAME=PATH")
        ->required()
        ->check([](const std::string& text) {
            return text.find('=') == std::string::npos ? std::string("NAME=PATH is wanted") : std::string();
        });
    app.add_flag("--quick", options.quick, "few and small scenes: to see that it runs");
    app.add_option("--data", options.data, "folder with mesh files; those that are not there are left out");
    app.add_option("--json", options.json, "where the report goes");
    app.add_option("--commit", options.commit, "of the sources, for the report");
    app.add_option("--only", options.only, "scenes whose name begins so");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    for (int i = 0; i < argc; ++i) options.command += std::string(i > 0 ? " " : "") + argv[i];
    // Builders are to use the same costs whatever profiles lie around.
    ::setenv("RAYWISE_CALIBRATION", "builtin", 1);
    Benchmark(options).run();
    return 0;
}

} // namespace
} // namespace raywise::bench

int main(int argc, char** argv) {
    try {
        return raywise::bench::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_triangle_test: %s\n", error.what());
        return 1;
    }
}
