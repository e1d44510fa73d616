#include "contract/sweep_schedule.h"

#include "progress_bar.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <thread>

namespace raywise::sweep {

TimeShares::Turn TimeShares::take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto next = std::min_element(shares_.begin(), shares_.end(), [](const Share& a, const Share& b) {
        return a.seconds != b.seconds ? a.seconds < b.seconds : a.blocks < b.blocks;
    });
    next->seconds += next->latest;
    return {static_cast<std::size_t>(next - shares_.begin()), next->blocks++, next->latest};
}

void TimeShares::give_back(const Turn& turn, double seconds) {
    const std::lock_guard<std::mutex> lock(mutex_);
    Share& share = shares_[turn.part];
    share.seconds += seconds - turn.reckoned;
    share.latest = seconds;
}

void run_phase(const Phase& phase, unsigned threads, const std::atomic<bool>& stop, bool quiet) {
    if (phase.parts == 0) return;
    TimeShares shares(phase.parts);
    std::mutex mutex;
    std::condition_variable ended;
    unsigned running = threads;
    std::exception_ptr failure;
    std::atomic<bool> failed{false};

    const auto work = [&] {
        try {
            while (!stop && !failed && phase.done() < 1.0) {
                const TimeShares::Turn turn = shares.take();
                shares.give_back(turn, phase.run(turn));
            }
        } catch (...) {
            const std::lock_guard<std::mutex> lock(mutex);
            if (!failure) failure = std::current_exception();
            failed = true;
        }
        const std::lock_guard<std::mutex> lock(mutex);
        --running;
        ended.notify_all();
    };
    std::vector<std::thread> workers;
    for (unsigned i = 0; i < threads; ++i) workers.emplace_back(work);

    calibration::ProgressBar bar(quiet);
    {
        std::unique_lock<std::mutex> lock(mutex);
        while (running > 0) {
            ended.wait_for(lock, std::chrono::milliseconds(200));
            bar.show(phase.done(), phase.name);
        }
    }
    bar.finish();
    for (std::thread& worker : workers) worker.join();
    if (failure) std::rethrow_exception(failure);
}

} // namespace raywise::sweep
