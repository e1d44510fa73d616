#include "scenes/scenes.h"

#include <cstring>

namespace raywise::workloads {

#define RW_SCENE(name, description) Mesh make_##name(std::uint64_t triangles, std::uint64_t seed);
#include "scenes/scene_list.def"
#undef RW_SCENE

const std::vector<Scene>& scenes() {
    static const std::vector<Scene> all = {
#define RW_SCENE(name, description) {#name, description, make_##name},
#include "scenes/scene_list.def"
#undef RW_SCENE
    };
    return all;
}

const Scene* scene_named(const char* name) {
    for (const Scene& scene : scenes()) {
        if (std::strcmp(scene.name, name) == 0) return &scene;
    }
    return nullptr;
}

Box Mesh::bounds() const {
    Box box;
    for (const std::uint32_t index : indices) {
        const std::size_t i = std::size_t{index} * 3;
        box.extend(Vec3(vertices[i], vertices[i + 1], vertices[i + 2]));
    }
    return box;
}

} // namespace raywise::workloads
