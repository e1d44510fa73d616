#include "contract/peers/embree_peer.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <utility>

namespace raywise::contract {
namespace {

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, ReleaseGeometry>;

void check(RTCDevice device, const std::string& what) {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE) throw std::runtime_error(what + ": Embree's error " + std::to_string(error));
}

Device new_device() {
    Device device(rtcNewDevice("threads=1"));
    if (!device) throw std::runtime_error("Embree gives no device");
    return device;
}

RTCRay ray_of(const Ray& ray) {
    // "The ray segment must be in the range [0, infinity], thus ranges that start behind the ray origin are not allowed."
    if (ray.tmin < 0.0) throw Inexpressible("Embree allows no interval that begins behind the origin");
    RTCRay out = {};
    out.org_x = static_cast<float>(ray.origin.x);
    out.org_y = static_cast<float>(ray.origin.y);
    out.org_z = static_cast<float>(ray.origin.z);
    out.tnear = static_cast<float>(ray.tmin);
    out.dir_x = static_cast<float>(ray.direction.x);
    out.dir_y = static_cast<float>(ray.direction.y);
    out.dir_z = static_cast<float>(ray.direction.z);
    out.tfar = static_cast<float>(ray.tmax);
    out.mask = ~0u;
    return out;
}

// The filter function is handed the context, so what it collects lies behind it.
struct CollectingContext {
    RTCIntersectContext context; // first: Embree sees a pointer to this
    std::vector<Answer>* answers;
};

void collect(const RTCFilterFunctionNArguments* arguments) {
    auto* collecting = reinterpret_cast<CollectingContext*>(arguments->context);
    for (unsigned int i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        Answer answer;
        answer.hit = true;
        answer.t = static_cast<double>(RTCRayN_tfar(arguments->ray, arguments->N, i));
        answer.u = static_cast<double>(RTCHitN_u(arguments->hit, arguments->N, i));
        answer.v = static_cast<double>(RTCHitN_v(arguments->hit, arguments->N, i));
        answer.geometry = RTCHitN_geomID(arguments->hit, arguments->N, i);
        answer.primitive = RTCHitN_primID(arguments->hit, arguments->N, i);
        collecting->answers->push_back(answer);
        arguments->valid[i] = 0; // rejected, so that the search goes on
    }
}

class EmbreeScene : public Scene {
public:
    EmbreeScene(RTCDevice device, EmbreeFlags flags, const std::vector<Mesh>& meshes) : scene_(rtcNewScene(device)) {
        // Without this flag a scene takes no filter function with a query; it changes no arithmetic.
        int scene_flags = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
        if (flags == EmbreeFlags::robust) scene_flags |= RTC_SCENE_FLAG_ROBUST;
        rtcSetSceneFlags(scene_.get(), static_cast<RTCSceneFlags>(scene_flags));
        for (std::size_t i = 0; i < meshes.size(); ++i) add(device, meshes[i], static_cast<unsigned int>(i));
        rtcCommitScene(scene_.get());
        check(device, "building");
    }

    Answer closest(const Ray& ray) override {
        RTCRayHit query = {};
        query.ray = ray_of(ray);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.primID = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene_.get(), &context, &query);
        Answer answer;
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return answer;
        answer.hit = true;
        answer.t = static_cast<double>(query.ray.tfar);
        answer.u = static_cast<double>(query.hit.u);
        answer.v = static_cast<double>(query.hit.v);
        answer.geometry = query.hit.geomID;
        answer.primitive = query.hit.primID;
        return answer;
    }

    bool any(const Ray& ray) override {
        RTCRay query = ray_of(ray);
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1(scene_.get(), &context, &query);
        return query.tfar == -std::numeric_limits<float>::infinity();
    }

    void all(const Ray& ray, std::vector<Answer>& answers) override {
        answers.clear();
        RTCRayHit query = {};
        query.ray = ray_of(ray);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        CollectingContext collecting;
        rtcInitIntersectContext(&collecting.context);
        collecting.context.filter = collect;
        collecting.answers = &answers;
        rtcIntersect1(scene_.get(), &collecting.context, &query);
        std::stable_sort(answers.begin(), answers.end(), [](const Answer& a, const Answer& b) { return a.t < b.t; });
    }

    void closest_batch(const std::vector<Ray>&, std::vector<Answer>&) override {
        throw Inexpressible("no call for many rays of any kind");
    }

private:
    void add(RTCDevice device, const Mesh& mesh, unsigned int id) {
        if (mesh.triangles.empty()) return; // Embree makes no buffer of no elements
        const Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
        auto* corners = static_cast<unsigned int*>(rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0,
                                                                           RTC_FORMAT_UINT3, 3 * sizeof(unsigned int),
                                                                           mesh.triangles.size()));
        check(device, "copying a mesh");
        for (const Vec3& vertex : mesh.vertices)
            for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(at(vertex, axis));
        for (const auto& triangle : mesh.triangles) corners = std::copy(triangle.begin(), triangle.end(), corners);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometryByID(scene_.get(), geometry.get(), id);
        check(device, "adding a mesh");
    }

    SceneHandle scene_;
};

class Embree : public Library {
public:
    explicit Embree(EmbreeFlags flags) : device_(new_device()), flags_(flags) {}

    std::string name() const override { return flags_ == EmbreeFlags::robust ? "Embree 3 robust" : "Embree 3"; }

    Capabilities capabilities() const override {
        Capabilities capabilities;
        capabilities.orders_ties = false;
        capabilities.decides_exactly = false;
        capabilities.counts_crossings = false;
        capabilities.t_tolerance = 1e-5;
        return capabilities;
    }

    std::unique_ptr<Scene> build(const std::vector<Mesh>& meshes) override {
        return std::make_unique<EmbreeScene>(device_.get(), flags_, meshes);
    }

private:
    Device device_;
    EmbreeFlags flags_;
};

} // namespace

std::unique_ptr<Library> make_embree(EmbreeFlags flags) { return std::make_unique<Embree>(flags); }

std::string embree_version() {
    const Device device = new_device();
    const auto version = [&device](RTCDeviceProperty property) {
        return std::to_string(rtcGetDeviceProperty(device.get(), property));
    };
    return version(RTC_DEVICE_PROPERTY_VERSION_MAJOR) + "." + version(RTC_DEVICE_PROPERTY_VERSION_MINOR) + "." +
           version(RTC_DEVICE_PROPERTY_VERSION_PATCH);
}

} // namespace raywise::contract
