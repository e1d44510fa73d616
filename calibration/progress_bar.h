// Progress on standard error: a bar on a terminal, now and then a line anywhere else.
#pragma once

#include <string>

namespace raywise::calibration {

class ProgressBar {
public:
    // silent: draws nothing.
    explicit ProgressBar(bool silent);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    // fraction: 0 to 1; what is done, not of time.
    void show(double fraction, const std::string& stage);
    // Wipes the bar away.
    void finish();

private:
    bool silent_;
    bool terminal_;
    bool drawn_ = false;
    double start_ns_;
    double latest_ns_ = 0.0;
};

} // namespace raywise::calibration
