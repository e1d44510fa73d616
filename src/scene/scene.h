// A scene: filled, told what to expect, committed, and from then on immutable.
#pragma once

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

    // A committed scene of the same meshes at new places; what was said of this one before the commit holds for it too. Its structure is
    // this one's refitted, or else built. Throws Error with ERROR_NOT_COMMITTED, and with ERROR_INVALID_ARGUMENT when numbers differ.
    std::shared_ptr<Scene> refitted(const std::vector<MovedMesh>& meshes, const Parallel& parallel,
                                    Progress& progress) const;

    // After it. Each throws Error(ERROR_NOT_COMMITTED) before.
    const Tracer& tracer() const;
    const Plan& plan() const;
    const std::shared_ptr<const Profile>& profile() const { return profile_; }
    std::uint64_t memory_limit() const { return memory_limit_; }
    std::uint64_t geometry_bytes() const;

private:
    void require_uncommitted() const;
    void require_committed() const;
    void build(const std::optional<PlanBefore>& before, const Parallel& parallel, Progress& progress);

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

    Plan plan_;
    std::unique_ptr<const Tracer> tracer_;
};

} // namespace raywise
