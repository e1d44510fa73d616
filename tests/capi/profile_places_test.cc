// Which profile a process works with, seen through the C ABI: every combination of what RAYWISE_CALIBRATION and the user's cache
// folder may hold, each in a process of its own because the places are looked at once in a process. (The system's folder is beyond
// a test's reach here; tests/model/profile_find_test.cpp has all three.)
#include "model/profile_fixture.h"
#include "testing.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

enum class Content {
    nothing,
    builtin, // RAYWISE_CALIBRATION alone
    missing, // RAYWISE_CALIBRATION alone
    good,
    truncated,
    other_instruction_set
};

const char* name_of(Content content) {
    constexpr const char* names[] = {"nothing", "builtin", "missing", "good", "truncated", "other instruction set"};
    return names[static_cast<int>(content)];
}

void write(const fs::path& path, Content content, double spread) {
    raywise::Profile profile = raywise::sample_profile();
    profile.provenance.spread = spread;
    if (content == Content::other_instruction_set) profile.machine.instruction_set = "OTHER";
    const std::string text = to_json(profile);
    fs::create_directories(path.parent_path());
    std::ofstream(path) << (content == Content::truncated ? text.substr(0, text.size() / 2) : text);
}

bool is_file(Content content) {
    return content == Content::good || content == Content::truncated || content == Content::other_instruction_set;
}

int32_t status_of(Content content) {
    return content == Content::missing                 ? RW_PROFILE_NOT_FOUND
           : content == Content::truncated             ? RW_PROFILE_MALFORMED
           : content == Content::other_instruction_set ? RW_PROFILE_MACHINE
                                                       : RW_OK;
}

template <class Write>
std::string text_of(const Write& write) {
    uint64_t needed = 0;
    CHECK_OK(write(nullptr, 0, &needed));
    std::string text(needed, '\0');
    CHECK_OK(write(text.data(), needed, &needed));
    text.pop_back();
    return text;
}

struct Expected {
    int32_t source = RW_PROFILE_SOURCE_GENERIC;
    const char* word = "generic"; // in explain's JSON
    std::string path;
    int32_t status = RW_OK;
    std::string passed_over;
};

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

void check_profile(const rw_profile* profile, const Expected& expected) {
    rw_profile_info info{};
    info.struct_size = sizeof info;
    CHECK_OK(rw_profile_inspect(profile, &info));
    CHECK(info.source == expected.source && info.status == expected.status);
    CHECK(info.path == expected.path);
    const bool is_generic = expected.source == RW_PROFILE_SOURCE_GENERIC;
    CHECK((std::string(info.machine) == "generic") == is_generic);
    const std::string text =
        text_of([&](char* b, uint64_t c, uint64_t* n) { return rw_profile_text(profile, RW_FORMAT_TEXT, b, c, n); });
    CHECK(holds(text, "generic constants") == is_generic);
    CHECK(holds(text, "passed over") == (expected.status != RW_OK));
    CHECK(holds(text, expected.path));
    CHECK(holds(text, expected.passed_over.substr(0, expected.passed_over.find(": ")))); // lines break at blanks
    // In words that are true whatever was used instead.
    CHECK(!holds(rw_status_text(info.status), "generic"));
    CHECK(holds(rw_status_text(info.status), "passed over") == (expected.status != RW_OK));
}

void check_scene(const Expected& expected) {
    rw_scene* scene = nullptr;
    NEED_OK(rw_scene_create(nullptr, &scene));
    NEED_OK(rw_scene_commit(scene, nullptr));
    const auto explain = [&](int32_t format) {
        return text_of([&](char* b, uint64_t c, uint64_t* n) { return rw_scene_explain(scene, format, b, c, n); });
    };
    const std::string text = explain(RW_FORMAT_TEXT);
    CHECK(holds(text, std::string("calibration: ") + expected.word + ", measured "));
    CHECK(holds(text, "profile: " + expected.path + "\n") == !expected.path.empty());
    CHECK(holds(text, "passed over: " + expected.passed_over) == (expected.status != RW_OK));
    const auto calibration = nlohmann::json::parse(explain(RW_FORMAT_JSON)).at("calibration");
    CHECK(calibration.at("source") == expected.word);
    CHECK(calibration.at("path") == expected.path);
    CHECK(calibration.at("status") == expected.status);
    CHECK(holds(calibration.at("reason"), expected.passed_over));
    CHECK_OK(rw_scene_release(scene));
}

void check_process(const fs::path& folder, Content environment, Content user) {
    const fs::path named = folder / "named.json";
    const fs::path own = folder / "raywise" / (raywise::this_machine().key() + ".json");
    if (is_file(environment)) write(named, environment, 0.125);
    if (is_file(user)) write(own, user, 0.25);
    setenv("XDG_CACHE_HOME", folder.c_str(), 1);
    unsetenv("RAYWISE_CALIBRATION");
    if (environment == Content::builtin) setenv("RAYWISE_CALIBRATION", "builtin", 1);
    if (is_file(environment) || environment == Content::missing) setenv("RAYWISE_CALIBRATION", named.c_str(), 1);

    Expected expected;
    expected.status = status_of(environment);
    if (expected.status != RW_OK) expected.passed_over = named.string() + ": ";
    if (environment == Content::good) {
        expected.source = RW_PROFILE_SOURCE_ENV;
        expected.word = "environment";
        expected.path = named.string();
    } else if (environment != Content::builtin && user == Content::good) {
        expected.source = RW_PROFILE_SOURCE_USER;
        expected.word = "user";
        expected.path = own.string();
    } else if (environment != Content::builtin && expected.status == RW_OK) {
        expected.status = status_of(user);
        if (expected.status != RW_OK) expected.passed_over = own.string() + ": ";
    }

    check_scene(expected);
    // The files change and the environment with them; the process keeps what it has found.
    rw_profile* profile = nullptr;
    CHECK(rw_profile_load(nullptr, &profile) == expected.status);
    if (expected.status != RW_OK) CHECK(holds(rw_last_error_message(), expected.passed_over));
    check_profile(profile, expected);
    CHECK_OK(rw_profile_release(profile));
    setenv("RAYWISE_CALIBRATION", "builtin", 1);
    write(named, Content::good, 0.5);
    fs::remove(own);
    CHECK(rw_profile_load(nullptr, &profile) == expected.status);
    check_profile(profile, expected);
    CHECK_OK(rw_profile_release(profile));
    check_scene(expected);
    // A path is read anew.
    for (const double spread : {0.5, 0.75}) {
        write(named, Content::good, spread);
        rw_profile_info info{};
        info.struct_size = sizeof info;
        CHECK_OK(rw_profile_load(named.c_str(), &profile));
        CHECK_OK(rw_profile_inspect(profile, &info));
        CHECK(info.source == RW_PROFILE_SOURCE_PATH && info.status == RW_OK && info.spread == spread);
        CHECK_OK(rw_profile_release(profile));
    }
    write(named, Content::other_instruction_set, 0.5);
    CHECK_ERROR(rw_profile_load(named.c_str(), &profile), RW_PROFILE_MACHINE,
                "named.json|machine.instruction_set|\"OTHER\"|this machine");
    CHECK_OK(rw_profile_release(profile));
}

void in_a_process(Content environment, Content user) {
    char folder[] = "/tmp/raywise-places-XXXXXX";
    if (mkdtemp(folder) == nullptr) exit(1);
    const pid_t child = fork();
    if (child == 0) {
        failures = 0;
        check_process(folder, environment, user);
        fflush(nullptr);
        _exit(failures != 0);
    }
    int end = 1;
    if (child < 0 || waitpid(child, &end, 0) != child) exit(1);
    fs::remove_all(folder);
    const std::string what = std::string("RAYWISE_CALIBRATION: ") + name_of(environment) + ", user: " + name_of(user);
    check_that(end == 0, what.c_str(), __FILE__, __LINE__);
}

} // namespace

int main() {
    use_all_helpers();
    for (const Content environment : {Content::nothing, Content::builtin, Content::missing, Content::good,
                                      Content::truncated, Content::other_instruction_set}) {
        for (const Content user : {Content::nothing, Content::good, Content::truncated, Content::other_instruction_set})
            in_a_process(environment, user);
    }
    return finish("profile places");
}
