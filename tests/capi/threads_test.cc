// One scene asked by many threads at once, while others are made and given back. For the thread sanitizer: the
// library's own threads stay out of it, as oneTBB is not built for it.
#include "testing.h"

#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace {

rw_scene* make_alone(const soup& s, const char* structure) {
    rw_scene* scene = nullptr;
    const rw_triangles t = triangles_of(&s);
    rw_commit_options options{};
    options.struct_size = sizeof options;
    options.threads = 1;
    if (rw_scene_create(nullptr, &scene) != RW_OK || rw_scene_add_triangles(scene, &t, nullptr) != RW_OK ||
        rw_scene_set_structure(scene, structure) != RW_OK || rw_scene_commit(scene, &options) != RW_OK) {
        return nullptr;
    }
    return scene;
}

rw_scene* make_view(const rw_scene* scene) {
    rw_scene* view = nullptr;
    rw_view_options options{};
    rw_commit_options commit{};
    options.struct_size = sizeof options;
    options.count = 1000;
    options.origin[2] = 3.0;
    commit.struct_size = sizeof commit;
    commit.threads = 1;
    return rw_scene_view(scene, &options, &commit, &view) == RW_OK ? view : nullptr;
}

// What one thread does; tells how often something was wrong.
int work(const rw_scene* scene, const rw_scene* view, const soup& s, const std::vector<rw_ray>& rays,
         const std::vector<rw_hit>& wanted, int number) {
    int wrong = 0;
    const auto expect = [&wrong](bool good) { wrong += good ? 0 : 1; };
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rw_hit hit;
        int32_t any = 5;
        uint64_t needed = 0;
        const rw_ray& ray = rays[(i * 7 + static_cast<std::size_t>(number)) % rays.size()];
        const rw_hit& right = wanted[(i * 7 + static_cast<std::size_t>(number)) % rays.size()];
        expect(rw_scene_intersect(scene, &ray, nullptr, &hit) == RW_OK && memcmp(&hit, &right, sizeof hit) == 0);
        expect(rw_scene_intersect(view, &ray, nullptr, &hit) == RW_OK && memcmp(&hit, &right, sizeof hit) == 0);
        expect(rw_scene_occluded(scene, &ray, nullptr, &any) == RW_OK &&
               any == (right.primitive != RW_INVALID_ID ? 1 : 0));
        expect(rw_scene_intersect_all(scene, &ray, nullptr, nullptr, 0, &needed) == RW_OK);
    }
    std::vector<double> t(rays.size());
    rw_rays batch{};
    batch.struct_size = sizeof batch;
    batch.count = rays.size();
    batch.origin.data = rays[0].origin;
    batch.direction.data = rays[0].direction;
    batch.origin.stride = batch.direction.stride = sizeof(rw_ray);
    batch.origin.type = batch.direction.type = RW_FLOAT64;
    rw_hits hits{};
    hits.struct_size = sizeof hits;
    hits.t.data = t.data();
    hits.t.type = RW_FLOAT64;
    rw_query_options one{};
    one.struct_size = sizeof one;
    one.threads = 1;
    expect(rw_scene_intersect_batch(scene, &batch, &hits, &one) == RW_OK);
    for (std::size_t i = 0; i < rays.size(); ++i) expect(memcmp(&t[i], &wanted[i].t, sizeof t[i]) == 0);

    // Errors belong to their thread.
    const std::string name = "structure of thread " + std::to_string(number);
    rw_scene* own = nullptr;
    expect(rw_scene_create(nullptr, &own) == RW_OK);
    expect(rw_scene_set_structure(own, name.c_str()) == RW_ERROR_UNKNOWN_STRUCTURE);
    std::this_thread::yield();
    expect(strstr(rw_last_error_message(), name.c_str()) != nullptr);
    rw_scene_release(own);

    // References, facts, and scenes of one's own.
    for (int i = 0; i < 200; ++i) expect(rw_scene_retain(scene) == RW_OK && rw_scene_release(scene) == RW_OK);
    rw_scene_statistics statistics;
    statistics.struct_size = sizeof statistics;
    uint64_t needed = 0;
    expect(rw_scene_get_statistics(scene, &statistics) == RW_OK && statistics.triangle_count == s.triangles);
    expect(rw_scene_explain(scene, RW_FORMAT_JSON, nullptr, 0, &needed) == RW_OK && needed > 1);
    own = make_alone(s, number % 2 == 0 ? "bvh" : "uniform_grid");
    expect(own != nullptr);
    rw_scene* own_view = make_view(scene);
    expect(own_view != nullptr);
    rw_scene_release(own_view);
    rw_scene_release(own);
    return wrong;
}

} // namespace

int main() {
    use_all_helpers();
    soup s = make_soup(300);
    std::vector<rw_ray> rays;
    for (int i = 0; i < 150; ++i) rays.push_back(random_ray());
    uint32_t structures = 0;
    NEED_OK(rw_structure_count(&structures));
    for (uint32_t k = 0; k < structures; ++k) {
        const char* name = nullptr;
        NEED_OK(rw_structure_name(k, &name));
        rw_scene* scene = make_alone(s, name);
        CHECK(scene != nullptr);
        rw_scene* view = make_view(scene);
        CHECK(view != nullptr);
        std::vector<rw_hit> wanted(rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i)
            CHECK_OK(rw_scene_intersect(scene, &rays[i], nullptr, &wanted[i]));
        std::atomic<int> wrong{0};
        std::vector<std::thread> threads;
        for (int number = 0; number < 4; ++number) {
            threads.emplace_back([&, number] { wrong += work(scene, view, s, rays, wanted, number); });
        }
        for (std::thread& thread : threads) thread.join();
        CHECK(wrong == 0);
        rw_scene_statistics statistics;
        statistics.struct_size = sizeof statistics;
        CHECK_OK(rw_scene_get_statistics(scene, &statistics));
        CHECK(statistics.rays == 4 * rays.size());
        rw_scene_release(scene); // the view keeps it
        rw_hit hit;
        CHECK_OK(rw_scene_intersect(view, &rays[0], nullptr, &hit));
        CHECK(memcmp(&hit, &wanted[0], sizeof hit) == 0);
        rw_scene_release(view);
    }
    free_soup(&s);
    return finish("threads");
}
