#include "bench/export_scene.h"

#include "bench/binary.h"

#include "rays/rays.h"

#include <filesystem>
#include <fstream>

namespace raywise::bench {

void export_scene(SceneUnderTest& scene, const std::string& folder, std::uint64_t rays_of_kind) {
    std::filesystem::create_directories(folder);
    const std::string path = folder + "/" + scene.name() + ".scene";
    std::ofstream out(path, std::ios::binary);
    write_values(out, scene.mesh().vertices);
    write_values(out, scene.mesh().indices);
    for (std::size_t kind = 0; kind < workloads::ray_distributions().size(); ++kind) {
        const RaySet rays = scene.rays(kind, rays_of_kind);
        write_values(out, rays.origin);
        write_values(out, rays.direction);
        write_values(out, rays.tmin);
        write_values(out, rays.tmax);
    }
    out.close();
    if (!out) throw std::runtime_error(path + " cannot be written");
}

} // namespace raywise::bench
