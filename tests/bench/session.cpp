#include "bench/session.h"

#include "bench/surface_points.h"
#include "bench/table.h"

#include "rays/rays.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raywise::bench {
namespace {

constexpr double ms = 1e6;
constexpr std::uint64_t ray_seed = 2;

// Of the rays. Peers round differently at edges, which more than this part of the rays do not meet.
constexpr double hits_tolerance = 1e-4;

bool listed(const std::vector<std::string>& list, const std::string& name) {
    return list.empty() || std::find(list.begin(), list.end(), name) != list.end();
}

void compare_hits(Session& session, const Cell& cell, const std::vector<Entry>& entries,
                  const std::vector<std::uint64_t>& hits) {
    const auto reference =
        std::find_if(entries.begin(), entries.end(), [](const Entry& entry) { return entry.subject->traits().peer; });
    if (reference == entries.end()) return;
    const std::uint64_t expected = hits[static_cast<std::size_t>(reference - entries.begin())];
    std::string others;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (entries[i].rays != reference->rays) continue;
        const std::uint64_t difference = std::max(hits[i], expected) - std::min(hits[i], expected);
        if (static_cast<double>(difference) <= hits_tolerance * static_cast<double>(entries[i].rays)) continue;
        others += "; " + entries[i].label + " " + with_commas(hits[i]);
    }
    if (others.empty()) return;
    session.warnings.push_back(cell.scene + ", " + cell.section + ", " + cell.rays + " " + cell.query + ": of " +
                               with_commas(reference->rays) + " rays " + reference->label + " hits with " +
                               with_commas(expected) + others);
}

double ns_per_ray(const Built& built, const RaySet& rays, Question question) {
    QueryRequest request{rays};
    request.question = question;
    const std::unique_ptr<Query> query = built.query(request);
    const double start = calibration::processor_ns();
    query->ask(0, rays.size());
    return (calibration::processor_ns() - start) / static_cast<double>(rays.size());
}

} // namespace

const char* const ours_forced = "raywise bvh";
const char* const ours_quality = "raywise bvh_quality";
const char* const ours_morton = "raywise bvh_morton";
const char* const ours_chosen = "raywise";

Effort effort_of(const Options& options) {
    const unsigned n = options.repetitions;
    if (options.quick) {
        return {20000, 100000, 20 * ms, 100 * ms, {10 * ms, n, 300 * ms}, {0.0, n, 1000 * ms}, 100000, 10000, 500 * ms};
    }
    return {200000, 1000000, 250 * ms, 2000 * ms, {50 * ms, n, 30000 * ms}, {0.0, n, 60000 * ms},
            300000, 1000000, 5000 * ms};
}

bool Session::wants_rays(const std::string& kind) const { return listed(options.rays, kind); }
bool Session::wants_query(Question question) const { return listed(options.queries, name_of(question)); }

bool Session::fits(const Subject& subject, std::uint64_t triangles) const {
    return !subject.traits().slow || triangles <= effort.slow_triangles;
}

SceneUnderTest::SceneUnderTest(Session& session, std::string name, TestScene scene)
    : session_(session), name_(std::move(name)), scene_(std::move(scene)) {}

bool SceneUnderTest::has_rays(std::size_t kind) const {
    return scene_.rays_from_height == 0.0 || std::string(workloads::ray_distributions()[kind].name) == "random";
}

void SceneUnderTest::release(const Subjects& subjects) {
    for (auto place = built_.begin(); place != built_.end();) {
        const bool listed = std::any_of(subjects.begin(), subjects.end(),
                                        [&](const auto& subject) { return subject.get() == place->first.first; });
        place = listed ? built_.erase(place) : std::next(place);
    }
}

const Built& SceneUnderTest::built(const Subject& subject, std::size_t kind) {
    std::unique_ptr<Built>& built = built_[{&subject, subject.traits().chooses ? kind : 0}];
    if (!built) {
        BuildRequest request{scene_.mesh};
        request.offset = scene_.offset;
        request.threads = session_.all_threads;
        request.kind = kind;
        built = subject.build(request);
    }
    return *built;
}

RaySet SceneUnderTest::rays(std::size_t kind, std::uint64_t count) {
    const Subject& tracer = *session_.subjects.front();
    const auto closest = [&](const workloads::Rays& asked) {
        return surface_points(scene_.mesh, built(tracer, 0), asked, session_.all_threads);
    };
    const workloads::Mesh& aimed_at = scene_.aimed_at ? *scene_.aimed_at : scene_.mesh;
    RaySet rays = rounded(workloads::ray_distributions()[kind].make({aimed_at, count, ray_seed, closest}));
    if (scene_.rays_from_height > 0.0) {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            // From the sphere around the scene to its inner half.
            rays.origin[3 * i] *= 0.5F;
            rays.origin[3 * i + 1] *= 0.5F;
            rays.origin[3 * i + 2] = static_cast<float>(scene_.rays_from_height);
            rays.direction[3 * i] = rays.direction[3 * i + 1] = 0.0F;
            rays.direction[3 * i + 2] = -1.0F;
        }
    }
    return rays;
}

Cell SceneUnderTest::cell(const char* section, const char* rays, Question question) const {
    Cell cell;
    cell.section = section;
    cell.scene = name_;
    cell.triangles = triangles();
    cell.rays = rays;
    cell.query = name_of(question);
    cell.unit = "Mray/s";
    return cell;
}

void time_rays(SceneUnderTest& scene, Cell& cell, std::vector<Entry>& entries,
               const calibration::TimingLimits& limits) {
    // What one thread does, in processor time: pauses in which other programs had the processor do not count.
    const calibration::Clock clock = cell.threads == 1 ? calibration::processor_ns : calibration::now_ns;
    std::vector<std::uint64_t> hits(entries.size());
    std::vector<calibration::Timed> candidates;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Entry& entry = entries[i];
        candidates.push_back(
            calibration::with_clock([&hits, &entry, i] { hits[i] = entry.query->ask(0, entry.rays); }, clock));
    }
    const std::vector<calibration::Timing> timings = time_in_turns(candidates, limits);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Entry& entry = entries[i];
        Value value;
        value.subject = entry.label;
        value.peer = entry.subject->traits().peer;
        value.robust = entry.subject->traits().robust;
        value.value = 1e3 * static_cast<double>(entry.rays) / timings[i].ns;
        value.spread = timings[i].spread;
        value.repetitions = timings[i].repetitions;
        value.hit_rate = static_cast<double>(hits[i]) / static_cast<double>(entry.rays);
        value.structure = entry.structure;
        value.instruction_set = entry.subject->traits().instruction_set;
        cell.values.push_back(std::move(value));
    }
    compare_hits(scene.session(), cell, entries, hits);
}

calibration::Timed timed_build(const Subject& subject, const BuildRequest& request, calibration::Clock clock) {
    return [&subject, request, clock](std::uint64_t calls) {
        calibration::Elapsed elapsed{0.0, 0.0};
        const double start = clock();
        for (std::uint64_t i = 0; i < calls; ++i) {
            const double begin = clock();
            const std::unique_ptr<Built> built = subject.build(request);
            elapsed.counted += clock() - begin;
        }
        elapsed.spent = clock() - start;
        return elapsed;
    };
}

std::size_t thinned_by(const Built& built, const RaySet& rays, Question question, double pass_ns) {
    const RaySet few = one_in(rays, std::max<std::size_t>(rays.size() / 100, 1));
    const double ns = ns_per_ray(built, few, question);
    return std::max<std::size_t>(1, static_cast<std::size_t>(ns * static_cast<double>(rays.size()) / pass_ns));
}

std::uint64_t affordable_rays(SceneUnderTest& scene, std::size_t kind, Question question, std::uint64_t wanted,
                              double pass_ns) {
    constexpr std::uint64_t trial = 1000;
    const Subjects& subjects = scene.session().subjects;
    const auto peer = std::find_if(subjects.begin(), subjects.end(), [&](const auto& subject) {
        return subject->traits().peer && scene.session().fits(*subject, scene.triangles());
    });
    const Subject& ours = *subjects.front();
    const RaySet rays = scene.rays(kind, trial);
    if (rays.size() == 0) return 0;
    double slowest = ns_per_ray(scene.built(ours, kind), rays, question);
    if (peer != subjects.end()) slowest = std::max(slowest, ns_per_ray(scene.built(**peer, kind), rays, question));
    return std::clamp(static_cast<std::uint64_t>(pass_ns / std::max(slowest, 1.0)), std::min(trial, wanted), wanted);
}

} // namespace raywise::bench
