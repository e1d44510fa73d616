// How durations are measured: the one place with the statistics.
//
// - A timing is repeated until it takes a minimum time, so that the clock's grain and the cost of a call to it vanish.
// - Candidates take turns (round-robin), each repetition starting with another one: a disturbance that lasts hits all
// of them
//   and leaves their ratios, which are what a choice needs.
// - The estimate is the median. The smallest value has its friends, since disturbances only ever add; but it falls with
//   the number of repetitions, and here cheap candidates are repeated often and dear ones seldom, so it would favour
//   the cheap. The mean is at the mercy of one interruption. The median ignores up to half of the repetitions.
// - What one thread does is timed in processor time, which is wall time without the pauses in which other programs had
//   the processor; what several threads do, in wall time.
// - The spread is the distance of the quartiles over the median: as robust as the median itself.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace raywise::calibration {

// Nanoseconds of a clock that never goes back.
using Clock = double (*)();
double now_ns();       // wall time
double processor_ns(); // all threads of this process

struct Timing {
    double ns = 0.0;     // of one call; median
    double spread = 0.0; // (upper quartile - lower quartile) / median
    unsigned repetitions = 0;
};

// What some calls took together, in nanoseconds.
struct Elapsed {
    double counted; // of what is being timed
    double spent;   // of all that had to be done for it; what the limits look at
};

// Does so many calls.
using Timed = std::function<Elapsed(std::uint64_t calls)>;

// A Timed that looks at the clock around calls of `call` and counts all of it.
Timed with_clock(std::function<void()> call, Clock clock = now_ns);

struct TimingLimits {
    double least_ns;      // one repetition takes at least so long
    unsigned repetitions; // wanted for each candidate
    double most_ns;       // no further repetition of a candidate on which so much is spent; the first is always done
};

std::vector<Timing> time_in_turns(const std::vector<Timed>& candidates, const TimingLimits& limits);

// The value below which `part` (0 ... 1) of the values lie, linear between neighbours. 0 of none.
double quantile(std::vector<double> values, double part);
double median(const std::vector<double>& values);

} // namespace raywise::calibration
