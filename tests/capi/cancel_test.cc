// Batches that are watched and stopped: by a flag, by a callback, from other threads and from a signal handler.
#include "testing.h"

#include <atomic>
#include <csignal>
#include <thread>
#include <vector>

namespace {

constexpr uint64_t count = 60000;
constexpr double untouched = -7.0;

struct Question {
    std::vector<rw_ray> in;
    std::vector<double> t = std::vector<double>(count, untouched);
    std::vector<double> normal = std::vector<double>(3 * count, untouched);
    std::vector<uint8_t> flags = std::vector<uint8_t>(count, 9);
    std::vector<uint64_t> offsets = std::vector<uint64_t>(count + 1, 77);
    uint64_t needed = 77;
    uint64_t invalid = 77;
    rw_rays rays{};
    rw_hits hits{};
    rw_output occluded{};
    rw_query_options options{};

    Question() {
        for (uint64_t i = 0; i < count; ++i) in.push_back(random_ray());
        rays.struct_size = sizeof rays;
        rays.count = count;
        rays.origin.data = in[0].origin;
        rays.direction.data = in[0].direction;
        rays.origin.stride = rays.direction.stride = sizeof(rw_ray);
        rays.origin.type = rays.direction.type = RW_FLOAT64;
        hits.struct_size = sizeof hits;
        hits.t.data = t.data();
        hits.normal.data = normal.data();
        hits.t.type = hits.normal.type = RW_FLOAT64;
        occluded.data = flags.data();
        options.struct_size = sizeof options;
        options.invalid_rays = &invalid;
    }

    int32_t ask(const rw_scene* scene, int which) {
        if (which == 0) return rw_scene_intersect_batch(scene, &rays, &hits, &options);
        if (which == 1) return rw_scene_occluded_batch(scene, &rays, &occluded, &options);
        return rw_scene_intersect_all_batch(scene, &rays, offsets.data(), nullptr, 0, &needed, &options);
    }
    // How many answers are there; those that are not right count as a failure.
    uint64_t answered(const Question& right) const {
        uint64_t written = 0;
        for (uint64_t i = 0; i < count; ++i) {
            if (t[i] != untouched) {
                ++written;
                CHECK(memcmp(&t[i], &right.t[i], sizeof t[i]) == 0);
            }
            if (normal[3 * i] != untouched)
                CHECK(memcmp(&normal[3 * i], &right.normal[3 * i], 3 * sizeof normal[0]) == 0);
            if (flags[i] != 9) {
                ++written;
                CHECK(flags[i] == right.flags[i]);
            }
        }
        return written;
    }
    void check_nothing_else() const {
        CHECK(needed == 77 && invalid == 77);
        for (const uint64_t offset : offsets) CHECK(offset == 77);
    }
};

struct Watch {
    std::thread::id caller = std::this_thread::get_id();
    std::atomic<int> inside{0};
    int calls = 0;
    int stop_at = 0; // 0: never
    double last = 0.0;
    bool good = true;
    bool any_thread = false;
    std::atomic<int32_t>* sets = nullptr;
};

int32_t progress(void* user, double fraction, const char* stage) {
    Watch& watch = *static_cast<Watch*>(user);
    if (watch.inside++ != 0) watch.good = false;
    watch.good = watch.good && fraction >= watch.last && fraction <= 1.0 && stage != nullptr && stage[0] != '\0';
    watch.good = watch.good && (watch.any_thread || std::this_thread::get_id() == watch.caller);
    watch.last = fraction;
    ++watch.calls;
    if (watch.sets != nullptr) watch.sets->store(1);
    --watch.inside;
    return watch.calls == watch.stop_at ? 1 : 0;
}

void in_threads(void*, uint64_t tasks, rw_task task, void* data) {
    std::atomic<uint64_t> next{0};
    const auto work = [&] {
        for (uint64_t i = next++; i < tasks; i = next++) task(data, i);
    };
    std::vector<std::thread> threads;
    for (int i = 0; i < 3; ++i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
}

const volatile int32_t* flag_of(const std::atomic<int32_t>& flag) {
    static_assert(sizeof flag == sizeof(int32_t), "an atomic is its number");
    return reinterpret_cast<const volatile int32_t*>(&flag);
}

void watched_answers_are_the_same(const rw_scene* scene, const Question& right) {
    for (const uint32_t threads : {1u, 2u, 0u}) {
        for (const bool of_host : {false, true}) {
            Question question;
            question.in = right.in;
            question.rays = right.rays;
            Watch watch;
            std::atomic<int32_t> flag{0};
            question.options.threads = threads;
            question.options.progress = progress;
            question.options.progress_user = &watch;
            question.options.cancel = flag_of(flag);
            if (of_host) question.options.parallel_for = in_threads;
            watch.any_thread = of_host;
            for (int which = 0; which < 3; ++which) {
                watch.last = 0.0;
                watch.calls = 0;
                CHECK_OK(question.ask(scene, which));
                CHECK(watch.good && watch.calls >= 1 && watch.last == 1.0);
            }
            CHECK(question.answered(right) == 2 * count && question.invalid == 0);
            CHECK(question.normal == right.normal && question.offsets == right.offsets);
        }
    }
}

void stopped_at_once(const rw_scene* scene, const Question& right) {
    for (int which = 0; which < 3; ++which) {
        for (const bool by_callback : {false, true}) {
            Question question;
            question.rays = right.rays;
            Watch watch;
            watch.stop_at = 1;
            const int32_t flag = 1;
            if (by_callback) {
                question.options.progress = progress;
                question.options.progress_user = &watch;
            } else {
                question.options.cancel = &flag;
            }
            CHECK_ERROR(question.ask(scene, which), RW_ERROR_CANCELLED,
                        by_callback ? "options.progress|of 60000 rays" : "options.cancel|0 of 60000 rays");
            // The callback's first call is one thread's first look; another may have begun by then.
            const uint64_t answered = question.answered(right);
            CHECK(by_callback ? answered < count : answered == 0);
            question.check_nothing_else();
        }
    }
    // Without a ray there is a look as well.
    Question question;
    question.rays.count = 0;
    const int32_t flag = -1;
    question.options.cancel = &flag;
    CHECK_ERROR(question.ask(scene, 0), RW_ERROR_CANCELLED, "options.cancel");
}

// The flag is set by the callback, which itself does not ask to stop: on every thread it is the flag that does.
void stopped_on_the_way(const rw_scene* scene, const Question& right) {
    for (int which = 0; which < 3; ++which) {
        for (const bool of_host : {false, true}) {
            Question question;
            question.rays = right.rays;
            Watch watch;
            std::atomic<int32_t> flag{0};
            watch.sets = &flag;
            watch.any_thread = of_host;
            question.options.progress = progress;
            question.options.progress_user = &watch;
            question.options.cancel = flag_of(flag);
            if (of_host) question.options.parallel_for = in_threads;
            CHECK_ERROR(question.ask(scene, which), RW_ERROR_CANCELLED, "options.cancel");
            CHECK(watch.calls == 1);
            CHECK(question.answered(right) < count);
            question.check_nothing_else();
            // The same question again, to its end.
            flag = 0;
            watch.sets = nullptr;
            watch.last = 0.0;
            CHECK_OK(question.ask(scene, which));
            CHECK(question.invalid == 0);
            if (which == 2) {
                CHECK(question.offsets == right.offsets);
            } else {
                CHECK(question.answered(right) == count);
            }
        }
    }
}

void stopped_from_another_thread(const rw_scene* scene, const Question& right) {
    Question question;
    question.rays = right.rays;
    std::atomic<int32_t> flag{0};
    question.options.cancel = flag_of(flag);
    std::thread other([&] { flag.store(1); });
    // However the two meet: stopped, or done before the flag was set.
    int32_t status = RW_OK;
    while (status == RW_OK) status = question.ask(scene, 0);
    CHECK(status == RW_ERROR_CANCELLED);
    other.join();
    question.answered(right);
}

volatile std::sig_atomic_t interrupted = 0;
// What a handler's plain write is on every processor; said aloud, so that the thread sanitizer knows.
void interrupt(int) { __atomic_store_n(&interrupted, 1, __ATOMIC_RELAXED); }

int32_t raise_once(void*, double, const char*) {
    std::raise(SIGINT);
    return 0;
}

void stopped_by_a_signal(const rw_scene* scene, const Question& right) {
    static_assert(sizeof interrupted == sizeof(int32_t), "sig_atomic_t is an int");
    Question question;
    question.rays = right.rays;
    question.options.cancel = &interrupted;
    question.options.progress = raise_once;
    const auto before = std::signal(SIGINT, interrupt);
    CHECK_ERROR(question.ask(scene, 0), RW_ERROR_CANCELLED, "options.cancel");
    std::signal(SIGINT, before);
    CHECK(question.answered(right) < count);
}

void bad_flags(const rw_scene* scene) {
    Question question;
    alignas(4) char bytes[8] = {0};
    question.options.cancel = reinterpret_cast<const volatile int32_t*>(bytes + 1);
    for (int which = 0; which < 3; ++which)
        CHECK_ERROR(question.ask(scene, which), RW_ERROR_INVALID_ARGUMENT, "options.cancel|aligned");
    question.options.cancel = reinterpret_cast<const volatile int32_t*>(question.t.data() + 3);
    CHECK_ERROR(question.ask(scene, 0), RW_ERROR_SHARED_MEMORY, "options.cancel|hits.t");
    question.options.cancel = reinterpret_cast<const volatile int32_t*>(&question.invalid);
    CHECK_ERROR(question.ask(scene, 1), RW_ERROR_SHARED_MEMORY, "options.cancel|options.invalid_rays");
    CHECK(question.invalid == 77);
}

// One shot: building is watched as well.
void once(const soup& s, const Question& right) {
    const rw_triangles mesh = triangles_of(&s);
    for (const bool by_callback : {false, true}) {
        Question question;
        question.rays = right.rays;
        Watch watch;
        watch.stop_at = 1;
        watch.any_thread = true;
        const int32_t flag = 1;
        if (by_callback) {
            question.options.progress = progress;
            question.options.progress_user = &watch;
        } else {
            question.options.cancel = &flag;
        }
        rw_once_options options{};
        options.struct_size = sizeof options;
        options.query = &question.options;
        CHECK_ERROR(rw_once_intersect(&mesh, 1, &question.rays, &question.hits, &options), RW_ERROR_CANCELLED, "stop");
        CHECK_ERROR(rw_once_occluded(&mesh, 1, &question.rays, &question.occluded, &options),
                    by_callback ? RW_OK : RW_ERROR_CANCELLED, by_callback ? "" : "stop");
        CHECK(question.answered(right) == (by_callback ? count : 0));
    }
}

} // namespace

int main() {
    use_all_helpers();
    const soup s = make_soup(2000);
    uint32_t structures = 0;
    NEED_OK(rw_structure_count(&structures));
    Question right;
    rw_scene* judge = make_scene(&s, "bvh");
    right.options.invalid_rays = nullptr;
    for (int which = 0; which < 3; ++which) NEED_OK(right.ask(judge, which));
    for (const char* name :
         {"bvh", "kd_tree"}) { // one that takes many rays at a time, and one that takes them in order
        rw_scene* scene = make_scene(&s, name);
        watched_answers_are_the_same(scene, right);
        stopped_at_once(scene, right);
        stopped_on_the_way(scene, right);
        stopped_from_another_thread(scene, right);
        stopped_by_a_signal(scene, right);
        interrupted = 0;
        rw_scene_release(scene);
    }
    bad_flags(judge);
    once(s, right);
    rw_scene_release(judge);
    soup last = s;
    free_soup(&last);
    return finish("cancel");
}
