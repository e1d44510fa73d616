#include "progress_bar.h"

#include "measure/timing.h"

#include <algorithm>
#include <cstdio>

#include <unistd.h>

namespace raywise::calibration {
namespace {

constexpr double second = 1e9;

// What takes less than this needs no progress.
constexpr double patience_ns = 1.0 * second;
constexpr double between_drawings_ns = 0.1 * second;
constexpr double between_lines_ns = 10.0 * second;

} // namespace

ProgressBar::ProgressBar(bool silent) : silent_(silent), terminal_(::isatty(STDERR_FILENO) != 0), start_ns_(now_ns()) {}

ProgressBar::~ProgressBar() { finish(); }

void ProgressBar::show(double fraction, const std::string& stage) {
    const double now = now_ns();
    if (silent_ || now - start_ns_ < patience_ns) return;
    if (now - latest_ns_ < (terminal_ ? between_drawings_ns : between_lines_ns)) return;
    latest_ns_ = now;
    const int percent = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * 100.0);
    const double elapsed = (now - start_ns_) / second;
    if (!terminal_) {
        std::fprintf(stderr, "%3d %%  %4.0f s  %s\n", percent, elapsed, stage.c_str());
        return;
    }
    constexpr int width = 30;
    char bar[width + 1];
    for (int i = 0; i < width; ++i) bar[i] = i * 100 < percent * width ? '#' : '.';
    bar[width] = '\0';
    std::fprintf(stderr, "\r[%s] %3d %%  %4.0f s  %-36.36s", bar, percent, elapsed, stage.c_str());
    std::fflush(stderr);
    drawn_ = true;
}

void ProgressBar::finish() {
    if (!drawn_) return;
    std::fprintf(stderr, "\r%*s\r", 92, "");
    std::fflush(stderr);
    drawn_ = false;
}

} // namespace raywise::calibration
