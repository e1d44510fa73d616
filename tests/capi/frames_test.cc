// Frame after frame in the memory of the last one: in steady state nothing of the mesh's size comes from malloc, and all goes back with the
// last scene.
#include "testing.h"

#include "refusing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace {

constexpr uint64_t triangles = 70000;
// Most have all they need after three; arrays of bvh_quality's steps differ so little in length that they find their blocks in the fifth, lists that
// grow, of two_level_grid and kd_tree, up to the ninth.
constexpr int frames_to_settle = 12;
constexpr int frames = frames_to_settle + 3;
// What any array with a number for each triangle takes, or the parts that threads make.
constexpr long small = 256 << 10;
static_assert(4 * triangles > small);

std::vector<float> soup_of(uint64_t count, int frame) {
    soup s = make_soup(count);
    std::vector<float> vertices(s.vertices, s.vertices + 9 * count);
    free_soup(&s);
    for (size_t i = 0; i < vertices.size(); ++i)
        vertices[i] += 0.02f * std::sin(static_cast<float>(frame)) * static_cast<float>(i % 5);
    return vertices;
}

rw_triangles describe(const std::vector<float>& vertices) {
    rw_triangles t{};
    t.struct_size = sizeof t;
    t.vertex_count = vertices.size() / 3;
    t.triangle_count = vertices.size() / 9;
    t.vertices.data = vertices.data();
    t.vertices.type = RW_FLOAT32;
    return t;
}

rw_commit_options options_of(int32_t refit) {
    rw_commit_options options{};
    options.struct_size = sizeof options;
    options.threads = 1;
    options.refit = refit;
    return options;
}

rw_scene* make(const char* structure, const std::vector<float>& vertices) {
    const rw_commit_options options = options_of(RW_REFIT_WHERE_IT_PAYS);
    const rw_triangles mesh = describe(vertices);
    rw_scene* scene = nullptr;
    NEED_OK(rw_scene_create(nullptr, &scene));
    NEED_OK(rw_scene_set_structure(scene, structure));
    NEED_OK(rw_scene_add_triangles(scene, &mesh, nullptr));
    NEED_OK(rw_scene_commit(scene, &options));
    return scene;
}

uint64_t kept() {
    uint64_t bytes = 0;
    CHECK_OK(rw_memory_kept(&bytes));
    return bytes;
}

void ask(const rw_scene* scene) {
    rw_ray ray{};
    ray.origin[2] = 4.0;
    ray.direction[0] = 0.01;
    ray.direction[2] = -1.0;
    ray.tmax = INFINITY;
    rw_hit hit;
    CHECK_OK(rw_scene_intersect(scene, &ray, nullptr, &hit));
    CHECK(hit.primitive != RW_INVALID_ID);
}

// structure: NULL: the library chooses.
void make_frames(const char* structure, int32_t refit) {
    std::vector<std::vector<float>> vertices;
    for (int frame = 0; frame < frames; ++frame) vertices.push_back(soup_of(triangles, frame));
    rw_scene* scene = make(structure, vertices[0]);
    rw_scene_statistics first{}, last{};
    first.struct_size = last.struct_size = sizeof first;
    CHECK_OK(rw_scene_get_statistics(scene, &first));
    long largest = 0;
    for (int frame = 0; frame < frames; ++frame) {
        const rw_commit_options options = options_of(refit);
        const rw_triangles mesh = describe(vertices[static_cast<size_t>(frame)]);
        rw_scene* next = nullptr;
        if (frame == frames_to_settle) largest_allocation();
        NEED_OK(rw_scene_refit(scene, &mesh, 1, &options, &next));
        CHECK_OK(rw_scene_release(scene));
        scene = next;
        ask(scene);
        if (frame >= frames_to_settle) largest = std::max(largest, largest_allocation());
    }
    CHECK_OK(rw_scene_get_statistics(scene, &last));
    if (largest >= small)
        fprintf(stderr, "%s, refit %d: an allocation of %ld bytes\n", structure == nullptr ? "chosen" : structure,
                refit, largest);
    CHECK(largest < small);
    // What is told is what the structure holds, whatever it was given.
    CHECK(last.geometry_bytes == first.geometry_bytes);
    CHECK(last.structure_bytes < first.structure_bytes + first.structure_bytes / 4);
    CHECK(kept() > 0);
    CHECK_OK(rw_scene_release(scene));
    CHECK(kept() == 0);
}

void all_structures() {
    uint32_t count = 0;
    NEED_OK(rw_structure_count(&count));
    for (uint32_t i = 0; i < count; ++i) {
        const char* name = nullptr;
        NEED_OK(rw_structure_name(i, &name));
        make_frames(name, RW_REFIT_NEVER);
        if (std::string(name).substr(0, 3) == "bvh") make_frames(name, RW_REFIT_WHERE_POSSIBLE);
    }
    make_frames(nullptr, RW_REFIT_WHERE_IT_PAYS);
    make_frames(nullptr, RW_REFIT_NEVER);
}

// A program that knows nothing of frames: released first, then made anew, with other numbers of triangles.
void new_scenes() {
    std::vector<std::vector<float>> vertices;
    for (int frame = 0; frame < frames; ++frame)
        vertices.push_back(soup_of(triangles + 300 * static_cast<uint64_t>(frame % 3), frame));
    const uint64_t most = uint64_t{1} << 30;
    CHECK_OK(rw_memory_keep(most));
    for (int frame = 0; frame < frames; ++frame) {
        if (frame == frames_to_settle) largest_allocation();
        rw_scene* scene = make("bvh", vertices[static_cast<size_t>(frame)]);
        ask(scene);
        CHECK_OK(rw_scene_release(scene));
    }
    CHECK(largest_allocation() < small);
    CHECK(kept() > 0 && kept() <= most);
    CHECK_OK(rw_memory_keep(kept() / 2));
    CHECK(kept() > 0);
    CHECK_OK(rw_memory_keep(0));
    CHECK(kept() == 0);
    CHECK(rw_memory_kept(nullptr) == RW_ERROR_INVALID_ARGUMENT);
}

// Refused memory in the middle of frames: an error, what is kept is given back and tried, and the next frame is as any other.
void refused_memory() {
    const std::vector<float> vertices = soup_of(triangles, 1);
    const long before = live_bytes();
    rw_scene* scene = make("bvh", vertices);
    const rw_commit_options options = options_of(RW_REFIT_NEVER);
    const rw_triangles mesh = describe(vertices);
    int refused_frames = 0;
    for (int number = 0; number < 120; number += 11) {
        rw_scene* next = nullptr;
        refuse(REFUSE_FROM_ON, number);
        const int32_t status = rw_scene_refit(scene, &mesh, 1, &options, &next);
        stop_refusing();
        if (status == RW_OK) {
            CHECK_OK(rw_scene_release(scene));
            scene = next;
        } else {
            CHECK(status == RW_ERROR_OUT_OF_MEMORY && next == nullptr);
            ++refused_frames;
        }
        ask(scene);
    }
    CHECK(refused_frames > 0);
    CHECK_OK(rw_scene_release(scene));
    CHECK(kept() == 0);
    CHECK(live_bytes() - before < 64 << 10);
}

} // namespace

int main() {
    all_structures();
    new_scenes();
    refused_memory();
    return finish("frames");
}
