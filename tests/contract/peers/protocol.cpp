#include "contract/peers/protocol.h"

namespace raywise::contract {

void Packer::put(const Vec3& v) {
    put(v.x);
    put(v.y);
    put(v.z);
}

void Packer::put(const Ray& ray) {
    put(ray.origin);
    put(ray.direction);
    put(ray.tmin);
    put(ray.tmax);
}

void Packer::put(const Answer& answer) {
    put(answer.t);
    put(answer.u);
    put(answer.v);
    put(std::uint32_t{answer.hit});
    put(answer.geometry);
    put(answer.primitive);
    put(std::uint32_t{0});
}

void Packer::put(const Mesh& mesh) {
    put(std::uint32_t{mesh.float32});
    put(std::uint32_t{mesh.skip_invalid});
    put(static_cast<std::uint32_t>(mesh.vertices.size()));
    put(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const Vec3& vertex : mesh.vertices) put(vertex);
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) put(corner);
}

Vec3 Unpacker::vector() {
    Vec3 v;
    v.x = get<double>();
    v.y = get<double>();
    v.z = get<double>();
    return v;
}

Ray Unpacker::ray() {
    Ray ray;
    ray.origin = vector();
    ray.direction = vector();
    ray.tmin = get<double>();
    ray.tmax = get<double>();
    return ray;
}

Answer Unpacker::answer() {
    Answer answer;
    answer.t = get<double>();
    answer.u = get<double>();
    answer.v = get<double>();
    answer.hit = get<std::uint32_t>() != 0;
    answer.geometry = get<std::uint32_t>();
    answer.primitive = get<std::uint32_t>();
    get<std::uint32_t>();
    return answer;
}

Mesh Unpacker::mesh() {
    Mesh mesh;
    mesh.float32 = get<std::uint32_t>() != 0;
    mesh.skip_invalid = get<std::uint32_t>() != 0;
    mesh.vertices.resize(get<std::uint32_t>());
    mesh.triangles.resize(get<std::uint32_t>());
    for (Vec3& vertex : mesh.vertices) vertex = vector();
    for (auto& triangle : mesh.triangles)
        for (std::uint32_t& corner : triangle) corner = get<std::uint32_t>();
    return mesh;
}

std::string Unpacker::text() {
    const std::string rest = bytes_.substr(at_);
    at_ = bytes_.size();
    return rest;
}

} // namespace raywise::contract
