// Nothing grows: after very many calls of each kind as much memory is in use, and as many threads are there, as after the first.
// Bytes are counted, not seconds:
//   growth_test                some hundreds of each kind
//   growth_test CALLS [KIND]   so many of each, or of those whose name has KIND in it, with the time a call took at the beginning and
//                              at the end
#include "calls.h"

#include "process.h"
#include "refusing.h"

#include <atomic>
#include <chrono>
#include <iterator>
#include <memory>
#include <thread>

#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

constexpr uint64_t triangles = 1100; // enough for threads to be used, as 600 rays are
constexpr uint64_t rays = 600;
constexpr uint32_t limits[] = {0, 2, 1, 3}; // threads, one call after the other

// What may be in use afterwards that was not before, whatever the number of calls.
constexpr long spare_allocations = 40; // one of oneTBB's or glibc's own for each thread and more
constexpr long spare_bytes = 16 << 10;
// Pages are given back late, and threads of the host have a heap each. An arena for each loop took 7 kB of them.
constexpr long spare_resident_bytes = 3 << 20;

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true; // with memory of its own that tells nothing
#else
constexpr bool sanitized = false;
#endif

struct InUse {
    long allocations = live_allocations();
    long bytes = live_bytes();
    long resident = resident_bytes();
    long threads = process_threads();
};

using Clock = std::chrono::steady_clock;

// Calls of one kind from several threads of the host.
class Host {
public:
    Host(const CallFiles& files, unsigned threads) {
        for (unsigned i = 0; i < threads; ++i) callers_.push_back(std::make_unique<Caller>(files, triangles, rays));
    }

    // calls: in all. Prints nothing when they leave nothing behind, unless asked to tell.
    void run(const Call& call, long calls, const char* when, bool tell) {
        const auto count = static_cast<unsigned>(callers_.size());
        const long each = std::max(10L, calls / static_cast<long>(count));
        std::atomic<long> wrong{0};
        std::atomic<long> first_ns{0};
        std::atomic<long> last_ns{0};
        pthread_barrier_t barrier;
        pthread_barrier_init(&barrier, nullptr, count + 1);
        std::vector<std::thread> threads;
        for (unsigned i = 0; i < count; ++i) {
            threads.emplace_back([&, i] {
                wrong += make(call, *callers_[i], each / 10 + 8); // to warm up
                pthread_barrier_wait(&barrier);                   // all that is in use is counted
                pthread_barrier_wait(&barrier);
                first_ns += timed(call, *callers_[i], each / 10, wrong);
                wrong += make(call, *callers_[i], each - 2 * (each / 10));
                last_ns += timed(call, *callers_[i], each / 10, wrong);
                pthread_barrier_wait(&barrier);
                pthread_barrier_wait(&barrier);
            });
        }
        pthread_barrier_wait(&barrier);
        const InUse before;
        pthread_barrier_wait(&barrier);
        pthread_barrier_wait(&barrier);
        const InUse after;
        pthread_barrier_wait(&barrier);
        for (std::thread& thread : threads) thread.join();
        pthread_barrier_destroy(&barrier);

        const int failures_before = failures;
        CHECK(wrong == 0);
        CHECK(after.allocations - before.allocations <= spare_allocations);
        CHECK(after.bytes - before.bytes <= spare_bytes);
        CHECK(sanitized || after.resident - before.resident <= spare_resident_bytes);
        CHECK(after.threads - before.threads < static_cast<long>(std::thread::hardware_concurrency()));
        if (!tell && failures == failures_before) return;
        const double tenths = static_cast<double>(each / 10) * count;
        printf(
            "%-22s %s, %8ld calls: %+ld allocations, %+ld bytes, %+ld resident; us a call, first and last tenth: %.1f "
            "%.1f\n",
            call.name.c_str(), when, each * static_cast<long>(count), after.allocations - before.allocations,
            after.bytes - before.bytes, after.resident - before.resident, static_cast<double>(first_ns) / 1e3 / tenths,
            static_cast<double>(last_ns) / 1e3 / tenths);
    }

private:
    static long make(const Call& call, Caller& caller, long calls) {
        long wrong = 0;
        for (long i = 0; i < calls; ++i)
            wrong += call.make(caller, limits[static_cast<size_t>(i) % std::size(limits)]) ? 0 : 1;
        return wrong;
    }
    static long timed(const Call& call, Caller& caller, long calls, std::atomic<long>& wrong) {
        const Clock::time_point start = Clock::now();
        wrong += make(call, caller, calls);
        return static_cast<long>(std::chrono::nanoseconds(Clock::now() - start).count());
    }

    std::vector<std::unique_ptr<Caller>> callers_;
};

// What the command line asks for.
struct Form {
    long calls = 0; // of each kind; 0: the short form
    std::string kind;
};

void run_all(const CallFiles& files, unsigned host_threads, const char* when, const Form& form) {
    Host host(files, host_threads);
    for (const Call& call : all_calls(files)) {
        if (call.name.find(form.kind) == std::string::npos) continue;
        const long calls = sanitized ? call.weight / 20 : call.weight;
        host.run(call, form.calls > 0 ? form.calls : calls, when, form.calls > 0);
    }
}

// In a child, where the threads that the library had are not.
void run_all_in_child(const CallFiles& files, const Form& form) {
    fflush(nullptr);
    int end = 0;
    const pid_t child = fork();
    if (child == 0) {
        failures = 0;
        run_all(files, 1, "after fork", form);
        run_all(files, 8, "8 threads after fork", form);
        fflush(nullptr);
        _exit(failures == 0 ? 0 : 1);
    }
    CHECK(child > 0 && waitpid(child, &end, 0) == child && WIFEXITED(end) && WEXITSTATUS(end) == 0);
}

} // namespace

int main(int argc, char** argv) {
    setvbuf(stdout, nullptr, _IOLBF, 0);
    Form form;
    if (argc > 1 && (form.calls = atol(argv[1])) <= 0) return 2;
    if (argc > 2) form.kind = argv[2];
    {
        const CallFiles files;
        run_all(files, 1, "one thread", form);
        run_all(files, 8, "8 threads", form);
        // The sanitizer of threads does not let a child of several make any.
        if (!sanitized) run_all_in_child(files, form);
    }
    return finish("growth");
}
