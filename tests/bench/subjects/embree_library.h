// Embree 3 or 4 through the dynamic linker: both can be in one process, each with the thread library it was built with, and
// a machine that lacks one of them measures the other.
#pragma once

#include <embree3/rtcore.h>

#include <string>

namespace raywise::bench {

// What 3 and 4 declare alike; the constants handed to them are the same as well.
#define RW_BENCH_EMBREE_FUNCTIONS(X)     \
    X(rtcNewDevice)                      \
    X(rtcReleaseDevice)                  \
    X(rtcGetDeviceError)                 \
    X(rtcGetDeviceProperty)              \
    X(rtcSetDeviceMemoryMonitorFunction) \
    X(rtcNewScene)                       \
    X(rtcReleaseScene)                   \
    X(rtcSetSceneFlags)                  \
    X(rtcSetSceneBuildQuality)           \
    X(rtcCommitScene)                    \
    X(rtcNewGeometry)                    \
    X(rtcReleaseGeometry)                \
    X(rtcSetGeometryBuildQuality)        \
    X(rtcSetSharedGeometryBuffer)        \
    X(rtcUpdateGeometryBuffer)           \
    X(rtcCommitGeometry)                 \
    X(rtcAttachGeometry)

class EmbreeLibrary {
public:
    // path: a file, or a name for the dynamic linker. Throws std::runtime_error when there is none.
    explicit EmbreeLibrary(const std::string& path);
    EmbreeLibrary(const EmbreeLibrary&) = delete; // stays in memory for the life of the process
    EmbreeLibrary& operator=(const EmbreeLibrary&) = delete;

    int major() const { return major_; }
    const std::string& version() const { return version_; }
    void check(RTCDevice device, const char* what) const;
    // What a device of that configuration uses, by Highway's names. Embree tells how wide it works, and no more.
    std::string instruction_set(const char* configuration) const;

#define RW_BENCH_MEMBER(function) decltype(&::function) function = nullptr;
    RW_BENCH_EMBREE_FUNCTIONS(RW_BENCH_MEMBER)
#undef RW_BENCH_MEMBER

    // The queries, whose arguments differ; see embree_calls.h.
    void* intersect1 = nullptr;
    void* occluded1 = nullptr;
    void* intersect8 = nullptr;
    void* occluded8 = nullptr;

private:
    int major_ = 0;
    std::string version_;
};

} // namespace raywise::bench
