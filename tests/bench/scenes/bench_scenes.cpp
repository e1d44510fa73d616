#include "bench/scenes/bench_scenes.h"

#include "bench/meshes.h"
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

Mesh bunny(const SceneRow&, std::uint64_t, const Library& library, const SceneFiles& files) {
    return load(library, files.meshes, "stanford-bunny.obj");
}

Mesh igea(const SceneRow&, std::uint64_t, const Library& library, const SceneFiles& files) {
    return load(library, files.meshes, "igea.ply");
}

Mesh dragon(const SceneRow&, std::uint64_t, const Library& library, const SceneFiles& files) {
    const std::size_t slash = files.dragon.rfind('/');
    if (slash == std::string::npos) throw MissingFile("dragon.ply");
    return load(library, files.dragon.substr(0, slash), files.dragon.substr(slash + 1));
}

// The bunny in a hall two hundred times its size.
Mesh stadium(const SceneRow& row, std::uint64_t triangles, const Library& library, const SceneFiles& files) {
    return in_a_hall(bunny(row, triangles, library, files), 200.0);
}

Mesh procedural(const SceneRow& row, std::uint64_t triangles, const Library&, const SceneFiles&) {
    return procedural_mesh(row.name, triangles).mesh;
}

Mesh box(const SceneRow&, std::uint64_t, const Library&, const SceneFiles&) {
    return procedural_mesh("tiny_box", 12).mesh;
}

Mesh sticks(const SceneRow&, std::uint64_t triangles, const Library&, const SceneFiles&) {
    return long_sticks(triangles);
}

Mesh spd(const SceneFiles& files, const char* file) {
    if (files.spd.empty()) throw MissingFile(file);
    return load_nff(files.spd + "/" + file);
}

Mesh gears(const SceneRow&, std::uint64_t, const Library&, const SceneFiles& files) {
    return spd(files, "gears-4.nff");
}
Mesh tree(const SceneRow&, std::uint64_t, const Library&, const SceneFiles& files) { return spd(files, "tree-11.nff"); }

} // namespace

const std::vector<SceneRow>& scene_rows() {
    static const std::vector<SceneRow> rows = {
        // name, in the short form, triangles, in the short form
        {"box", true, 12, 12, box},
        {"bunny", true, 0, 0, bunny},
        {"stadium", false, 0, 0, stadium},
        {"gears", false, 0, 0, gears},
        {"sticks", true, 200000, 20000, sticks},
        {"interior", false, 250000, 25000, procedural},
        {"igea", false, 0, 0, igea},
        {"tree", false, 0, 0, tree},
        {"dragon", false, 0, 0, dragon},
        {"soup", true, 1000000, 50000, procedural},
        {"terrain", false, 2097152, 50000, procedural},
        {"sphereflake", true, 2361920, 50000, procedural},
    };
    return rows;
}

Mesh make_scene(const SceneRow& row, bool quick, const Library& library, const SceneFiles& files) {
    Mesh mesh = row.make(row, quick ? row.quick_triangles : row.triangles, library, files);
    mesh.vertices.reserve(mesh.vertices.size() + 4);
    return mesh;
}

} // namespace raywise::bench
