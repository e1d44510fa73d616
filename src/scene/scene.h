// A scene: filled, told what to expect, committed, and from then on immutable. A view is one too: of the geometry of another scene, with a
// structure chosen for rays from a point or along a direction.
#pragma once

#include "scene/frame_memory.h"
#include "scene/planner.h"
#include "scene/tracer.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace raywise {

// A mesh whose vertices have moved.
struct MovedMesh {
    TriangleArrays arrays; // without indices it has those of before
    bool copy;
    bool skip_invalid;
    std::string name; // in front of messages about it
};

struct ViewRequest {
    ViewFrame frame;
    Workload workload;
    std::optional<Structure> forced;
};

class Scene {
public:
    explicit Scene(std::shared_ptr<const Profile> profile) : profile_(std::move(profile)) {}

    // Before the commit. Each throws Error(ERROR_ALREADY_COMMITTED) after it, and leaves the scene as it was when it throws.
    std::uint32_t add_triangles(const TriangleArrays& arrays, bool copy, bool skip_invalid);
    void set_expected(const Workload& workload, std::vector<Ray> sample);
    void set_memory_limit(std::uint64_t bytes);
    void set_structure(std::optional<Structure> structure);
    void set_effort(Effort effort, Rule rule, double time_limit_seconds);
    void commit(const Parallel& parallel, Progress& progress);

    bool is_committed() const { return tracer_ != nullptr; }

    // A committed scene of the same geometry, for rays of that view. The scene is kept: its own structure is a candidate that costs
    // nothing to build, and its memory limit holds for the view's structure as well. A view of a view is one of the scene behind it.
    // Throws Error(ERROR_NOT_COMMITTED).
    static std::shared_ptr<Scene> seen(std::shared_ptr<const Scene> scene, const ViewRequest& request,
                                       const Parallel& parallel, Progress& progress);

    // A committed scene of the same meshes at new places; what was said of this one before the commit holds for it too. Its structure is
    // this one's refitted, or else built; meshes for one that is never refitted may have other numbers of triangles, and be more or
    // fewer. Of a view: the same view of its scene, refitted. Throws Error with ERROR_NOT_COMMITTED, and with ERROR_INVALID_ARGUMENT
    // when numbers differ.
    std::shared_ptr<Scene> refitted(const std::vector<MovedMesh>& meshes, RefitPolicy policy, const Parallel& parallel,
                                    Progress& progress) const;

    // After it. Each throws Error(ERROR_NOT_COMMITTED) before.
    const Tracer& tracer() const;
    const Plan& plan() const;
    const std::shared_ptr<const Profile>& profile() const { return profile_; }
    std::uint64_t geometry_bytes() const;

private:
    void require_uncommitted() const;
    void require_committed() const;
    void require_same_numbers(const std::vector<MovedMesh>& meshes) const;
    std::shared_ptr<const TriangleMesh> moved_mesh(std::size_t index, const MovedMesh& mesh) const;
    void build(const std::optional<PlanBefore>& before, const Parallel& parallel, Progress& progress);
    void plan_and_commit(const PlanRequest& request, const Parallel& parallel, Progress& progress);

    std::shared_ptr<FrameMemory> frames_ = std::make_shared<FrameMemory>(); // outlives all that is in it
    std::shared_ptr<const Profile> profile_;
    std::vector<std::shared_ptr<const TriangleMesh>> meshes_;
    std::uint64_t triangle_count_ = 0;
    Workload workload_;
    std::vector<Ray> sample_;
    std::uint64_t memory_limit_ = 0;
    std::optional<Structure> forced_;
    Effort effort_ = Effort::estimate;
    Rule rule_ = Rule::smallest_total;
    double time_limit_seconds_ = 0.0;

    std::shared_ptr<const Scene> behind_; // of a view: the scene, which is none itself
    ViewRequest view_;

    Plan plan_;
    std::unique_ptr<const Tracer> tracer_;
};

} // namespace raywise
