// isa_write_inputs FILE: the scenes and rays of the oracle, for the programs that answer them at every instruction set.
#include "isa/inputs.h"
#include "oracle/rays.h"
#include "oracle/scenes.h"

#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

namespace raywise::isa {
namespace {

// How many rays of each sort a scene gets. Few for each of many scenes: a difference between instruction sets is one of
// rounding, which many kinds of coordinates show sooner than many rays.
struct RayCounts {
    int random;
    int hard;
    int leak;
};
constexpr RayCounts for_hard_scenes{20, 3, 4};
constexpr RayCounts for_large_scenes{20, 1, 3};

void copy(const Vec3& from, double (&to)[3]) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis];
}

InputRay packed(const Ray& ray) {
    InputRay packed{};
    copy(ray.origin, packed.origin);
    copy(ray.direction, packed.direction);
    packed.tmin = ray.tmin;
    packed.tmax = ray.tmax;
    return packed;
}

// Seen from its middle and along a slope, with rays from there and along it.
void add_views(const oracle::Scene& scene, InputScene& input) {
    Box box;
    for (const Vec3& vertex : scene.vertices) box.extend(vertex);
    if (box.empty()) return;
    const Vec3 slope(0.3, -1.0, 0.7);
    InputView from_middle{};
    copy(box.center(), from_middle.origin);
    InputView along{};
    along.along_direction = 1;
    copy(slope, along.direction);
    input.views = {from_middle, along};

    const std::size_t step = scene.vertices.size() / 20 + 1;
    for (std::size_t i = 0; i < scene.vertices.size(); i += step) {
        for (const Ray& ray : {Ray{box.center(), 0.0, scene.vertices[i] - box.center()},
                               Ray{scene.vertices[i] - max_component(box.size()) * slope, 0.0, slope}}) {
            if (ray.is_traceable()) input.rays.push_back(packed(ray));
        }
    }
}

void add(InputFile& file, const oracle::Scene& scene, const RayCounts& counts, unsigned seed) {
    InputScene input;
    input.name = scene.name;
    for (const Vec3& v : scene.vertices) input.vertices.push_back({v.x, v.y, v.z});
    input.triangles = scene.triangles;
    const bool empty = scene.triangles.empty();
    for (const auto& rays :
         {oracle::random_rays(scene, counts.random, seed), oracle::hard_rays(scene, counts.hard, seed + 1),
          oracle::leak_rays(empty ? oracle::cube() : scene, counts.leak, seed + 2)}) {
        for (const Ray& ray : rays) input.rays.push_back(packed(ray));
    }
    add_views(scene, input);
    file.write(input);
}

int run(const char* path) {
    InputFile file(path, "wb");
    unsigned seed = 71;
    for (const oracle::Scene& scene : oracle::hard_scenes()) add(file, scene, for_hard_scenes, seed += 3);
    for (const oracle::Scene& scene : oracle::large_scenes()) add(file, scene, for_large_scenes, seed += 3);
    file.close();
    return 0;
}

} // namespace
} // namespace raywise::isa

int main(int argc, char** argv) {
    const bool help = argc == 2 && std::string_view(argv[1]) == "--help";
    if (argc != 2 || help) {
        std::fprintf(help ? stdout : stderr,
                     "usage: isa_write_inputs FILE\n"
                     "Writes scenes and rays for the isa_digest programs.\n");
        return help ? 0 : 2;
    }
    try {
        return raywise::isa::run(argv[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "isa_write_inputs: %s\n", error.what());
        return 1;
    }
}
