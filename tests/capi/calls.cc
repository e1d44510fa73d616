#include "calls.h"

#include <algorithm>

#include <unistd.h>

namespace {

constexpr double view_point[3] = {0.0, 0.0, 3.0};

rw_commit_options commit_options(uint32_t threads) {
    rw_commit_options options{};
    options.struct_size = sizeof options;
    options.threads = threads;
    return options;
}

rw_query_options query_options(uint32_t threads) {
    rw_query_options options{};
    options.struct_size = sizeof options;
    options.threads = threads;
    return options;
}

rw_view_options view_options(const char* structure) {
    rw_view_options options{};
    options.struct_size = sizeof options;
    options.count = 1000;
    options.structure = structure;
    std::copy_n(view_point, 3, options.origin);
    return options;
}

rw_scene* make_on(const rw_triangles& mesh, const char* structure, int32_t effort, uint32_t threads) {
    rw_scene* scene = nullptr;
    const rw_commit_options options = commit_options(threads);
    if (rw_scene_create(nullptr, &scene) != RW_OK || rw_scene_add_triangles(scene, &mesh, nullptr) != RW_OK ||
        rw_scene_set_structure(scene, structure) != RW_OK ||
        rw_scene_set_effort(scene, effort, RW_RULE_SMALLEST_TOTAL, 0.0) != RW_OK ||
        rw_scene_commit(scene, &options) != RW_OK) {
        rw_scene_release(scene);
        return nullptr;
    }
    return scene;
}

} // namespace

CallFiles::CallFiles() {
    char folder[] = "/tmp/raywise-calls-XXXXXX";
    if (mkdtemp(folder) == nullptr) exit(1);
    folder_ = folder;
    meshes_ = {write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"),
               write("square.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"),
               write("square.ply",
                     "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                     "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                     "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"),
               write("square.stl",
                     "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n"
                     "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\n"
                     "vertex 0 1 0\nendloop\nendfacet\nendsolid s\n")};
    rw_profile* generic = nullptr;
    uint64_t size = 0;
    NEED_OK(rw_profile_load(nullptr, &generic));
    NEED_OK(rw_profile_text(generic, RW_FORMAT_JSON, nullptr, 0, &size));
    std::vector<char> text(size);
    NEED_OK(rw_profile_text(generic, RW_FORMAT_JSON, text.data(), size, nullptr));
    rw_profile_release(generic);
    profile_ = write("profile.json", text.data());
}

CallFiles::~CallFiles() {
    for (const std::string& mesh : meshes_) unlink(mesh.c_str());
    unlink(profile_.c_str());
    rmdir(folder_.c_str());
}

std::string CallFiles::write(const char* name, const std::string& text) {
    const std::string path = folder_ + "/" + name;
    FILE* file = fopen(path.c_str(), "wb");
    if (file == nullptr || fwrite(text.data(), 1, text.size(), file) != text.size() || fclose(file) != 0) exit(1);
    return path;
}

Caller::Caller(const CallFiles& files, uint64_t triangles, uint64_t rays)
    : files_(files),
      soup_(make_soup(triangles)),
      mesh_(triangles_of(&soup_)),
      scene_(make_on(mesh_, "bvh", RW_EFFORT_ESTIMATE, 1)),
      right_(rays),
      batch_{},
      t_(rays),
      flags_(rays),
      offsets_(rays + 1),
      text_(1 << 16) {
    use_all_helpers();
    for (uint64_t i = 0; i < rays; ++i) rays_.push_back(random_ray());
    rw_scene* judge = make_on(mesh_, "linear_scan", RW_EFFORT_ESTIMATE, 1);
    const rw_view_options options = view_options("projected_bvh");
    const rw_commit_options alone = commit_options(1);
    if (scene_ == nullptr || judge == nullptr || rw_scene_view(scene_, &options, &alone, &view_) != RW_OK) exit(1);
    for (uint64_t i = 0; i < rays; ++i) NEED_OK(rw_scene_intersect(judge, &rays_[i], nullptr, &right_[i]));
    rw_scene_release(judge);
    batch_.struct_size = sizeof batch_;
    batch_.count = rays;
    batch_.origin.data = rays_[0].origin;
    batch_.direction.data = rays_[0].direction;
    batch_.origin.stride = batch_.direction.stride = sizeof(rw_ray);
    batch_.origin.type = batch_.direction.type = RW_FLOAT64;
}

Caller::~Caller() {
    rw_scene_release(view_);
    rw_scene_release(scene_);
    free_soup(&soup_);
}

bool Caller::hits_are_right() const {
    for (size_t i = 0; i < right_.size(); ++i) {
        if (t_[i] != right_[i].t) return false;
    }
    return true;
}

bool Caller::flags_are_right() const {
    for (size_t i = 0; i < right_.size(); ++i) {
        if (flags_[i] != (right_[i].primitive != RW_INVALID_ID ? 1 : 0)) return false;
    }
    return true;
}

const rw_ray& Caller::next_ray() {
    next_ = (next_ + 1) % rays_.size();
    return rays_[next_];
}

const rw_hit& Caller::right_hit() const { return right_[next_]; }

bool Caller::batch_closest(uint32_t threads) { return batch_closest_of(scene_, threads); }

bool Caller::batch_of_view(uint32_t threads) { return batch_closest_of(view_, threads); }

bool Caller::batch_closest_of(const rw_scene* scene, uint32_t threads) {
    rw_hits hits{};
    hits.struct_size = sizeof hits;
    hits.t.data = t_.data();
    hits.t.type = RW_FLOAT64;
    std::fill(t_.begin(), t_.end(), -1.0);
    const rw_query_options options = query_options(threads);
    return rw_scene_intersect_batch(scene, &batch_, &hits, &options) == RW_OK && hits_are_right();
}

bool Caller::batch_any(uint32_t threads) {
    rw_output occluded{};
    occluded.data = flags_.data();
    std::fill(flags_.begin(), flags_.end(), uint8_t{2});
    const rw_query_options options = query_options(threads);
    return rw_scene_occluded_batch(scene_, &batch_, &occluded, &options) == RW_OK && flags_are_right();
}

bool Caller::batch_all(uint32_t threads) {
    uint64_t needed = 0;
    const rw_query_options options = query_options(threads);
    if (rw_scene_intersect_all_batch(scene_, &batch_, offsets_.data(), nullptr, 0, &needed, &options) != RW_OK)
        return false;
    for (size_t i = 0; i < right_.size(); ++i) flags_[i] = offsets_[i + 1] > offsets_[i] ? 1 : 0;
    return flags_are_right();
}

bool Caller::single_closest(uint32_t) {
    rw_hit hit;
    return rw_scene_intersect(scene_, &next_ray(), nullptr, &hit) == RW_OK &&
           memcmp(&hit, &right_hit(), sizeof hit) == 0 &&
           rw_scene_intersect(view_, &next_ray(), nullptr, &hit) == RW_OK &&
           memcmp(&hit, &right_hit(), sizeof hit) == 0;
}

bool Caller::single_any(uint32_t) {
    int32_t any = 2;
    return rw_scene_occluded(scene_, &next_ray(), nullptr, &any) == RW_OK &&
           (any == 1) == (right_hit().primitive != RW_INVALID_ID);
}

bool Caller::single_all(uint32_t) {
    rw_hit hits[8];
    uint64_t needed = 0;
    const int32_t status = rw_scene_intersect_all(scene_, &next_ray(), nullptr, hits, 8, &needed);
    if (status != (needed > 8 ? RW_ERROR_CAPACITY : RW_OK)) return false;
    return needed == 0 ? right_hit().primitive == RW_INVALID_ID : memcmp(&hits[0], &right_hit(), sizeof hits[0]) == 0;
}

bool Caller::single_with_skips(uint32_t) {
    rw_hit hit;
    const rw_ray& ray = next_ray();
    const rw_hit& right = right_hit();
    if (right.primitive == RW_INVALID_ID) return true;
    const rw_primitive_id skip{right.instance, right.geometry, right.primitive};
    rw_ray_options options{};
    options.struct_size = sizeof options;
    options.skip_count = 1;
    options.skip = &skip;
    return rw_scene_intersect(scene_, &ray, &options, &hit) == RW_OK && hit.primitive != right.primitive &&
           hit.t >= right.t;
}

bool Caller::commit(const char* structure, int32_t effort, uint32_t threads) {
    rw_scene* scene = make_on(mesh_, structure, effort, threads);
    rw_hit hit;
    const bool right = scene != nullptr && rw_scene_intersect(scene, &next_ray(), nullptr, &hit) == RW_OK &&
                       memcmp(&hit, &right_hit(), sizeof hit) == 0;
    rw_scene_release(scene);
    return right;
}

bool Caller::refit(uint32_t threads) {
    rw_scene* scene = nullptr;
    rw_hit hit;
    const rw_commit_options options = commit_options(threads);
    const bool right = rw_scene_refit(scene_, &mesh_, 1, &options, &scene) == RW_OK &&
                       rw_scene_intersect(scene, &next_ray(), nullptr, &hit) == RW_OK &&
                       memcmp(&hit, &right_hit(), sizeof hit) == 0;
    rw_scene_release(scene);
    return right;
}

bool Caller::view(uint32_t threads) {
    rw_scene* view = nullptr;
    rw_hit hit;
    const rw_view_options options = view_options("projected_bvh");
    const rw_commit_options commit = commit_options(threads);
    const bool right = rw_scene_view(scene_, &options, &commit, &view) == RW_OK &&
                       rw_scene_intersect(view, &next_ray(), nullptr, &hit) == RW_OK &&
                       memcmp(&hit, &right_hit(), sizeof hit) == 0;
    rw_scene_release(view);
    return right;
}

bool Caller::once_closest(uint32_t threads) {
    rw_hits hits{};
    hits.struct_size = sizeof hits;
    hits.t.data = t_.data();
    hits.t.type = RW_FLOAT64;
    const rw_query_options query = query_options(threads);
    rw_once_options options{};
    options.struct_size = sizeof options;
    options.query = &query;
    std::fill(t_.begin(), t_.end(), -1.0);
    return rw_once_intersect(&mesh_, 1, &batch_, &hits, &options) == RW_OK && hits_are_right();
}

bool Caller::once_any(uint32_t threads) {
    rw_output occluded{};
    occluded.data = flags_.data();
    const rw_query_options query = query_options(threads);
    rw_once_options options{};
    options.struct_size = sizeof options;
    options.query = &query;
    std::fill(flags_.begin(), flags_.end(), uint8_t{2});
    return rw_once_occluded(&mesh_, 1, &batch_, &occluded, &options) == RW_OK && flags_are_right();
}

bool Caller::load_profile(uint32_t) {
    rw_profile* named = nullptr;
    rw_profile* found = nullptr;
    uint64_t needed = 0;
    rw_profile_load(files_.profile().c_str(), &named); // measured elsewhere, as its status may say
    const bool right = named != nullptr && rw_profile_load(nullptr, &found) == RW_OK &&
                       rw_profile_text(named, RW_FORMAT_TEXT, text_.data(), text_.size(), &needed) == RW_OK;
    rw_profile_release(named);
    rw_profile_release(found);
    return right && needed > 1;
}

bool Caller::load_mesh(const std::string& path) {
    rw_mesh* mesh = nullptr;
    rw_triangles triangles{};
    triangles.struct_size = sizeof triangles;
    const bool right = rw_mesh_load(path.c_str(), &mesh) == RW_OK && rw_mesh_triangles(mesh, &triangles) == RW_OK &&
                       triangles.triangle_count == 2;
    rw_mesh_release(mesh);
    return right;
}

bool Caller::explain(uint32_t) {
    uint64_t text = 0;
    uint64_t json = 0;
    return rw_scene_explain(scene_, RW_FORMAT_TEXT, text_.data(), text_.size(), &text) == RW_OK && text > 1 &&
           rw_scene_explain(scene_, RW_FORMAT_JSON, text_.data(), text_.size(), &json) == RW_OK && json > 1;
}

bool Caller::fail(uint32_t) {
    rw_scene* scene = nullptr;
    rw_mesh* mesh = nullptr;
    const bool right = rw_scene_create(nullptr, &scene) == RW_OK &&
                       rw_scene_set_structure(scene, "none such") == RW_ERROR_UNKNOWN_STRUCTURE &&
                       rw_mesh_load("/none/such.obj", &mesh) != RW_OK;
    rw_scene_release(scene);
    return right;
}

std::vector<Call> all_calls(const CallFiles& files) {
    const auto member = [](bool (Caller::*function)(uint32_t)) {
        return [function](Caller& caller, uint32_t threads) { return (caller.*function)(threads); };
    };
    std::vector<Call> calls = {
        {"batch, closest", 1500, member(&Caller::batch_closest)},
        {"batch, any", 1500, member(&Caller::batch_any)},
        {"batch, all", 600, member(&Caller::batch_all)},
        {"batch of a view", 600, member(&Caller::batch_of_view)},
        {"single, closest", 20000, member(&Caller::single_closest)},
        {"single, any", 20000, member(&Caller::single_any)},
        {"single, all", 20000, member(&Caller::single_all)},
        {"single, with skips", 20000, member(&Caller::single_with_skips)},
        {"commit, chosen", 300,
         [](Caller& caller, uint32_t threads) { return caller.commit(nullptr, RW_EFFORT_ESTIMATE, threads); }},
        {"commit, measured", 10,
         [](Caller& caller, uint32_t threads) { return caller.commit(nullptr, RW_EFFORT_MEASURE, threads); }}};
    uint32_t structures = 0;
    NEED_OK(rw_structure_count(&structures));
    for (uint32_t i = 0; i < structures; ++i) {
        const char* name = nullptr;
        NEED_OK(rw_structure_name(i, &name));
        const long weight = strcmp(name, "kd_tree") == 0 ? 60 : 400;
        calls.push_back({std::string("commit, ") + name, weight, [name](Caller& caller, uint32_t threads) {
                             return caller.commit(name, RW_EFFORT_ESTIMATE, threads);
                         }});
    }
    const std::vector<Call> others = {{"refit", 600, member(&Caller::refit)},
                                      {"view", 300, member(&Caller::view)},
                                      {"one shot, closest", 200, member(&Caller::once_closest)},
                                      {"one shot, any", 200, member(&Caller::once_any)},
                                      {"profile", 300, member(&Caller::load_profile)},
                                      {"explain", 500, member(&Caller::explain)},
                                      {"failure", 2000, member(&Caller::fail)}};
    calls.insert(calls.end(), others.begin(), others.end());
    for (const std::string& path : files.meshes()) {
        calls.push_back({"mesh" + path.substr(path.rfind('.')), 500,
                         [path](Caller& caller, uint32_t) { return caller.load_mesh(path); }});
    }
    return calls;
}
