// Who takes part.
#pragma once

#include "bench/library.h"
#include "bench/subjects/embree_library.h"
#include "bench/subjects/subject.h"

#include <memory>
#include <string>
#include <vector>

namespace raywise::bench {

struct SubjectFiles {
    std::string ours;
    std::string ours_avx2; // the same without wider vectors than AVX2; empty: none
    std::string embree3;
    std::string embree4; // empty: none
};

// The libraries and the subjects that use them.
struct TakingPart {
    std::unique_ptr<Library> ours;
    std::unique_ptr<Library> ours_avx2;
    std::vector<std::unique_ptr<EmbreeLibrary>> embrees;
    Subjects subjects;  // ours first
    Subjects yardstick; // of single rays: what is within reach, neither ours nor a peer
    Subjects avx2;      // of single rays: under the same names, all told to use AVX2; ours first, or empty
    std::vector<std::string> left_out; // who could not be had, and why
    std::vector<std::string> versions;
};

// wanted: beginnings of names; empty: all. quick: leaves out settings that others of the same library always beat.
TakingPart who_takes_part(const SubjectFiles& files, const std::vector<std::string>& wanted, bool quick);

} // namespace raywise::bench
