// Texts and files are the same in every locale of the host program, C's and C++'s: one with a decimal comma and points between
// thousands, and one whose decimal separator takes two bytes. The locales are made here, so that no machine lacks them.
#include "testing.h"

#include <clocale>
#include <cstdlib>
#include <fstream>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

#include <sys/stat.h>

namespace {

std::string folder;

std::string write(const char* name, const std::string& content) {
    const std::string path = folder + "/" + name;
    std::ofstream(path) << content;
    return path;
}

template <class Write>
std::string text_of(const Write& write_text) {
    uint64_t needed = 0;
    CHECK_OK(write_text(nullptr, 0, &needed));
    std::string text(needed, '\0');
    CHECK_OK(write_text(text.data(), needed, &needed));
    return text;
}

// As digits of a fixed form: reading them wrongly shows.
void add_mesh(std::string& all, const std::string& path) {
    rw_mesh* mesh = nullptr;
    if (!CHECK_OK(rw_mesh_load(path.c_str(), &mesh))) return;
    rw_triangles t{};
    t.struct_size = sizeof t;
    CHECK_OK(rw_mesh_triangles(mesh, &t));
    all.append(static_cast<const char*>(t.vertices.data), t.vertex_count * 3 * sizeof(float));
    CHECK_OK(rw_mesh_release(mesh));
}

void add_error(std::string& all, int32_t status) {
    CHECK(status != RW_OK);
    all += std::string(rw_last_error_message()) + "\n" + rw_status_text(status) + "\n";
}

struct Files {
    std::vector<std::string> meshes;
    std::string profile;
    std::string bad_profile;
};

Files write_files(const std::string& profile_json) {
    Files files;
    files.meshes = {
        write("a.obj", "v 0.5 0.25 1e-1\nv 1234.5 0 0.125\nv 0 7.75 0\nf 1 2 3\n"),
        write("a.off", "OFF\n3 1 0\n0.5 0.25 1e-1\n1234.5 0 0.125\n0 7.75 0\n3 0 1 2\n"),
        write("a.ply",
              "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
              "0.5 0.25 1e-1\n1234.5 0 0.125\n0 7.75 0\n3 0 1 2\n"),
        write("a.stl",
              "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0.5 0.25 1e-1\nvertex 1234.5 0 0.125\n"
              "vertex 0 7.75 0\nendloop\nendfacet\nendsolid a\n"),
    };
    files.profile = write("profile.json", profile_json);
    std::string bad = profile_json;
    const std::size_t spread = bad.find("\"spread\": ");
    bad.replace(spread, bad.find_first_of(",\n", spread) - spread, "\"spread\": -1234.5");
    files.bad_profile = write("bad.json", bad);
    return files;
}

// Whatever the library says and reads.
std::string everything(const rw_scene* scene, const Files& files) {
    std::string all;
    for (const int32_t format : {RW_FORMAT_TEXT, RW_FORMAT_JSON}) {
        all += text_of([&](char* b, uint64_t c, uint64_t* n) { return rw_scene_explain(scene, format, b, c, n); });
        for (const std::string& path : {files.profile, files.bad_profile}) {
            rw_profile* profile = nullptr;
            const int32_t status = rw_profile_load(path.c_str(), &profile); // of another machine, or out of range
            CHECK(status == RW_OK || status == RW_PROFILE_MACHINE || status == RW_PROFILE_RANGE);
            if (status != RW_OK) add_error(all, status);
            all += text_of([&](char* b, uint64_t c, uint64_t* n) { return rw_profile_text(profile, format, b, c, n); });
            CHECK_OK(rw_profile_release(profile));
        }
    }
    for (const std::string& path : files.meshes) add_mesh(all, path);
    rw_mesh* mesh = nullptr;
    add_error(all, rw_mesh_load((folder + "/missing.obj").c_str(), &mesh));
    add_error(all, rw_mesh_load((folder + "/no\x01such\x01").c_str(), &mesh));
    rw_scene* view = nullptr;
    rw_view_options options{};
    options.struct_size = sizeof options;
    options.count = 1234567;
    options.half_angle = 1234.5;
    add_error(all, rw_scene_view(scene, &options, nullptr, &view));
    return all;
}

// Scenes of which every figure is known beforehand, and none is timed twice.
rw_scene* make_explained_scene() {
    soup s = make_soup(12345);
    rw_scene* scene = make_scene(&s, "uniform_grid");
    free_soup(&s);
    return scene;
}

void use_locale(const char* source, const char* name) {
    const std::string made = folder + "/" + name;
    CHECK(std::system(("localedef -i " + std::string(source) + " -f UTF-8 " + made).c_str()) == 0);
    if (!CHECK(std::setlocale(LC_ALL, name) != nullptr)) exit(1);
    std::locale::global(std::locale(name));
    char text[32];
    snprintf(text, sizeof text, "%.1f", 1.5);
    CHECK(std::string(text) != "1.5"); // the locale is in force
    std::ostringstream stream;
    stream << 1.5;
    CHECK(stream.str() != "1.5");
}

} // namespace

int main() {
    use_all_helpers();
    char pattern[] = "/tmp/raywise-locale-XXXXXX";
    if (mkdtemp(pattern) == nullptr) return 1;
    folder = pattern;
    setenv("LOCPATH", pattern, 1);

    rw_profile* profile = nullptr;
    NEED_OK(rw_profile_load(nullptr, &profile));
    const Files files = write_files(text_of([&](char* b, uint64_t c, uint64_t* n) {
                                        return rw_profile_text(profile, RW_FORMAT_JSON, b, c, n);
                                    }).c_str());
    CHECK_OK(rw_profile_release(profile));
    rw_scene* scene = make_explained_scene();
    const std::string plain = everything(scene, files);
    CHECK(plain.find("12,345 triangles") != std::string::npos); // the library's own grouping, which is no locale's
    CHECK(plain.find("-1234.5") != std::string::npos);

    for (const auto& [source, name] : {std::pair("de_DE", "de_DE.UTF-8"), std::pair("ps_AF", "ps_AF.UTF-8")}) {
        use_locale(source, name);
        CHECK(everything(scene, files) == plain);
        // What has been made under it is of the same sizes and choices as well.
        rw_scene* other = make_explained_scene();
        rw_scene_statistics here{}, there{};
        here.struct_size = there.struct_size = sizeof here;
        CHECK_OK(rw_scene_get_statistics(other, &here));
        CHECK_OK(rw_scene_get_statistics(scene, &there));
        CHECK(here.structure_bytes == there.structure_bytes);
        CHECK_OK(rw_scene_release(other));
        // The host's locale is as it was.
        CHECK(std::string(std::setlocale(LC_ALL, nullptr)) == name && std::locale().name() == name);
        char text[32];
        snprintf(text, sizeof text, "%.1f", 1.5);
        CHECK(std::string(text) != "1.5");
    }
    CHECK_OK(rw_scene_release(scene));
    std::setlocale(LC_ALL, "C");
    std::locale::global(std::locale::classic());
    if (std::system(("rm -rf " + folder).c_str()) != 0) return 1;
    return finish("locale");
}
