#include "commands.h"
#include "measure/measure.h"
#include "model/profile.h"
#include "progress_bar.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <ctime>

namespace raywise::calibration {
namespace {

// Lines through fewer sizes than this are drawn by chance.
constexpr std::size_t fewest_sizes = 3;

std::string utc_now() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    ::gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

std::filesystem::path destination(const MeasureOptions& options) {
    std::filesystem::path path = options.output;
    if (options.system) path = system_profile_path(this_machine());
    if (path.empty()) path = user_profile_path(this_machine());
    if (path.empty())
        throw std::runtime_error("neither XDG_CACHE_HOME nor HOME is an absolute path; name a file with --output");
    std::error_code error;
    const std::filesystem::file_status there = std::filesystem::status(path, error);
    if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there)) {
        throw std::runtime_error(path.string() + ": is there and not a plain file");
    }
    return path;
}

void print_json(const Profile& profile, const MeasureResult& result, const std::vector<std::string>& noisy,
                const std::filesystem::path& path, bool saved) {
    nlohmann::ordered_json document = {
        {"saved", saved},
        {"path", saved ? path.string() : ""},
        {"complaints", noisy},
        {"seconds", result.seconds},
        {"meshes", result.meshes},
        {"out_of_time", result.out_of_time},
        {"noise",
         {{"spread", result.noise.spread},
          {"drift", result.noise.drift},
          {"others", result.noise.others},
          {"stolen", result.noise.stolen}}},
        {"profile", nlohmann::ordered_json::parse(to_json(profile))},
    };
    std::printf("%s\n", document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

} // namespace

int run_measure(const MeasureOptions& options) {
    const std::filesystem::path path = destination(options); // before minutes are spent
    Plan plan = options.full ? full_plan() : quick_plan();
    if (options.time_limit > 0.0) plan.time_limit = options.time_limit;

    if (!options.quiet && !options.json) {
        std::printf("Measuring %s (%s), %s.\n", this_machine().brand.c_str(), this_machine().key().c_str(),
                    options.full ? "full: some minutes" : "quick: a few seconds");
        std::fflush(stdout);
    }
    ProgressBar bar(options.quiet);
    const MeasureResult result =
        measure(plan, options.threads, [&](double fraction, const std::string& stage) { bar.show(fraction, stage); });
    bar.finish();
    if (!suffices(result.measurements, fewest_sizes)) {
        complain("the time limit left only " + std::to_string(result.meshes) + " of " +
                 std::to_string(plan.meshes.size()) + " scenes, too few for a profile; nothing was saved");
        return exit_failed;
    }

    Profile profile;
    profile.machine = this_machine();
    profile.provenance = {tool_name(), options.command, utc_now(), plan.mode, result.noise.spread, result.seconds};
    profile.constants = fit(result.measurements);

    const std::vector<std::string> noisy = complaints(result.noise);
    const bool save = noisy.empty() || options.force;
    if (save) save_profile(profile, path);

    if (options.json) {
        print_json(profile, result, noisy, path, save);
    } else if (!options.quiet) {
        std::printf("Measured %zu scenes in %.1f s; spread of repeated timings %.1f %%.\n", result.meshes,
                    result.seconds, result.noise.spread * 100.0);
        if (save) std::printf("Saved %s\n", path.c_str());
    }
    if (save) return exit_ok;
    for (const std::string& complaint : noisy) complain("too noisy: " + complaint);
    complain("nothing was saved; try again when the machine is quiet, or save all the same with --force");
    return exit_too_noisy;
}

} // namespace raywise::calibration
