#include "base/parallel.h"

#include "base/error.h"
#include "base/scheduler.h"
#include "base/thread_sanitizer.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <sched.h>
#include <unistd.h>

namespace raywise {
namespace {

// Keeps the first exception of many tasks, because none may travel through the host's frames.
class FirstException {
public:
    template <class Body>
    void run(Body&& body) noexcept {
        try {
            body();
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!first_) first_ = std::current_exception();
        }
    }
    void rethrow() const {
        if (first_) std::rethrow_exception(first_);
    }

private:
    std::mutex mutex_;
    std::exception_ptr first_;
};

// A loop that any number of threads may join: each takes the next index that nobody has taken.
class SharedLoop {
public:
    SharedLoop(std::uint64_t count, const Parallel::Task& task) : count_(count), task_(task) {}

    void run(unsigned threads) {
        hand_over(this);
        run_on_threads(threads, std::min<std::uint64_t>(threads, count_), join, this);
        take_over(this);
        work(); // whatever is left when there were no threads
        exception_.rethrow();
    }

private:
    static void join(void* loop) noexcept {
        take_over(loop);
        static_cast<SharedLoop*>(loop)->work();
        hand_over(loop);
    }
    void work() noexcept {
        for (std::uint64_t i = next_.fetch_add(1); i < count_; i = next_.fetch_add(1))
            exception_.run([&] { task_(i); });
    }

    std::uint64_t count_;
    const Parallel::Task& task_;
    std::atomic<std::uint64_t> next_{0};
    FirstException exception_;
};

} // namespace

Parallel::Parallel(unsigned threads, Host host)
    : threads_(threads == 0 ? usable_threads() : std::min(threads, usable_threads())), host_(std::move(host)) {}

// oneTBB would tell the same, but its first answer takes memory, and when that is refused no later question returns.
unsigned Parallel::usable_threads() {
    static std::atomic<unsigned> known{0}; // no guard, which a fork could leave locked
    unsigned count = known.load(std::memory_order_relaxed);
    if (count == 0) {
        cpu_set_t cpus;
        const bool is_told =
            sched_getaffinity(getpid(), sizeof cpus, &cpus) == 0; // else more than the set has room for
        count = std::max(1u, is_told ? static_cast<unsigned>(CPU_COUNT(&cpus)) : std::thread::hardware_concurrency());
        known.store(count, std::memory_order_relaxed);
    }
    return count;
}

void Parallel::for_each(std::uint64_t count, const Task& task) const {
    if (count == 0) return;
    FirstException exception;
    if (host_) {
        std::vector<std::atomic<std::uint32_t>> calls(count);
        std::atomic<bool> out_of_range{false};
        host_(count, [&](std::uint64_t index) {
            if (index >= count) {
                out_of_range = true;
            } else if (calls[index].fetch_add(1) == 0) {
                exception.run([&] { task(index); });
            }
        });
        exception.rethrow();
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint32_t times = calls[i].load();
            if (times != 1 || out_of_range) {
                throw Error(Status::ERROR_HOST_PARALLEL,
                            out_of_range ? "parallel_for: an index of " + std::to_string(count) + " or more was called"
                                         : "parallel_for: task " + std::to_string(i) + " of " + std::to_string(count) +
                                               " was called " + std::to_string(times) + " times");
            }
        }
        return;
    }
    if (threads_ == 1 || count == 1) {
        for (std::uint64_t i = 0; i < count; ++i) task(i);
        return;
    }
    SharedLoop(count, task).run(threads_);
}

Parallel::Blocks Parallel::blocks_of(std::uint64_t count, std::uint64_t grain) const {
    if (count == 0) return {0, 0};
    grain = std::max<std::uint64_t>(grain, 1);
    // Several blocks per thread balance uneven work; never smaller than the grain.
    const std::uint64_t wanted = std::max<std::uint64_t>(1, std::uint64_t{threads_} * 8);
    const std::uint64_t size = std::max(grain, (count + wanted - 1) / wanted);
    // What is left over is a block of its own only where it is as long as the grain.
    return {std::max<std::uint64_t>(1, count / size + (count % size >= grain ? 1 : 0)), size};
}

} // namespace raywise
