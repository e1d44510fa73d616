#include "measure/timing.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <time.h>

namespace raywise::calibration {
namespace {

// Calls are at most multiplied by this while growing: one disturbed short trial must not lead to a very long one.
constexpr double largest_growth = 10.0;

struct State {
    std::uint64_t calls = 1;
    double spent_ns = 0.0;
    Elapsed latest{};
    std::vector<double> ns_per_call;

    void run(const Timed& candidate) {
        latest = candidate(calls);
        spent_ns += latest.spent;
    }
    void keep() { ns_per_call.push_back(latest.counted / static_cast<double>(calls)); }
};

// Finds how many calls take the minimum time; warms caches on the way. What takes that long already is kept as the
// first repetition: it is too dear to be thrown away, and too long to be changed by cold caches.
void grow(const Timed& candidate, State& state, const TimingLimits& limits) {
    for (;;) {
        state.run(candidate);
        if (state.latest.spent >= limits.least_ns || state.spent_ns >= limits.most_ns) break;
        const double factor =
            std::clamp(1.2 * limits.least_ns / std::max(state.latest.spent, 1.0), 1.5, largest_growth);
        state.calls = static_cast<std::uint64_t>(std::ceil(static_cast<double>(state.calls) * factor));
    }
    state.keep();
}

} // namespace

double now_ns() {
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor_ns() {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e9 + static_cast<double>(time.tv_nsec);
}

Timed with_clock(std::function<void()> call, Clock clock) {
    return [call = std::move(call), clock](std::uint64_t calls) {
        const double start = clock();
        for (std::uint64_t i = 0; i < calls; ++i) call();
        const double ns = clock() - start;
        return Elapsed{ns, ns};
    };
}

double quantile(std::vector<double> values, double part) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const double place = part * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return values[below] + (values[above] - values[below]) * (place - static_cast<double>(below));
}

double median(const std::vector<double>& values) { return quantile(values, 0.5); }

std::vector<Timing> time_in_turns(const std::vector<Timed>& candidates, const TimingLimits& limits) {
    std::vector<State> states(candidates.size());
    for (std::size_t i = 0; i < candidates.size(); ++i) grow(candidates[i], states[i], limits);
    for (unsigned repetition = 1; repetition < limits.repetitions; ++repetition) {
        for (std::size_t turn = 0; turn < candidates.size(); ++turn) {
            const std::size_t i = (turn + repetition) % candidates.size();
            State& state = states[i];
            if (state.spent_ns >= limits.most_ns) continue;
            state.run(candidates[i]);
            state.keep();
        }
    }
    std::vector<Timing> timings;
    for (const State& state : states) {
        Timing timing;
        timing.ns = median(state.ns_per_call);
        if (timing.ns > 0.0) {
            timing.spread = (quantile(state.ns_per_call, 0.75) - quantile(state.ns_per_call, 0.25)) / timing.ns;
        }
        timing.repetitions = static_cast<unsigned>(state.ns_per_call.size());
        timings.push_back(timing);
    }
    return timings;
}

} // namespace raywise::calibration
