#include "base/parallel.h"

#include "base/error.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <new>
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

// oneTBB comes to life with the first arena. When memory is refused in the middle of that, it does not recover, and whatever
// is asked of it next never returns. So it is tried once and left alone when it fails: loops then run on the caller's thread.
// The arena stays, or oneTBB would be gone, and come to life again, with every thread of the host that used it.
bool threads_are_there() {
    static const bool there = [] {
        try {
            static tbb::task_arena* const stays = new tbb::task_arena;
            stays->initialize();
            return true;
        } catch (const std::bad_alloc&) {
            return false;
        }
    }();
    return there;
}

} // namespace

Parallel::Parallel(unsigned threads, Host host)
    : threads_(threads == 0 ? usable_threads() : std::min(threads, usable_threads())), host_(std::move(host)) {}

// oneTBB would tell the same, but its first answer takes memory, and when that is refused no later question returns.
unsigned Parallel::usable_threads() {
    static const unsigned count = [] {
        cpu_set_t cpus;
        if (sched_getaffinity(getpid(), sizeof cpus, &cpus) == 0) return static_cast<unsigned>(CPU_COUNT(&cpus));
        return std::thread::hardware_concurrency(); // more processors than the set has room for
    }();
    return std::max(1u, count);
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
    if (threads_ == 1 || count == 1 || !threads_are_there()) {
        for (std::uint64_t i = 0; i < count; ++i) task(i);
        return;
    }
    std::atomic<std::uint64_t> next{0};
    const auto work = [&] {
        for (std::uint64_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) exception.run([&] { task(i); });
    };
    try {
        tbb::task_arena arena(static_cast<int>(threads_));
        arena.execute([&] {
            tbb::parallel_for(std::uint64_t{0}, std::min<std::uint64_t>(threads_, count),
                              [&](std::uint64_t) { work(); });
        });
    } catch (const std::exception&) {
        // oneTBB got no memory or no thread; tasks throw nothing through it. The caller's thread does what is left.
    }
    work();
    exception.rethrow();
}

void Parallel::for_blocks(std::uint64_t count, std::uint64_t grain,
                          const std::function<void(std::uint64_t, std::uint64_t)>& body) const {
    if (count == 0) return;
    grain = std::max<std::uint64_t>(grain, 1);
    // Several blocks per thread balance uneven work; never smaller than the grain.
    const std::uint64_t wanted = std::max<std::uint64_t>(1, std::uint64_t{threads_} * 8);
    const std::uint64_t block = std::max(grain, (count + wanted - 1) / wanted);
    const std::uint64_t blocks = (count + block - 1) / block;
    for_each(blocks, [&](std::uint64_t i) { body(i * block, std::min(count, (i + 1) * block)); });
}

} // namespace raywise
