#include "bench/scenes/bench_scenes.h"

#include "bench/meshes.h"
#include "bench/scenes/far_scenes.h"
#include "bench/scenes/nff.h"
#include "bench/scenes/shapes.h"

namespace raywise::bench {
namespace {

using workloads::Mesh;

Mesh load(const Library& library, const std::string& folder, const std::string& file) {
    std::vector<NamedMesh> found = mesh_file(library, folder, file);
    if (found.empty()) throw MissingFile(folder.empty() ? file : folder + "/" + file);
    return std::move(found.front().mesh);
}

TestScene bunny(const SceneRow&, std::uint64_t, const Library& library, const SceneFiles& files) {
    return load(library, files.meshes, "stanford-bunny.obj");
}

TestScene igea(const SceneRow&, std::uint64_t, const Library& library, const SceneFiles& files) {
    return load(library, files.meshes, "igea.ply");
}

TestScene dragon(const SceneRow&, std::uint64_t, const Library& library, const SceneFiles& files) {
    const std::size_t slash = files.dragon.rfind('/');
    if (slash == std::string::npos) throw MissingFile("dragon.ply");
    return load(library, files.dragon.substr(0, slash), files.dragon.substr(slash + 1));
}

// The bunny in a hall two hundred times its size.
TestScene stadium(const SceneRow& row, std::uint64_t triangles, const Library& library, const SceneFiles& files) {
    return in_a_hall(bunny(row, triangles, library, files).mesh, 200.0);
}

TestScene procedural(const SceneRow& row, std::uint64_t triangles, const Library&, const SceneFiles&) {
    return procedural_mesh(row.name, triangles).mesh;
}

TestScene box(const SceneRow&, std::uint64_t, const Library&, const SceneFiles&) {
    return procedural_mesh("tiny_box", 12).mesh;
}

TestScene sticks(const SceneRow&, std::uint64_t triangles, const Library&, const SceneFiles&) {
    return long_sticks(triangles);
}

TestScene bunny_on_far_ground(const SceneRow& row, std::uint64_t triangles, const Library& library,
                              const SceneFiles& files) {
    return far_ground(bunny(row, triangles, library, files).mesh, 1e5);
}

TestScene terrain_at_utm(const SceneRow&, std::uint64_t triangles, const Library&, const SceneFiles&) {
    return at_utm(procedural_mesh("terrain", triangles).mesh);
}

TestScene sphereflake_in_far_sun(const SceneRow&, std::uint64_t triangles, const Library&, const SceneFiles&) {
    return in_far_sun(procedural_mesh("sphereflake", triangles).mesh);
}

Mesh spd(const SceneFiles& files, const char* file) {
    if (files.spd.empty()) throw MissingFile(file);
    return load_nff(files.spd + "/" + file);
}

TestScene gears(const SceneRow&, std::uint64_t, const Library&, const SceneFiles& files) {
    return spd(files, "gears-4.nff");
}
TestScene tree(const SceneRow&, std::uint64_t, const Library&, const SceneFiles& files) {
    return spd(files, "tree-11.nff");
}

} // namespace

const std::vector<SceneRow>& scene_rows() {
    static const std::vector<SceneRow> rows = {
        // name, in the short form, far apart, triangles, in the short form
        {"box", true, false, 12, 12, box},
        {"bunny", true, false, 0, 0, bunny},
        {"stadium", false, false, 0, 0, stadium},
        {"gears", false, false, 0, 0, gears},
        {"sticks", true, false, 200000, 20000, sticks},
        {"interior", false, false, 250000, 25000, procedural},
        {"igea", false, false, 0, 0, igea},
        {"tree", false, false, 0, 0, tree},
        {"dragon", false, false, 0, 0, dragon},
        {"soup", true, false, 1000000, 50000, procedural},
        {"terrain", false, false, 2097152, 50000, procedural},
        {"sphereflake", true, false, 2361920, 50000, procedural},
        {"far_ground", true, true, 0, 0, bunny_on_far_ground},
        {"utm", true, true, 250000, 25000, terrain_at_utm},
        {"far_sun", true, true, 250000, 25000, sphereflake_in_far_sun},
    };
    return rows;
}

TestScene make_scene(const SceneRow& row, bool quick, const Library& library, const SceneFiles& files) {
    TestScene scene = row.make(row, quick ? row.quick_triangles : row.triangles, library, files);
    scene.mesh.vertices.reserve(scene.mesh.vertices.size() + 4);
    return scene;
}

} // namespace raywise::bench
