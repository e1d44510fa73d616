// One shot: meshes and rays in, answers out, nothing kept.
#include "query.h"
#include "shared_memory.h"

using namespace raywise;
using namespace raywise::capi;

namespace {

// The build is watched as the batch is.
Progress::Callback read_build_watch(const rw_query_options& options) {
    BatchWatch watch = read_watch(options);
    if (watch.cancel == nullptr) return std::move(watch.progress);
    return [watch = std::move(watch)](double fraction, const char* stage) {
        return watch.is_cancelled() || (watch.progress && watch.progress(fraction, stage));
    };
}

// A committed scene over the caller's arrays, planned for exactly these rays.
Scene make_scene(const rw_triangles* meshes, std::uint32_t mesh_count, const rw_rays* rays,
                 const rw_once_options& options, const rw_query_options& query) {
    Scene scene(options.profile != nullptr ? options.profile->value : kept_profile());
    for_each_mesh(meshes, mesh_count, [&](const rw_triangles& mesh, const std::string&) {
        scene.add_triangles(read_triangles(mesh), false, (mesh.flags & RW_TRIANGLES_SKIP_INVALID) != 0);
    });
    const RayArrays arrays = read_rays(rays, "rays");
    Workload workload = read_workload(RW_RAYS_UNKNOWN, options.kind, "options");
    workload.rays = std::max<std::uint64_t>(arrays.count, 1);
    scene.set_expected(workload, {});
    scene.set_memory_limit(options.memory_limit);
    scene.set_structure(read_structure(options.structure));
    Progress progress(read_build_watch(query));
    scene.commit(read_parallel(query.threads, query.parallel_for, query.parallel_user), progress);
    return scene;
}

} // namespace

extern "C" {

std::int32_t rw_once_intersect(const rw_triangles* meshes, std::uint32_t mesh_count, const rw_rays* rays,
                               const rw_hits* hits, const rw_once_options* options) {
    return guard([&] {
        const rw_once_options o = read_optional_struct(options, "options");
        const rw_query_options query = read_optional_struct(o.query, "options.query");
        // Below it is the caller's struct that is handed on: the copy says the caller's size and is not as large.
        // A wrong output is told before the work is done.
        const std::uint64_t count = read_rays(rays, "rays").count;
        BatchMemory outputs;
        outputs.writes(read_hits(hits, count), count);
        outputs.refuse_shared();
        intersect_batch(make_scene(meshes, mesh_count, rays, o, query).tracer(), rays, hits, o.query);
    });
}

std::int32_t rw_once_occluded(const rw_triangles* meshes, std::uint32_t mesh_count, const rw_rays* rays,
                              const rw_output* answers, const rw_once_options* options) {
    return guard([&] {
        const rw_once_options o = read_optional_struct(options, "options");
        const rw_query_options query = read_optional_struct(o.query, "options.query");
        read_output(required(answers, "occluded"), read_rays(rays, "rays").count, 1, OutputKind::flags, "occluded");
        occluded_batch(make_scene(meshes, mesh_count, rays, o, query).tracer(), rays, answers, o.query);
    });
}

} // extern "C"
