#include "base/parallel.h"

#include "base/error.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

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

} // namespace

Parallel::Parallel(unsigned threads, Host host)
    : threads_(threads == 0 ? usable_threads() : std::min(threads, usable_threads())), host_(std::move(host)) {}

unsigned Parallel::usable_threads() { return static_cast<unsigned>(std::max(1, tbb::info::default_concurrency())); }

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
    tbb::task_arena arena(static_cast<int>(threads_));
    arena.execute(
        [&] { tbb::parallel_for(std::uint64_t{0}, count, [&](std::uint64_t i) { exception.run([&] { task(i); }); }); });
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
