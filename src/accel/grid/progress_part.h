#pragma once

#include "base/progress.h"

namespace raywise {

// A part of a build, whose own progress from 0 to 1 is one from `begin` to `end` of the whole.
class ProgressPart {
public:
    ProgressPart(Progress& progress, double begin, double end) : progress_(progress), begin_(begin), end_(end) {}
    void report(double fraction, const char* stage) const {
        progress_.report(begin_ + (end_ - begin_) * fraction, stage);
    }

private:
    Progress& progress_;
    double begin_;
    double end_;
};

} // namespace raywise
