#include "bench/subjects/embree_library.h"

#include <cstring>
#include <stdexcept>

#include <dlfcn.h>

namespace raywise::bench {

EmbreeLibrary::EmbreeLibrary(const std::string& path) {
    // Its own functions and thread library first: both Embrees and more than one oneTBB are in this process.
    void* const handle = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
    if (handle == nullptr) throw std::runtime_error(::dlerror());
    const auto find = [&](const char* function) {
        void* const address = ::dlsym(handle, function);
        if (address == nullptr) throw std::runtime_error(path + " has no " + function);
        return address;
    };
#define RW_BENCH_FIND(function)                                 \
    {                                                           \
        void* const address = find(#function);                  \
        std::memcpy(&this->function, &address, sizeof address); \
    }
    RW_BENCH_EMBREE_FUNCTIONS(RW_BENCH_FIND)
#undef RW_BENCH_FIND
    intersect1 = find("rtcIntersect1");
    occluded1 = find("rtcOccluded1");
    intersect8 = find("rtcIntersect8");
    occluded8 = find("rtcOccluded8");

    // One of all threads is kept, and comes first. Of two devices with threads=1 and none such, oneTBB 2021.12 has a thread that waits at full speed for
    // as long as they live: in the processor time of whoever is measured, and beside it on its core.
    if (rtcNewDevice("") == nullptr) throw std::runtime_error(path + " gives no device");
    const RTCDevice device = rtcNewDevice("threads=1");
    if (device == nullptr) throw std::runtime_error(path + " gives no device");
    const auto property = [&](RTCDeviceProperty which) {
        return static_cast<int>(rtcGetDeviceProperty(device, which));
    };
    major_ = property(RTC_DEVICE_PROPERTY_VERSION_MAJOR);
    version_ = std::to_string(major_) + "." + std::to_string(property(RTC_DEVICE_PROPERTY_VERSION_MINOR)) + "." +
               std::to_string(property(RTC_DEVICE_PROPERTY_VERSION_PATCH));
    rtcReleaseDevice(device);
    if (major_ != 3 && major_ != 4) throw std::runtime_error(path + " is Embree " + version_ + ", not 3 or 4");
}

void EmbreeLibrary::check(RTCDevice device, const char* what) const {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE) {
        throw std::runtime_error("Embree " + version_ + ", " + what + ": error " + std::to_string(error));
    }
}

std::string EmbreeLibrary::instruction_set(const char* configuration) const {
    constexpr struct {
        RTCDeviceProperty rays;
        const char* name;
    } widths[] = {{RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED, "AVX3"},
                  {RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED, "AVX2"},
                  {RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED, "SSE4"}};
    const RTCDevice device = rtcNewDevice(configuration);
    if (device == nullptr) throw std::runtime_error("Embree " + version_ + " gives no device for " + configuration);
    std::string found;
    for (const auto& width : widths) {
        if (found.empty() && rtcGetDeviceProperty(device, width.rays) != 0) found = width.name;
    }
    rtcReleaseDevice(device);
    return found;
}

} // namespace raywise::bench
