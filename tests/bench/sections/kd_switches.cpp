#include "bench/sections/switches.h"

#include "accel/kdtree/kd_tree.h"

namespace raywise::bench {
namespace {

SwitchRow row(const char* name, const KdTreeOptions& options) {
    return {"kd_tree", name, [options](const BuildInput& input) { return std::make_unique<KdTree>(input, options); }};
}

template <class T>
SwitchRow row(const char* name, T KdTreeOptions::*option, T value) {
    KdTreeOptions options;
    options.*option = value;
    return row(name, options);
}

} // namespace

std::vector<SwitchRow> kd_switches() {
    KdTreeOptions lecture; // costs of 80 and 1 for a triangle and a step
    lecture.test_cost = 80.0;
    lecture.step_cost = 1.0;
    lecture.tested_at_once = 1;
    KdTreeOptions lecture_in_lanes = lecture;
    lecture_in_lanes.tested_at_once = 8;
    return {row("as it is", {}),
            row("median split", &KdTreeOptions::split, KdSplit::median),
            row("middle split", &KdTreeOptions::split, KdSplit::middle),
            row("costs 80:1, one by one", lecture),
            row("costs 80:1, in lanes", lecture_in_lanes),
            row("tests one by one", &KdTreeOptions::tested_at_once, 1u),
            row("no empty bonus", &KdTreeOptions::empty_bonus, 0.0),
            row("empty bonus 0.5", &KdTreeOptions::empty_bonus, 0.5),
            row("1 bad refine", &KdTreeOptions::most_bad_splits, 1),
            row("3 bad refines", &KdTreeOptions::most_bad_splits, 3),
            row("boxes not clipped", &KdTreeOptions::clips, false),
            row("bins to the leaves", &KdTreeOptions::most_exact, 0u),
            row("exact below 16", &KdTreeOptions::most_exact, 16u),
            row("exact below 4096", &KdTreeOptions::most_exact, 4096u)};
}

} // namespace raywise::bench
