#include "bench/subjects/subject_list.h"

#include "bench/session.h"
#include "bench/subjects/cgal_subject.h"
#include "bench/subjects/embree_subject.h"
#include "bench/subjects/raywise_subject.h"
#include "bench/subjects/yardstick_subject.h"

#include "model/machine.h"

#include <algorithm>
#include <exception>

namespace raywise::bench {
namespace {

// The first is what hits are compared with.
struct EmbreeRow {
    EmbreeSettings settings;
    bool quick;
    bool embree4; // with Embree 4 as well
    bool avx2;    // again with AVX2
};

constexpr EmbreeRow embree_rows[] = {
    {{"MEDIUM", RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_NONE, true}, true, true, true},
    {{"LOW", RTC_BUILD_QUALITY_LOW, RTC_SCENE_FLAG_NONE, true}, true, true, false},
    {{"HIGH", RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_NONE, true}, true, true, true},
    {{"MEDIUM robust", RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_ROBUST, false}, true, true, true},
    {{"LOW robust", RTC_BUILD_QUALITY_LOW, RTC_SCENE_FLAG_ROBUST, false}, false, false, false},
    {{"HIGH robust", RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_ROBUST, false}, false, false, false},
    {{"MEDIUM compact", RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_COMPACT, false}, false, false, false},
    {{"LOW compact", RTC_BUILD_QUALITY_LOW, RTC_SCENE_FLAG_COMPACT, false}, false, false, false},
    {{"HIGH compact", RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_COMPACT, false}, false, false, false},
};

// Beside bvh, where the library has them.
struct OursRow {
    const char* name;
    const char* structure;
};

const OursRow ours_rows[] = {{ours_quality, "bvh_quality"}, {ours_morton, "bvh_morton"}};

bool begins_with_one_of(const std::string& name, const std::vector<std::string>& beginnings) {
    return beginnings.empty() || std::any_of(beginnings.begin(), beginnings.end(), [&](const std::string& beginning) {
               return name.compare(0, beginning.size(), beginning) == 0;
           });
}

void add_embree(TakingPart& all, const std::string& path, const std::string& name, bool quick) {
    try {
        all.embrees.push_back(std::make_unique<EmbreeLibrary>(path));
    } catch (const std::exception& error) {
        all.left_out.push_back(name + ": " + error.what());
        return;
    }
    const EmbreeLibrary& library = *all.embrees.back();
    all.versions.push_back("Embree " + library.version());
    for (const EmbreeRow& row : embree_rows) {
        if ((quick && !row.quick) || (library.major() == 4 && !row.embree4)) continue;
        all.subjects.push_back(embree_subject(library, row.settings));
        if (!row.avx2 || all.avx2.empty()) continue;
        EmbreeSettings settings = row.settings;
        settings.device = "isa=avx2";
        all.avx2.push_back(embree_subject(library, settings));
    }
}

// The library that is measured is compiled with the same Highway and for the same targets as this program's own copy, so that
// dispatch comes to the same.
void add_ours(TakingPart& all, const SubjectFiles& files) {
    all.ours = std::make_unique<Library>("raywise", files.ours);
    const std::string& instruction_set = this_machine().instruction_set;
    all.subjects.push_back(raywise_subject({ours_forced, "bvh", instruction_set}, *all.ours));
    for (const OursRow& row : ours_rows) {
        if (has_structure(*all.ours, row.structure))
            all.subjects.push_back(raywise_subject({row.name, row.structure, instruction_set}, *all.ours));
    }
    all.subjects.push_back(raywise_subject({ours_chosen, nullptr, instruction_set}, *all.ours));
    all.yardstick.push_back(yardstick_subject());

    if (files.ours_avx2.empty() || instruction_set.compare(0, 3, "AVX") != 0) {
        all.left_out.push_back(std::string("AVX2 on both sides: ") +
                               (files.ours_avx2.empty() ? "no library was given" : "this processor has none"));
        return;
    }
    all.ours_avx2 = std::make_unique<Library>("raywise", files.ours_avx2);
    all.avx2.push_back(raywise_subject({ours_forced, "bvh", "AVX2"}, *all.ours_avx2));
    if (std::unique_ptr<Subject> yardstick = yardstick_avx2_subject()) all.avx2.push_back(std::move(yardstick));
}

// The first is the tracer of the rays that start on surfaces, and stays.
void keep_first_and_wanted(Subjects& subjects, const std::vector<std::string>& wanted) {
    if (subjects.empty()) return;
    subjects.erase(std::remove_if(subjects.begin() + 1, subjects.end(),
                                  [&](const auto& subject) { return !begins_with_one_of(subject->name(), wanted); }),
                   subjects.end());
}

} // namespace

TakingPart who_takes_part(const SubjectFiles& files, const std::vector<std::string>& wanted, bool quick) {
    TakingPart all;
    add_ours(all, files);
    add_embree(all, files.embree3, "Embree 3", quick);
    if (files.embree4.empty())
        all.left_out.push_back("Embree 4: no library was given");
    else
        add_embree(all, files.embree4, "Embree 4", quick);
    all.subjects.push_back(cgal_subject());
    all.versions.push_back("CGAL " + cgal_version());
    keep_first_and_wanted(all.subjects, wanted);
    keep_first_and_wanted(all.avx2, wanted);
    return all;
}

} // namespace raywise::bench
