#pragma once

#include "bench/subjects/subject.h"

#include <memory>

namespace raywise::bench {

// What single rays can reach on this machine: a bare hierarchy for closest and any hit (yardstick/), compiled for this very processor. It
// leaves out most of what a library must have, so it is no peer and in no ratio of ours; a figure that moves with the
// yardstick's is the machine's doing.
constexpr const char* yardstick_name = "yardstick";
std::unique_ptr<Subject> yardstick_subject();

// The same compiled for AVX2; nullptr where there is no such thing.
#ifdef __x86_64__
std::unique_ptr<Subject> yardstick_avx2_subject();
#else
inline std::unique_ptr<Subject> yardstick_avx2_subject() { return nullptr; }
#endif

} // namespace raywise::bench
