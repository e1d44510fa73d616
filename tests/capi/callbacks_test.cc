// Callbacks of the host: progress that stops, progress that throws, parallel-fors that are right and wrong.
#include "testing.h"

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace {

struct Log {
    int calls = 0;
    int stop_at = 0; // 0: never
    bool throws = false;
    bool inside = false;
    bool good = true;
    double highest = 0.0;
};

int32_t progress(void* user, double fraction, const char* stage) {
    Log& log = *static_cast<Log*>(user);
    if (log.inside) log.good = false; // never from two threads at once
    log.inside = true;
    log.good = log.good && fraction >= 0.0 && fraction <= 1.0 && stage != nullptr && stage[0] != '\0';
    log.highest = fraction > log.highest ? fraction : log.highest;
    ++log.calls;
    log.inside = false;
    if (log.throws) throw std::runtime_error("thrown by the host's progress callback");
    return log.calls == log.stop_at ? 1 : 0;
}

void in_order(void*, uint64_t count, rw_task task, void* data) {
    for (uint64_t i = 0; i < count; ++i) task(data, i);
}
void backwards(void*, uint64_t count, rw_task task, void* data) {
    for (uint64_t i = count; i-- > 0;) task(data, i);
}
void in_threads(void* user, uint64_t count, rw_task task, void* data) {
    std::atomic<uint64_t> next{0};
    const auto work = [&] {
        for (uint64_t i = next++; i < count; i = next++) task(data, i);
    };
    std::vector<std::thread> threads;
    for (int i = 1; i < 3; ++i) threads.emplace_back(work);
    work();
    for (std::thread& thread : threads) thread.join();
    if (user != nullptr) ++*static_cast<std::atomic<int>*>(user);
}
void leaves_one_out(void*, uint64_t count, rw_task task, void* data) {
    for (uint64_t i = 0; i + 1 < count; ++i) task(data, i);
}
void does_nothing(void*, uint64_t, rw_task, void*) {}
void repeats_one(void*, uint64_t count, rw_task task, void* data) {
    for (uint64_t i = 0; i < count; ++i) task(data, i);
    if (count > 0) task(data, 0);
}
void goes_beyond(void*, uint64_t count, rw_task task, void* data) {
    for (uint64_t i = 0; i <= count; ++i) task(data, i);
}
void throws(void*, uint64_t count, rw_task task, void* data) {
    for (uint64_t i = 0; i < count; ++i) task(data, i);
    throw 17;
}

rw_scene* filled(const soup& s, const char* structure) {
    rw_scene* scene = nullptr;
    const rw_triangles t = triangles_of(&s);
    NEED_OK(rw_scene_create(nullptr, &scene));
    NEED_OK(rw_scene_add_triangles(scene, &t, nullptr));
    NEED_OK(rw_scene_set_structure(scene, structure));
    return scene;
}

rw_commit_options with_progress(Log& log) {
    rw_commit_options options{};
    options.struct_size = sizeof options;
    options.progress = progress;
    options.progress_user = &log;
    return options;
}

void check_answers(const rw_scene* scene, const rw_scene* expected) {
    for (int i = 0; i < 50; ++i) {
        const rw_ray ray = random_ray();
        rw_hit hit, wanted;
        CHECK_OK(rw_scene_intersect(scene, &ray, nullptr, &hit));
        CHECK_OK(rw_scene_intersect(expected, &ray, nullptr, &wanted));
        CHECK(memcmp(&hit, &wanted, sizeof hit) == 0);
    }
}

// Stopped at any moment the scene is as it was; then it is committed all the same.
void cancelling(const soup& s, const rw_scene* expected) {
    uint32_t structures = 0;
    NEED_OK(rw_structure_count(&structures));
    for (uint32_t i = 0; i < structures; ++i) {
        const char* name = nullptr;
        NEED_OK(rw_structure_name(i, &name));
        Log all;
        rw_commit_options options = with_progress(all);
        rw_scene* scene = filled(s, name);
        CHECK_OK(rw_scene_commit(scene, &options));
        CHECK(all.good);
        CHECK(all.calls > 0);
        rw_scene_release(scene);

        scene = filled(s, name);
        for (const int stop_at : {1, all.calls / 2}) {
            if (stop_at < 1) continue;
            Log log;
            log.stop_at = stop_at;
            options = with_progress(log);
            const int32_t status = rw_scene_commit(scene, &options);
            if (!check_that(status == RW_ERROR_CANCELLED, name, __FILE__, __LINE__)) break;
            CHECK(strstr(rw_last_error_message(), "progress") != nullptr);
            const rw_ray ray = random_ray();
            rw_hit hit;
            CHECK_ERROR(rw_scene_intersect(scene, &ray, nullptr, &hit), RW_ERROR_NOT_COMMITTED, "commit");
        }
        rw_scene_statistics statistics;
        statistics.struct_size = sizeof statistics;
        const int32_t committed = rw_scene_get_statistics(scene, &statistics);
        if (committed == RW_ERROR_NOT_COMMITTED) CHECK_OK(rw_scene_commit(scene, nullptr));
        check_answers(scene, expected);
        rw_scene_release(scene);
    }
}

void throwing(const soup& s, const rw_scene* expected) {
    Log log;
    log.throws = true;
    rw_commit_options options = with_progress(log);
    rw_scene* scene = filled(s, "bvh");
    CHECK_ERROR(rw_scene_commit(scene, &options), RW_ERROR_INTERNAL, "thrown by the host");
    options = rw_commit_options{};
    options.struct_size = sizeof options;
    options.parallel_for = throws;
    CHECK_ERROR(rw_scene_commit(scene, &options), RW_ERROR_INTERNAL, "");
    CHECK_OK(rw_scene_commit(scene, nullptr));
    check_answers(scene, expected);
    rw_scene_release(scene);
}

void parallel_builds(const soup& s, const rw_scene* expected) {
    for (const char* name :
         {"linear_scan", "uniform_grid", "kd_tree", "bvh", "projected_bvh", "bvh_quality", "bvh_morton"}) {
        for (const rw_parallel_for loop : {in_order, backwards, in_threads}) {
            rw_commit_options options{};
            options.struct_size = sizeof options;
            options.parallel_for = loop;
            rw_scene* scene = filled(s, name);
            CHECK_OK(rw_scene_commit(scene, &options));
            check_answers(scene, expected);
            rw_scene_release(scene);
        }
        for (const rw_parallel_for loop : {leaves_one_out, does_nothing, repeats_one, goes_beyond}) {
            rw_commit_options options{};
            options.struct_size = sizeof options;
            options.parallel_for = loop;
            rw_scene* scene = filled(s, name);
            // A structure need not have anything to share out.
            const int32_t status = rw_scene_commit(scene, &options);
            if (status != RW_OK) {
                CHECK_ERROR(status, RW_ERROR_HOST_PARALLEL, "parallel_for");
                CHECK_OK(rw_scene_commit(scene, nullptr));
            }
            check_answers(scene, expected);
            rw_scene_release(scene);
        }
    }
}

void parallel_batches(const rw_scene* scene) {
    const uint64_t count = 2000;
    std::vector<double> origins, directions;
    for (uint64_t i = 0; i < count; ++i) {
        const rw_ray ray = random_ray();
        origins.insert(origins.end(), ray.origin, ray.origin + 3);
        directions.insert(directions.end(), ray.direction, ray.direction + 3);
    }
    std::vector<double> t(count), wanted(count);
    rw_rays rays{};
    rays.struct_size = sizeof rays;
    rays.count = count;
    rays.origin.data = origins.data();
    rays.direction.data = directions.data();
    rays.origin.type = rays.direction.type = RW_FLOAT64;
    rw_hits hits{};
    hits.struct_size = sizeof hits;
    hits.t.type = RW_FLOAT64;
    hits.t.data = wanted.data();
    CHECK_OK(rw_scene_intersect_batch(scene, &rays, &hits, nullptr));
    hits.t.data = t.data();
    rw_query_options options{};
    options.struct_size = sizeof options;
    std::atomic<int> loops{0};
    options.parallel_user = &loops;
    for (const rw_parallel_for loop : {in_order, backwards, in_threads}) {
        options.parallel_for = loop;
        t.assign(count, -1.0);
        CHECK_OK(rw_scene_intersect_batch(scene, &rays, &hits, &options));
        CHECK(t == wanted);
    }
    CHECK(loops > 0);
    std::vector<uint64_t> offsets(count + 1);
    uint64_t needed = 0;
    std::vector<uint8_t> flags(count);
    rw_output occluded{};
    occluded.data = flags.data();
    for (const rw_parallel_for loop : {leaves_one_out, does_nothing, repeats_one, goes_beyond}) {
        options.parallel_for = loop;
        CHECK_ERROR(rw_scene_intersect_batch(scene, &rays, &hits, &options), RW_ERROR_HOST_PARALLEL, "parallel_for");
        CHECK_ERROR(rw_scene_occluded_batch(scene, &rays, &occluded, &options), RW_ERROR_HOST_PARALLEL, "parallel_for");
        CHECK_ERROR(rw_scene_intersect_all_batch(scene, &rays, offsets.data(), nullptr, 0, &needed, &options),
                    RW_ERROR_HOST_PARALLEL, "parallel_for");
    }
    options.parallel_for = throws;
    CHECK_ERROR(rw_scene_intersect_batch(scene, &rays, &hits, &options), RW_ERROR_INTERNAL, "");
}

} // namespace

int main() {
    use_all_helpers();
    soup s = make_soup(2000);
    rw_scene* expected = make_scene(&s, "linear_scan");
    cancelling(s, expected);
    throwing(s, expected);
    parallel_builds(s, expected);
    parallel_batches(expected);
    rw_scene_release(expected);
    free_soup(&s);
    return finish("callbacks");
}
