// All handles that a sequence of calls has, what is known about each, and the calls that make, change and release them.
#pragma once

#include "fuzz/asked.h"
#include "fuzz/input.h"
#include "fuzz/reference.h"
#include "fuzz/workspace.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace raywise::fuzz {

// One handle with the references this program holds.
template <class H>
struct Held {
    H* handle = nullptr;
    int references = 0;
};

struct SceneState {
    Held<rw_scene> held;
    Meshes meshes;
    std::shared_ptr<const Reference> reference; // set once it is committed
    std::string forced;                         // empty: the library chooses
    std::uint64_t memory_limit = 0;
    std::unique_ptr<Usage> usage = std::make_unique<Usage>();
    bool is_committed() const { return reference != nullptr; }
};

struct ViewState {
    Held<rw_scene> held;
    std::shared_ptr<const Reference> reference;
    std::string forced;
    std::uint64_t memory_limit = 0; // of the scene behind it
};

class World {
public:
    explicit World(Input& input) : input_(input) {}
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    void run(); // until the input is used up
    void describe() const;

private:
    using Step = void (World::*)();
    void make_scene();
    void add_mesh();
    void set_expected_rays();
    void set_options();
    void commit();
    void refit();
    void ask();
    void look_at_facts();
    void make_view();
    void once();
    void keep_and_give_back();
    void use_profile();

    SceneState* any_scene();     // null: there is none
    SceneState* any_committed(); // the same
    std::vector<Asked> everybody(const std::shared_ptr<const Reference>& reference);
    Outcome refused_when_committed(const char* call, const SceneState& scene) const;
    void release_scene(std::size_t index);
    void release_view(std::size_t index);

    Input& input_;
    std::vector<SceneState> scenes_;
    std::vector<ViewState> views_;
    std::vector<Held<rw_profile>> profiles_;
    Workspace workspace_;
};

} // namespace raywise::fuzz
