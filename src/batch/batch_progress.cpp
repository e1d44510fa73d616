#include "batch/batch_progress.h"

#include <algorithm>
#include <string>

namespace raywise {
namespace {

// Often enough for a person who waits for a batch to end, and seldom enough for callbacks in an interpreted language to cost nothing.
constexpr std::chrono::milliseconds between_reports{10};

constexpr double ns_between_polls = 2e6;

} // namespace

BatchProgress::BatchProgress(const BatchWatch& watch, std::uint64_t rays, const Parallel& parallel)
    : watch_(watch), rays_(rays), any_thread_reports_(parallel.is_host()) {}

double BatchProgress::fraction() const {
    return rays_ == 0 ? 1.0 : static_cast<double>(done_.load(std::memory_order_relaxed)) / static_cast<double>(rays_);
}

void BatchProgress::throw_if_stopped() const {
    const char* const by = stopped_by_.load(std::memory_order_relaxed);
    if (by == nullptr) return;
    throw Error(Status::ERROR_CANCELLED, std::string(by) + ": it asked to stop, after " +
                                             std::to_string(done_.load(std::memory_order_relaxed)) + " of " +
                                             std::to_string(rays_) + " rays");
}

void BatchProgress::report(const char* stage) {
    if (!watch_.progress(fraction(), stage)) return;
    stopped_by_.store("options.progress", std::memory_order_relaxed);
}

void BatchProgress::look() {
    if (watch_.is_cancelled()) stopped_by_.store("options.cancel", std::memory_order_relaxed);
    throw_if_stopped();
    if (!watch_.progress || (!any_thread_reports_ && std::this_thread::get_id() != caller_)) return;
    const std::unique_lock lock(reporting_, std::try_to_lock);
    if (!lock) return; // another thread is at it
    const Clock::time_point now = Clock::now();
    if (now < next_report_) return;
    report("tracing");
    next_report_ = Clock::now() + between_reports;
    throw_if_stopped();
}

void BatchProgress::finish() {
    if (!is_watched()) return;
    look();
    if (watch_.progress) report("ready");
    throw_if_stopped();
}

void BlockPace::took(std::uint64_t rays, double ns) {
    const double in_time = ns > 0.0 ? static_cast<double>(rays) * ns_between_polls / ns : 1e9;
    // Twice as many at most: a few rays that were quick say little of the next ones.
    next_ = static_cast<std::uint64_t>(std::clamp(in_time, 1.0, 2.0 * static_cast<double>(rays)));
}

} // namespace raywise
