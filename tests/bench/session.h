// One run of the benchmark: what was asked for, who takes part, and what has been found so far.
#pragma once

#include "bench/cells.h"
#include "bench/scenes/bench_scenes.h"
#include "bench/subjects/subject.h"

#include "measure/timing.h"
#include "progress_bar.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace raywise::bench {

class EmbreeLibrary;

// Names of raywise's rows in the table of subjects, which the summary asks for.
extern const char* const ours_forced;  // bvh
extern const char* const ours_quality; // bvh_quality, where the library has it
extern const char* const ours_morton;  // bvh_morton, likewise
extern const char* const ours_chosen;  // the library chooses

struct Options {
    bool quick = false;
    unsigned repetitions = 5;
    std::vector<std::string> scenes;   // empty: all
    std::vector<std::string> rays;     // kinds
    std::vector<std::string> queries;  // closest, any
    std::vector<std::string> sections; // names in sections/section.h
    std::vector<std::string> subjects; // beginnings of names
};

// How much is asked of each cell.
struct Effort {
    std::uint64_t single_rays;
    std::uint64_t batch_rays;
    double single_pass_ns; // rays are fewer where one pass over them would take longer
    double batch_pass_ns;
    calibration::TimingLimits timing;       // of rays
    calibration::TimingLimits build_timing; // of builds, which are not repeated to fill a time
    std::uint64_t slow_triangles;           // largest scene for subjects that are slow
    std::uint64_t totals_measured;          // rays from cold that are asked in full; more are extrapolated
    double totals_ns;                       // as is what would take longer
};

Effort effort_of(const Options& options);

struct Session {
    const Options& options;
    Effort effort;
    const Library& library;
    const Subjects& subjects;
    const Subjects& yardstick; // as in TakingPart, as is avx2
    const Subjects& avx2;
    const EmbreeLibrary* embree3; // none: it is not there
    unsigned all_threads;
    std::vector<std::string> own_command; // runs this program again with the same libraries
    Cells cells;
    std::vector<std::string> warnings;
    bool failed = false; // a check, which a warning tells about
    std::function<void(const std::string& what)> show_progress;

    bool wants_rays(const std::string& kind) const;
    bool wants_query(Question question) const;
    // Takes part in scenes of that size.
    bool fits(const Subject& subject, std::uint64_t triangles) const;
};

// A scene, and what is made for it once: each subject's structure and the rays.
class SceneUnderTest {
public:
    SceneUnderTest(Session& session, std::string name, TestScene scene);

    Session& session() const { return session_; }
    const std::string& name() const { return name_; }
    const workloads::Mesh& mesh() const { return scene_.mesh; }
    std::uint64_t triangles() const { return scene_.mesh.triangle_count(); }
    // Whether rays of that kind (of workloads::ray_distributions()) can be had.
    bool has_rays(std::size_t kind) const;

    // Built with all threads when it is asked for first, and kept. kind: of workloads::ray_distributions().
    const Built& built(const Subject& subject, std::size_t kind);
    // Gives back what was built for these.
    void release(const Subjects& subjects);
    RaySet rays(std::size_t kind, std::uint64_t count);
    // A cell with the scene's columns filled in.
    Cell cell(const char* section, const char* rays, Question question) const;

private:
    Session& session_;
    std::string name_;
    TestScene scene_;
    std::map<std::pair<const Subject*, std::size_t>, std::unique_ptr<Built>> built_;
};

// Rays put to a subject in one cell.
struct Entry {
    const Subject* subject;
    std::string label; // in the cell; the subject's name unless it takes part twice
    std::unique_ptr<Query> query;
    std::size_t rays;
    std::string structure;
};

// Times the entries in turns and adds Mray/s to the cell; warns where hits differ from the first peer's.
void time_rays(SceneUnderTest& scene, Cell& cell, std::vector<Entry>& entries, const calibration::TimingLimits& limits);

// Builds, and counts what that takes but not giving back what was built.
calibration::Timed timed_build(const Subject& subject, const BuildRequest& request, calibration::Clock clock);

// Every how manyth ray a subject is asked so that a pass takes no longer than so many nanoseconds: by a trial with some of them.
std::size_t thinned_by(const Built& built, const RaySet& rays, Question question, double pass_ns);

// How many rays of a kind a pass of so many nanoseconds allows, at most `wanted`: by a trial with ours and the
// first peer that fits.
std::uint64_t affordable_rays(SceneUnderTest& scene, std::size_t kind, Question question, std::uint64_t wanted,
                              double pass_ns);

} // namespace raywise::bench
