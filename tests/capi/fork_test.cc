// Children of processes that work in threads: every call returns in them, with the right answer.
#include "calls.h"

#include "process.h"

#include <atomic>
#include <memory>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

namespace {

constexpr unsigned seconds_to_return = 120; // far beyond what a child takes: a call has hung

// Runs in a child; false in it makes a check fail here.
template <class Body>
bool holds_in_child(const Body& body) {
    fflush(nullptr);
    int end = 0;
    const pid_t child = fork();
    if (child == 0) {
        alarm(seconds_to_return);
        _exit(body() ? 0 : 1);
    }
    return child > 0 && waitpid(child, &end, 0) == child && WIFEXITED(end) && WEXITSTATUS(end) == 0;
}

bool make_all(const CallFiles& files, Caller& caller) {
    bool right = true;
    for (const Call& call : all_calls(files)) {
        for (const uint32_t threads : {0u, 2u, 1u}) {
            if (call.make(caller, threads)) continue;
            fprintf(stderr, "    %s, threads: %u\n", call.name.c_str(), threads);
            right = false;
        }
    }
    return right;
}

bool has_several_processors() { return std::thread::hardware_concurrency() > 1; }

} // namespace

int main() {
    const CallFiles files;
    Caller caller(files, 1100, 4096);

    // The library has no threads yet: a child may start its own.
    CHECK(process_threads() == 1);
    CHECK(holds_in_child(
        [&] { return make_all(files, caller) && (!has_several_processors() || process_threads() > 1); }));
    CHECK(process_threads() == 1);

    // It has: a child works in the thread that asks, and so does a child of it.
    CHECK(make_all(files, caller));
    CHECK(!has_several_processors() || process_threads() > 1);
    CHECK(holds_in_child([&] {
        return make_all(files, caller) && process_threads() == 1 &&
               holds_in_child([&] { return make_all(files, caller) && process_threads() == 1; });
    }));
    // Or in several of its own.
    std::vector<std::unique_ptr<Caller>> callers;
    for (int i = 0; i < 4; ++i) callers.push_back(std::make_unique<Caller>(files, 1100, 600));
    CHECK(holds_in_child([&] {
        std::atomic<int> wrong{0};
        std::vector<std::thread> threads;
        for (const auto& own : callers) {
            threads.emplace_back([&] {
                if (!own->batch_closest(0) || !own->commit("bvh", RW_EFFORT_ESTIMATE, 0)) ++wrong;
            });
        }
        for (std::thread& thread : threads) thread.join();
        return wrong == 0;
    }));

    // At any moment of other threads' loops.
    std::atomic<bool> is_over{false};
    std::atomic<int> wrong{0};
    std::vector<std::thread> threads;
    for (const auto& own : callers) {
        threads.emplace_back([&] {
            while (!is_over) {
                if (!own->batch_closest(0) || !own->batch_any(2)) ++wrong;
            }
        });
    }
    for (int i = 0; i < 100 && failures == 0; ++i) {
        CHECK(holds_in_child([&] { return caller.batch_closest(0) && caller.commit("bvh", RW_EFFORT_ESTIMATE, 0); }));
    }
    is_over = true;
    for (std::thread& thread : threads) thread.join();

    // Or of a file being read.
    is_over = false;
    std::thread reader([&] {
        while (!is_over) {
            if (!callers[0]->load_mesh(files.meshes()[0])) ++wrong;
        }
    });
    for (int i = 0; i < 100 && failures == 0; ++i)
        CHECK(holds_in_child([&] { return caller.load_mesh(files.meshes()[0]); }));
    is_over = true;
    reader.join();
    CHECK(wrong == 0);

    CHECK(make_all(files, caller));
    return finish("fork");
}
