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
    std::string embree3;
    std::string embree4; // empty: none
};

// The libraries and the subjects that use them.
struct TakingPart {
    std::unique_ptr<Library> ours;
    std::vector<std::unique_ptr<EmbreeLibrary>> embrees;
    Subjects subjects;                 // ours first
    std::vector<std::string> left_out; // who could not be had, and why
    std::vector<std::string> versions;
};

// wanted: beginnings of names; empty: all. quick: leaves out settings that others of the same library always beat.
TakingPart who_takes_part(const std::string& library, const SubjectFiles& files, const std::vector<std::string>& wanted,
                          bool quick);

} // namespace raywise::bench
