#include "bench/subjects/subject_list.h"

#include "bench/session.h"
#include "bench/subjects/cgal_subject.h"
#include "bench/subjects/embree_subject.h"
#include "bench/subjects/raywise_subject.h"

#include <algorithm>
#include <exception>

namespace raywise::bench {
namespace {

// The first is what hits are compared with.
struct EmbreeRow {
    EmbreeSettings settings;
    bool quick;
    bool embree4; // with Embree 4 as well
};

constexpr EmbreeRow embree_rows[] = {
    {{"MEDIUM", RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_NONE, true}, true, true},
    {{"LOW", RTC_BUILD_QUALITY_LOW, RTC_SCENE_FLAG_NONE, true}, true, true},
    {{"HIGH", RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_NONE, true}, true, true},
    {{"MEDIUM robust", RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_ROBUST, false}, true, true},
    {{"LOW robust", RTC_BUILD_QUALITY_LOW, RTC_SCENE_FLAG_ROBUST, false}, false, false},
    {{"HIGH robust", RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_ROBUST, false}, false, false},
    {{"MEDIUM compact", RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_COMPACT, false}, false, false},
    {{"LOW compact", RTC_BUILD_QUALITY_LOW, RTC_SCENE_FLAG_COMPACT, false}, false, false},
    {{"HIGH compact", RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_COMPACT, false}, false, false},
};

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
    }
}

} // namespace

TakingPart who_takes_part(const std::string& library, const SubjectFiles& files, const std::vector<std::string>& wanted,
                          bool quick) {
    TakingPart all;
    all.ours = std::make_unique<Library>("raywise", library);
    all.subjects.push_back(raywise_subject(ours_forced, *all.ours, "bvh"));
    if (has_structure(*all.ours, "bvh_quality"))
        all.subjects.push_back(raywise_subject(ours_quality, *all.ours, "bvh_quality"));
    all.subjects.push_back(raywise_subject(ours_chosen, *all.ours, nullptr));
    add_embree(all, files.embree3, "Embree 3", quick);
    if (files.embree4.empty())
        all.left_out.push_back("Embree 4: no library was given");
    else
        add_embree(all, files.embree4, "Embree 4", quick);
    all.subjects.push_back(cgal_subject());
    all.versions.push_back("CGAL " + cgal_version());
    // The first is the tracer of the rays that start on surfaces, and stays.
    all.subjects.erase(
        std::remove_if(all.subjects.begin() + 1, all.subjects.end(),
                       [&](const auto& subject) { return !begins_with_one_of(subject->name(), wanted); }),
        all.subjects.end());
    return all;
}

} // namespace raywise::bench
