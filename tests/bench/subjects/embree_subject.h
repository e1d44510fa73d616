#pragma once

#include "bench/subjects/embree_library.h"
#include "bench/subjects/subject.h"

namespace raywise::bench {

struct EmbreeSettings {
    const char* name; // after "Embree 3 "
    RTCBuildQuality quality;
    int flags;               // of RTCSceneFlags
    bool contends;           // in totals and batches, where settings that are never best are left out
    const char* device = ""; // of its configuration, beside the number of threads
};

std::unique_ptr<Subject> embree_subject(const EmbreeLibrary& library, const EmbreeSettings& settings);

} // namespace raywise::bench
