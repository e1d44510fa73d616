#include "measure/measure.h"

#include "base/structure.h"
#include "measure/exact_test.h"
#include "measure/library.h"
#include "model/cost_units.h"
#include "model/workload.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace raywise::calibration {
namespace {

// The same scenes and rays on every machine.
constexpr std::uint64_t seed = 20110131;

const std::size_t camera = ray_kind_index(RayKind::camera);
const std::size_t shadow = ray_kind_index(RayKind::shadow);

// Builds so many times, and counts what the library says the building took. It tells wall time; what other programs
// took of that is taken off in the proportion in which they took it from the whole call.
template <class Build>
Elapsed time_builds(std::uint64_t calls, Clock clock, Build build) {
    Elapsed elapsed{};
    for (std::uint64_t i = 0; i < calls; ++i) {
        const double wall_start = now_ns(), start = clock();
        const Built& built = build();
        const double spent = clock() - start, wall = now_ns() - wall_start;
        elapsed.spent += spent;
        elapsed.counted += built.build_ns() * std::min(spent / wall, 1.0);
    }
    return elapsed;
}

class MeshMeasurement {
public:
    MeshMeasurement(const Plan& plan, const MeshPlan& mesh_plan, std::uint32_t threads, const rw_profile* profile,
                    MeasureResult& result, std::vector<double>& spreads)
        : plan_(plan),
          mesh_(workloads::scene_named(mesh_plan.scene.c_str())->make(mesh_plan.triangles, seed)),
          threads_(threads),
          clock_(threads == 1 ? processor_ns : now_ns),
          profile_(profile),
          result_(result),
          spreads_(spreads) {}

    void run() {
        measure_builds();
        make_rays();
        measure_view_builds();
        for (std::size_t kind = 0; kind < measured_ray_kinds.size(); ++kind) measure_rays(kind);
    }

private:
    // Structures that want a view are built here as well, for rays that have none; what that takes is not noted.
    void measure_builds() {
        std::vector<Timed> builds;
        for (const Structure structure : all_structures()) {
            builds.push_back([this, structure](std::uint64_t calls) {
                return time_builds(calls, clock_, [&]() -> const Built& {
                    scenes_[structure].reset(); // never twice the memory
                    scenes_[structure] = std::make_unique<BuiltScene>(mesh_, name_of(structure), profile_, threads_);
                    return *scenes_[structure];
                });
            });
        }
        const std::vector<Timing> timings = time_in_turns(builds, plan_.build_timing);
        for (const Structure structure : all_structures()) {
            if (!needs_view(structure))
                note_build(structure, timings[static_cast<std::size_t>(structure)], *scenes_[structure]);
        }
    }

    // As seen by a scene that expects any number of rays.
    const SceneFeatures& features() const { return scenes_[Structure::bvh]->features(); }

    void note_build(Structure structure, const Timing& timing, const Built& built) {
        result_.measurements.builds.push_back({structure, features(), timing.ns, built.bytes()});
        note_spread(timing);
    }

    void note_spread(const Timing& timing) {
        if (timing.repetitions >= 3) spreads_.push_back(timing.spread); // of two there are no quartiles
    }

    void make_rays() {
        const workloads::ClosestHits closest = [this](const workloads::Rays& rays) {
            return scenes_[Structure::bvh]->closest(rays, threads_);
        };
        for (const workloads::RayDistribution& distribution : workloads::ray_distributions()) {
            rays_.push_back(distribution.make({mesh_, plan_.rays, seed, closest}));
        }
    }

    // The camera's view just holds the image; the light shines all around.
    ViewPlace place_of(std::size_t kind) const {
        if (kind == shadow) return {workloads::light_of(mesh_), Vec3(0.0), 0.0, RW_RAYS_SHADOW};
        const workloads::Camera camera_place = workloads::camera_of(mesh_);
        const Vec3 forward = glm::normalize(camera_place.target - camera_place.eye);
        double least_cosine = 1.0;
        for (std::uint64_t i = 0; i < rays_[camera].size(); ++i) {
            least_cosine = std::min(least_cosine, glm::dot(forward, glm::normalize(rays_[camera].direction_of(i))));
        }
        return {camera_place.eye, forward, std::acos(least_cosine) + 1e-3, RW_RAYS_CAMERA};
    }

    void measure_view_builds() {
        for (const Structure structure : all_structures()) {
            if (!needs_view(structure)) continue;
            std::vector<Timed> builds;
            for (const std::size_t kind : {camera, shadow}) {
                builds.push_back([this, kind, structure, place = place_of(kind)](std::uint64_t calls) {
                    return time_builds(calls, clock_, [&]() -> const Built& {
                        std::unique_ptr<BuiltView>& view = views_[structure][kind];
                        view.reset();
                        view =
                            std::make_unique<BuiltView>(*scenes_[Structure::bvh], place, name_of(structure), threads_);
                        return *view;
                    });
                });
            }
            const std::vector<Timing> timings = time_in_turns(builds, plan_.build_timing);
            note_build(structure, timings[0], *views_[structure][camera]);
            note_build(structure, timings[1], *views_[structure][shadow]);
        }
    }

    Built& asked(Structure structure, std::size_t kind) {
        if (views_[structure][kind]) return *views_[structure][kind];
        return *scenes_[structure];
    }

    // So many rays that a batch stays within the plan's time, taken evenly from all of them.
    RaySelection selection_for(Built& built, std::size_t kind, bool any_hit) {
        const workloads::Rays& rays = rays_[kind];
        const auto every = [&](std::uint64_t count) {
            return RaySelection{rays, count, std::max<std::uint64_t>(rays.size() / count, 1)};
        };
        std::uint64_t count = std::min(plan_.fewest_rays, rays.size());
        while (count < rays.size()) {
            const double start = clock_();
            built.ask(every(count), any_hit, threads_);
            const double ns_per_ray = (clock_() - start) / static_cast<double>(count);
            const double affordable = plan_.most_call_ns / ns_per_ray;
            if (affordable < 2.0 * static_cast<double>(count)) break;
            count = std::min({rays.size(), count * 16, static_cast<std::uint64_t>(affordable)});
        }
        return every(count);
    }

    void measure_rays(std::size_t kind) {
        if (rays_[kind].size() == 0) return; // nothing in view
        const bool any_hit = workloads::ray_distributions()[kind].any_hit;
        std::vector<Timed> batches;
        std::vector<double> counts;
        for (const Structure structure : all_structures()) {
            Built& built = asked(structure, kind);
            const RaySelection selection = selection_for(built, kind, any_hit);
            counts.push_back(static_cast<double>(selection.count));
            batches.push_back(
                with_clock([this, &built, selection, any_hit] { built.ask(selection, any_hit, threads_); }, clock_));
        }
        const std::vector<Timing> timings = time_in_turns(batches, plan_.ray_timing);
        for (const Structure structure : all_structures()) {
            const std::size_t i = static_cast<std::size_t>(structure);
            result_.measurements.rays.push_back({structure, kind, features(), timings[i].ns / counts[i]});
            note_spread(timings[i]);
        }
    }

    const Plan& plan_;
    const workloads::Mesh mesh_;
    const std::uint32_t threads_;
    const Clock clock_;
    const rw_profile* profile_;
    MeasureResult& result_;
    std::vector<double>& spreads_;
    PerStructure<std::unique_ptr<BuiltScene>> scenes_;
    PerStructure<std::array<std::unique_ptr<BuiltView>, measured_ray_kinds.size()>> views_;
    std::vector<workloads::Rays> rays_;
};

void check_ray_kinds() {
    const auto& distributions = workloads::ray_distributions();
    bool same = distributions.size() == measured_ray_kind_names.size();
    for (std::size_t i = 0; same && i < distributions.size(); ++i) {
        same = std::string(distributions[i].name) == measured_ray_kind_names[i];
    }
    if (!same) throw std::logic_error("the ray distributions are not the measured ray kinds");
}

} // namespace

MeasureResult measure(const Plan& plan, std::uint32_t threads, const MeasureProgress& progress) {
    check_structures();
    check_ray_kinds();
    const Handle<rw_profile> profile = builtin_profile();
    MeasureResult result;
    std::vector<double> spreads;
    NoiseWatch watch;
    const double start = now_ns();
    const auto seconds = [start] { return (now_ns() - start) * 1e-9; };
    for (const MeshPlan& mesh : plan.meshes) {
        // Time passes more evenly than meshes do where a limit is near.
        const double done = static_cast<double>(result.meshes) / static_cast<double>(plan.meshes.size());
        progress(std::max(done, std::min(seconds() / plan.time_limit, 1.0)),
                 mesh.scene + ", " + std::to_string(mesh.triangles) + " triangles");
        if (seconds() > plan.time_limit) {
            result.out_of_time = true;
            break;
        }
        MeshMeasurement(plan, mesh, threads, profile.get(), result, spreads).run();
        watch.look();
        ++result.meshes;
    }
    progress(1.0, "exact test");
    const Timing exact_test = measure_exact_test(profile.get(), plan.ray_timing, threads == 1 ? processor_ns : now_ns);
    result.measurements.primitive_test_ns = exact_test.ns;
    if (exact_test.repetitions >= 3) spreads.push_back(exact_test.spread);
    progress(1.0, "done");
    result.noise = watch.judge(spreads);
    result.seconds = seconds();
    return result;
}

} // namespace raywise::calibration
