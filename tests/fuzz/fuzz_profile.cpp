// Calibration profiles: the input is the file. What is refused is refused for a reason of the header's; what is taken is written
// back as it was read, and whatever its constants are, they change no answer.
#include "fuzz/facts.h"
#include "fuzz/failure.h"
#include "fuzz/memory_file.h"
#include "fuzz/reference.h"
#include "model/profile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <optional>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t room);

namespace raywise::fuzz {
namespace {

constexpr Status refusals[] = {Status::PROFILE_MALFORMED, Status::PROFILE_SCHEMA, Status::PROFILE_EPOCH,
                               Status::PROFILE_RANGE};

// The parser by itself: the profile, or why not.
std::optional<Profile> parse(const std::string& text, Status& status) {
    status = Status::OK;
    try {
        return parse_profile(text);
    } catch (const Error& error) {
        status = error.status();
        demand(std::find(std::begin(refusals), std::end(refusals), status) != std::end(refusals),
               "a profile was refused with a status that is none of a profile's text");
        return std::nullopt;
    }
}

std::string json_of(const rw_profile* profile) {
    std::uint64_t needed = 0;
    demand(rw_profile_text(profile, RW_FORMAT_JSON, nullptr, 0, &needed) == RW_OK, "a profile has no length");
    std::string text(needed, 'x');
    demand(rw_profile_text(profile, RW_FORMAT_JSON, text.data(), needed, nullptr) == RW_OK, "a profile has no text");
    text.pop_back();
    return text;
}

// The file as a program loads it. Null with a status: the generic constants were taken.
rw_profile* load(const MemoryFile& file, const std::string& text, std::int32_t& status) {
    file.write(text.data(), text.size());
    rw_profile* profile = nullptr;
    status = rw_profile_load(file.path().c_str(), &profile);
    demand(profile != nullptr, "rw_profile_load gave no profile");
    rw_profile_info info{};
    info.struct_size = sizeof info;
    demand(rw_profile_inspect(profile, &info) == RW_OK && info.status == status, "a profile tells of another status");
    if (status == RW_OK) {
        demand(info.source == RW_PROFILE_SOURCE_PATH && file.path() == info.path, "a profile from somewhere else");
        return profile;
    }
    demand_printable_message();
    demand(info.source == RW_PROFILE_SOURCE_GENERIC, "a file was refused and used");
    static const std::string generic = to_json(generic_profile());
    demand(json_of(profile) == generic, "a file was refused, and the constants are not the generic ones");
    rw_profile_release(profile);
    return nullptr;
}

// Sheets of triangles one behind the other.
struct Sheets {
    std::vector<float> vertices;
    std::vector<std::uint32_t> indices;
    rw_triangles triangles{};

    explicit Sheets(std::uint32_t side) {
        for (std::uint32_t i = 0; i <= side; ++i) {
            for (std::uint32_t k = 0; k <= side; ++k) {
                vertices.insert(vertices.end(), {static_cast<float>(i), static_cast<float>(k),
                                                 static_cast<float>((i * 7 + k * 5) % 4)});
            }
        }
        for (std::uint32_t i = 0; i < side; ++i) {
            for (std::uint32_t k = 0; k < side; ++k) {
                const std::uint32_t corner = i * (side + 1) + k;
                indices.insert(indices.end(), {corner, corner + 1, corner + side + 1, corner + 1, corner + side + 2,
                                               corner + side + 1});
            }
        }
        triangles.struct_size = sizeof triangles;
        triangles.vertex_count = vertices.size() / 3;
        triangles.vertices.data = vertices.data();
        triangles.triangle_count = indices.size() / 3;
        triangles.indices.data = indices.data();
    }
};

rw_scene* make_scene(const rw_profile* profile, const Sheets& sheets, std::uint64_t rays, std::int32_t effort,
                     std::int32_t rule) {
    rw_scene* scene = nullptr;
    rw_expected_rays expected{};
    expected.struct_size = sizeof expected;
    expected.count = rays;
    expected.kind = static_cast<std::int32_t>(rays % 5);
    demand(rw_scene_create(profile, &scene) == RW_OK, "a scene could not be made");
    Outcome("add_triangles").check(rw_scene_add_triangles(scene, &sheets.triangles, nullptr));
    Outcome("set_expected_rays").check(rw_scene_set_expected_rays(scene, &expected));
    Outcome("set_effort").check(rw_scene_set_effort(scene, effort, rule, 0.0));
    Outcome("commit").check(rw_scene_commit(scene, nullptr));
    return scene;
}

void compare(const rw_scene* judge, const rw_scene* scene, const rw_scene* view) {
    for (int i = 0; i < 24; ++i) {
        rw_ray ray{{0.25 * i, 0.5 * (i % 7), -3.0}, 0, {0.125 * (i % 5), 0.0625 * (i % 3), 1.0}, INFINITY};
        rw_hit wanted;
        rw_hit found;
        rw_hit seen;
        Outcome("intersect").check(rw_scene_intersect(judge, &ray, nullptr, &wanted));
        Outcome("intersect").check(rw_scene_intersect(scene, &ray, nullptr, &found));
        Outcome("intersect").check(rw_scene_intersect(view, &ray, nullptr, &seen));
        demand(std::memcmp(&wanted, &found, sizeof found) == 0 && std::memcmp(&wanted, &seen, sizeof seen) == 0,
               "a profile changed an answer");
    }
}

// Scenes and views decided by the profile, over few and many triangles and rays.
void use(const rw_profile* profile, std::size_t choice) {
    static const Sheets sheets[] = {Sheets(1), Sheets(4), Sheets(12)};
    static constexpr std::uint64_t rays[] = {1, 1000, 1000000, RW_RAYS_LIMIT, RW_RAYS_UNKNOWN};
    static rw_scene* const judges[] = {make_scene(nullptr, sheets[0], 1, 0, 0), make_scene(nullptr, sheets[1], 1, 0, 0),
                                       make_scene(nullptr, sheets[2], 1, 0, 0)};
    const auto take = [&choice](std::size_t count) {
        const std::size_t taken = choice % count;
        choice /= count;
        return taken;
    };
    const std::size_t size = take(3);
    const std::uint64_t count = rays[take(5)];
    const auto rule = static_cast<std::int32_t>(take(2));
    const std::int32_t effort = take(16) == 0 ? RW_EFFORT_MEASURE : RW_EFFORT_ESTIMATE;
    rw_scene* scene = make_scene(profile, sheets[size], count, effort, rule);
    rw_view_options options{};
    options.struct_size = sizeof options;
    options.origin[2] = -3.0;
    options.count = count;
    rw_scene* view = nullptr;
    Outcome("view_create").check(rw_scene_view(scene, &options, nullptr, &view));
    compare(judges[size], scene, view);

    Input input(reinterpret_cast<const std::uint8_t*>(&choice), sizeof choice);
    check_candidates(input, Asked(scene, "a scene"), "");
    check_candidates(input, Asked(view, "a view"), "");
    rw_scene_release(view);
    rw_scene_release(scene);
}

void run(const std::string& text) {
    static const MemoryFile file;
    Status parsed = Status::OK;
    std::optional<Profile> profile = parse(text, parsed);
    std::int32_t status = RW_OK;
    rw_profile* raw = load(file, text, status);
    if (parsed != Status::OK) {
        demand(status == static_cast<std::int32_t>(parsed), "the file was refused otherwise than its text");
        return;
    }
    demand(status == RW_OK || status == RW_PROFILE_MACHINE, "a file was refused whose text is in order");
    rw_profile_release(raw);

    // As if it had been measured here.
    profile->machine = this_machine();
    const std::string written = to_json(*profile);
    demand(to_json(parse_profile(written)) == written, "a profile is not written as it was read");
    rw_profile* mine = load(file, written, status);
    if (mine == nullptr) fail("a profile of this machine was refused: %s", rw_last_error_message());
    demand(json_of(mine) == written, "a profile changes when it is loaded");
    std::size_t choice = std::hash<std::string>()(written);
    Input input(reinterpret_cast<const std::uint8_t*>(&choice), sizeof choice);
    check_texts(input, "profile_text", [&](auto... arguments) { return rw_profile_text(mine, arguments...); });
    use(mine, choice);
    rw_profile_release(mine);
}

// Puts another number in the place of one: bytes changed at random rarely leave a profile in order.
std::size_t change_number(std::string text, std::uint8_t* data, std::size_t room, unsigned seed) {
    static constexpr const char* numbers[] = {"0",
                                              "0.0",
                                              "-0.0",
                                              "1",
                                              "1e-300",
                                              "4.9e-324",
                                              "2.3e-308",
                                              "1e6",
                                              "1e9",
                                              "1e12",
                                              "1e13",
                                              "1e14",
                                              "1e308",
                                              "-1",
                                              "1000",
                                              "1000.1",
                                              "0.001",
                                              "1e-9",
                                              "1e400",
                                              "1048576",
                                              "4294967295",
                                              "18446744073709551615",
                                              "18446744073709551616",
                                              "12.5"};
    std::vector<std::pair<std::size_t, std::size_t>> found; // begin and length
    for (std::size_t i = 1; i < text.size(); ++i) {
        if (text[i - 1] != ' ' && text[i - 1] != ':') continue;
        std::size_t end = i;
        while (end < text.size() && (std::isdigit(static_cast<unsigned char>(text[end])) != 0 ||
                                     std::strchr("+-.eE", text[end]) != nullptr)) {
            if (text[end] == '\0') break;
            ++end;
        }
        if (end > i) found.emplace_back(i, end - i);
    }
    if (found.empty()) return LLVMFuzzerMutate(data, text.size(), room);
    const auto [begin, length] = found[seed / 32 % found.size()];
    text.replace(begin, length, numbers[seed % std::size(numbers)]);
    if (text.size() > room) return LLVMFuzzerMutate(data, std::min(text.size(), room), room);
    std::memcpy(data, text.data(), text.size());
    return text.size();
}

} // namespace
} // namespace raywise::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t room, unsigned seed);

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    setenv("RAYWISE_CALIBRATION", "builtin", 1);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    raywise::fuzz::run(std::string(reinterpret_cast<const char*>(data), size));
    return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t room, unsigned seed) {
    if (seed % 2 == 0) return LLVMFuzzerMutate(data, size, room);
    return raywise::fuzz::change_number(std::string(reinterpret_cast<const char*>(data), size), data, room, seed / 2);
}
