// Whether the machine was quiet enough for its timings to mean something.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace raywise::calibration {

// Processor time since the system started, in seconds over all processors; from /proc/stat.
struct ProcessorTime {
    double busy = 0.0;   // spent on something
    double stolen = 0.0; // taken by the host of a virtual machine
    double total = 0.0;  // idle time included
};
std::optional<ProcessorTime> processor_time();
// From the text of /proc/stat.
std::optional<ProcessorTime> parse_processor_time(const std::string& text);

// The time of a fixed piece of arithmetic: it changes when the processor's clock does. The smallest of a few tries,
// because interruptions are not what is looked for here.
double reference_ns();

struct Noise {
    double spread = 0.0; // median over all timings of their spread
    double drift = 0.0;  // slowest over fastest reference time, minus 1
    double others = 0.0; // part of the machine that other programs kept busy, 0 ... 1
    double stolen = 0.0; // part of the machine that the host took away, 0 ... 1
};

// What is too much, in words; empty when the machine was quiet.
std::vector<std::string> complaints(const Noise& noise);

// Watches over a measurement: looks at the start, whenever told to, and at the end.
class NoiseWatch {
public:
    NoiseWatch();
    void look();
    // spreads: of all timings.
    Noise judge(const std::vector<double>& spreads);

private:
    std::optional<ProcessorTime> start_;
    double own_start_;
    std::vector<double> references_;
};

} // namespace raywise::calibration
