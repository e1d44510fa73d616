#include "bench/subjects/embree_subject.h"

#include "bench/subjects/embree_query.h"
#include "bench/subjects/frames.h"

#include <atomic>
#include <mutex>
#include <utility>

namespace raywise::bench {
namespace {

// What a device holds, by its own account.
struct Account {
    std::atomic<std::int64_t> now{0};
    std::atomic<std::int64_t> most{0};

    void add(std::int64_t bytes) {
        const std::int64_t sum = now += bytes;
        std::int64_t seen = most;
        while (sum > seen && !most.compare_exchange_weak(seen, sum)) {
        }
    }
};

bool count_bytes(void* account, ssize_t bytes, bool) {
    static_cast<Account*>(account)->add(bytes);
    return true; // go on
}

// A device of so many threads, and its account. Made once: it belongs to the start of a program, not to the building of a scene.
class Device {
public:
    Device(const EmbreeLibrary& library, unsigned threads, const std::string& configuration)
        : library_(library),
          device_(library.rtcNewDevice(("threads=" + std::to_string(threads) + "," + configuration).c_str())) {
        if (device_ == nullptr) throw std::runtime_error("Embree gives no device");
        library_.rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &account);
    }
    ~Device() { library_.rtcReleaseDevice(device_); }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    RTCDevice handle() const { return device_; }

    Account account;

private:
    const EmbreeLibrary& library_;
    RTCDevice device_;
};

class EmbreeScene : public Built {
public:
    EmbreeScene(const EmbreeLibrary& library, Device& device, const EmbreeSettings& settings,
                const workloads::Mesh& mesh)
        : library_(library) {
        const std::int64_t before = device.account.now;
        device.account.most = before;
        scene_ = library.rtcNewScene(device.handle());
        library.rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(settings.flags));
        library.rtcSetSceneBuildQuality(scene_, settings.quality);
        const RTCGeometry geometry = library.rtcNewGeometry(device.handle(), RTC_GEOMETRY_TYPE_TRIANGLE);
        // Of the scene alone, LOW would not reach the tree of its one mesh.
        library.rtcSetGeometryBuildQuality(geometry, settings.quality);
        // Read in place, as raywise reads it. Embree may read 16 bytes from the last vertex on: see bench_scenes.h.
        library.rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.vertices.data(),
                                           0, 3 * sizeof(float), mesh.vertex_count());
        library.rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0,
                                           3 * sizeof(unsigned int), mesh.triangle_count());
        library.rtcCommitGeometry(geometry);
        library.rtcAttachGeometry(scene_, geometry);
        library.rtcReleaseGeometry(geometry);
        library.rtcCommitScene(scene_);
        library.check(device.handle(), "building");
        bytes_ = static_cast<double>(device.account.now - before);
        peak_bytes_ = static_cast<double>(device.account.most - before);
    }
    ~EmbreeScene() override { library_.rtcReleaseScene(scene_); }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    std::unique_ptr<Query> query(const QueryRequest& request) const override {
        return library_.major() == 3 ? query_by<Embree3Calls>(request) : query_by<Embree4Calls>(request);
    }

    double bytes() const override { return bytes_; }
    double peak_bytes() const override { return peak_bytes_; }

private:
    template <class Calls>
    std::unique_ptr<Query> query_by(const QueryRequest& request) const {
        const bool packets = request.call == Call::packet;
        const Calls calls(library_, scene_, packets);
        if (packets) return std::make_unique<EmbreePacketQuery<Calls>>(calls, request);
        return std::make_unique<EmbreeSingleQuery<Calls>>(calls, request);
    }

    const EmbreeLibrary& library_;
    RTCScene scene_ = nullptr;
    double bytes_ = 0.0;
    double peak_bytes_ = 0.0;
};

class Embree : public Subject {
public:
    Embree(Traits traits, const EmbreeLibrary& library, const EmbreeSettings& settings)
        : Subject(std::move(traits)), library_(library), settings_(settings) {}

    std::unique_ptr<Built> build(const BuildRequest& request) const override {
        std::unique_ptr<Device>& device = request.threads == 1 ? one_thread_ : all_threads_;
        if (!device) device = std::make_unique<Device>(library_, request.threads, settings_.device);
        return std::make_unique<EmbreeScene>(library_, *device, settings_, request.mesh);
    }

private:
    const EmbreeLibrary& library_;
    EmbreeSettings settings_;
    mutable std::unique_ptr<Device> one_thread_;
    mutable std::unique_ptr<Device> all_threads_;
};

// As Embree wants scenes that change: the same geometry committed again.
class EmbreeFrames : public Frames {
public:
    EmbreeFrames(const EmbreeLibrary& library, Renewal renewal, const workloads::Mesh& mesh)
        : Frames(mesh), library_(library), device_(library, 1, "") {
        const RTCBuildQuality quality = renewal == Renewal::build ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_REFIT;
        scene_ = library.rtcNewScene(device_.handle());
        library.rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
        library.rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);
        geometry_ = library.rtcNewGeometry(device_.handle(), RTC_GEOMETRY_TYPE_TRIANGLE);
        library.rtcSetGeometryBuildQuality(geometry_, quality);
        library.rtcSetSharedGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           mesh_.vertices.data(), 0, 3 * sizeof(float), mesh_.vertex_count());
        library.rtcSetSharedGeometryBuffer(geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh_.indices.data(),
                                           0, 3 * sizeof(unsigned int), mesh_.triangle_count());
        library.rtcCommitGeometry(geometry_);
        library.rtcAttachGeometry(scene_, geometry_);
        library.rtcCommitScene(scene_);
        library.check(device_.handle(), "building");
    }
    ~EmbreeFrames() override {
        library_.rtcReleaseGeometry(geometry_);
        library_.rtcReleaseScene(scene_);
    }

    void next() override {
        library_.rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
        library_.rtcCommitGeometry(geometry_);
        library_.rtcCommitScene(scene_);
        library_.check(device_.handle(), "the next frame");
    }

    std::unique_ptr<Query> query(const QueryRequest& request) const override {
        if (library_.major() == 3)
            return std::make_unique<EmbreeSingleQuery<Embree3Calls>>(Embree3Calls(library_, scene_, false), request);
        return std::make_unique<EmbreeSingleQuery<Embree4Calls>>(Embree4Calls(library_, scene_, false), request);
    }

private:
    const EmbreeLibrary& library_;
    Device device_;
    RTCScene scene_ = nullptr;
    RTCGeometry geometry_ = nullptr;
};

} // namespace

std::unique_ptr<Frames> embree_frames(const EmbreeLibrary& library, Renewal renewal, const workloads::Mesh& mesh) {
    return std::make_unique<EmbreeFrames>(library, renewal, mesh);
}

std::unique_ptr<Subject> embree_subject(const EmbreeLibrary& library, const EmbreeSettings& settings) {
    Traits traits;
    traits.name = "Embree " + std::to_string(library.major()) + " " + settings.name;
    traits.robust = (settings.flags & RTC_SCENE_FLAG_ROBUST) != 0;
    traits.totals = settings.contends;
    traits.batches = settings.contends && settings.quality != RTC_BUILD_QUALITY_LOW;
    traits.instruction_set = library.instruction_set(settings.device);
    traits.calls = {Call::single, Call::packet};
    return std::make_unique<Embree>(std::move(traits), library, settings);
}

} // namespace raywise::bench
