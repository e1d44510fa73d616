#include "measure/noise.h"

#include "measure/timing.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <sstream>

#include <sys/resource.h>
#include <unistd.h>

namespace raywise::calibration {
namespace {

// Limits without unit, chosen so that a desktop doing nothing stays below half of each and one that compiles does not.
constexpr double most_spread = 0.10; // differences of a tenth decide nothing in a choice whose misfit is several tenths
constexpr double most_drift = 0.20;  // a processor may lower its turbo clock by an eighth when it gets warm
constexpr double most_others = 0.60; // with two processors: one may be busy with something else, not both
constexpr double most_stolen = 0.05;

double own_seconds() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string percent(const char* pattern, double value, double limit) {
    char text[160];
    std::snprintf(text, sizeof(text), pattern, value * 100.0, limit * 100.0);
    return text;
}

} // namespace

std::optional<ProcessorTime> parse_processor_time(const std::string& text) {
    std::istringstream stream(text);
    std::string name;
    double user = 0.0, nice = 0.0, system = 0.0, idle = 0.0, iowait = 0.0, irq = 0.0, softirq = 0.0, steal = 0.0;
    if (!(stream >> name >> user >> nice >> system >> idle >> iowait >> irq >> softirq >> steal) || name != "cpu") {
        return std::nullopt;
    }
    const double tick = 1.0 / static_cast<double>(std::max(::sysconf(_SC_CLK_TCK), 1L));
    ProcessorTime time;
    time.busy = (user + nice + system + irq + softirq) * tick;
    time.stolen = steal * tick;
    time.total = time.busy + time.stolen + (idle + iowait) * tick;
    return time;
}

std::optional<ProcessorTime> processor_time() {
    std::ifstream file("/proc/stat");
    std::string line;
    std::getline(file, line);
    return parse_processor_time(line);
}

double reference_ns() {
    double best = 0.0;
    for (int attempt = 0; attempt < 5; ++attempt) {
        const double start = now_ns();
        // Each step needs the one before: its time is that of the processor's clock alone.
        volatile std::uint64_t result = 1;
        std::uint64_t x = result;
        for (int i = 0; i < 300'000; ++i) x = x * 6364136223846793005u + 1442695040888963407u; // about a millisecond
        result = x;
        const double time = now_ns() - start;
        if (attempt == 0 || time < best) best = time;
    }
    return best;
}

std::vector<std::string> complaints(const Noise& noise) {
    std::vector<std::string> result;
    if (noise.spread > most_spread) {
        result.push_back(percent("repeated timings differ by %.0f %% (at most %.0f %%)", noise.spread, most_spread));
    }
    if (noise.drift > most_drift) {
        result.push_back(
            percent("the processor's speed changed by %.0f %% (at most %.0f %%)", noise.drift, most_drift));
    }
    if (noise.others > most_others) {
        result.push_back(
            percent("other programs used %.0f %% of the machine (at most %.0f %%)", noise.others, most_others));
    }
    if (noise.stolen > most_stolen) {
        result.push_back(
            percent("the host took away %.0f %% of the machine (at most %.0f %%)", noise.stolen, most_stolen));
    }
    return result;
}

NoiseWatch::NoiseWatch() : start_(processor_time()), own_start_(own_seconds()) { look(); }

void NoiseWatch::look() { references_.push_back(reference_ns()); }

Noise NoiseWatch::judge(const std::vector<double>& spreads) {
    look();
    Noise noise;
    noise.spread = median(spreads);
    const auto [fastest, slowest] = std::minmax_element(references_.begin(), references_.end());
    noise.drift = *slowest / *fastest - 1.0;
    const std::optional<ProcessorTime> end = processor_time();
    if (start_ && end && end->total > start_->total) {
        const double total = end->total - start_->total;
        const double own = own_seconds() - own_start_;
        noise.others = std::clamp((end->busy - start_->busy - own) / total, 0.0, 1.0);
        noise.stolen = std::clamp((end->stolen - start_->stolen) / total, 0.0, 1.0);
    }
    return noise;
}

} // namespace raywise::calibration
