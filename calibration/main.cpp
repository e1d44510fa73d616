// raywise-calibrate: measures this machine for libraywise, and tells what was measured.
#include "commands.h"

#include "measure/library.h"
#include "model/machine.h"
#include "model/profile.h"

#include "raywise/raywise.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <new>
#include <string>
#include <vector>

namespace raywise::calibration {

std::string tool_name() {
    return "raywise-calibrate " + std::to_string(RW_VERSION_MAJOR) + "." + std::to_string(RW_VERSION_MINOR) + "." +
           std::to_string(RW_VERSION_PATCH);
}

void complain(const std::string& message) { std::fprintf(stderr, "raywise-calibrate: %s\n", message.c_str()); }

namespace {

std::string version_text() {
    std::uint32_t major = 0, minor = 0, patch = 0;
    check(rw_version(&major, &minor, &patch), "rw_version");
    return tool_name() + ", libraywise " + std::to_string(major) + "." + std::to_string(minor) + "." +
           std::to_string(patch);
}

// Of this machine, for --help.
std::string user_path_text() {
    const std::filesystem::path path = user_profile_path(this_machine());
    return path.empty() ? "(none: HOME is not set)" : path.string();
}

std::string footer() {
    return "Profiles are looked for in this order; the first valid one is used:\n"
           "  1. the file named by RAYWISE_CALIBRATION (\"builtin\" means the generic constants)\n"
           "  2. " +
           user_path_text() +
           "\n"
           "  3. " +
           system_profile_path(this_machine()).string() +
           "\n"
           "  4. generic constants, compiled in\n"
           "A profile changes how long things take, never an answer.\n"
           "\n"
           "Exit codes: 0 all is well; 1 it failed, or check found no valid profile; 2 wrong command\n"
           "line; 3 measured, but the machine was too noisy to save it.\n"
           "\n"
           "raywise-calibrate COMMAND --help tells more about a command. Without a command: measure.\n";
}

// The command line as it could be typed again, without control characters.
std::string command_line(int argc, char** argv) {
    std::string line = "raywise-calibrate";
    for (int i = 1; i < argc; ++i) line += std::string(" ") + argv[i];
    for (char& c : line) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
    }
    return line.substr(0, 500);
}

CLI::App* add_measure(CLI::App& app, MeasureOptions& options) {
    CLI::App* command = app.add_subcommand("measure", "measure this machine and save the profile");
    CLI::Option* quick_flag = command->add_flag("--quick", "a few seconds (the default)");
    command->add_flag("--full", options.full, "some minutes: more scenes, sizes and repetitions")->excludes(quick_flag);
    command->add_option("--time-limit", options.time_limit, "start no further scene after so many seconds")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.1, 86400.0));
    command->add_option("--threads", options.threads, "threads for builds and rays; constants are meant for 1")
        ->type_name("N")
        ->check(CLI::Range(1u, 4096u))
        ->capture_default_str();
    CLI::Option* output =
        command->add_option("--output,-o", options.output, "write to this file instead")->type_name("FILE");
    command->add_flag("--system", options.system, "write for all users, into /etc/raywise")->excludes(output);
    command->add_flag("--force", options.force, "save even what a noisy machine has measured");
    command->add_flag("--json", options.json, "print the result as JSON");
    command->add_flag("--quiet,-q", options.quiet, "print nothing but errors");
    command->footer("Writes " + user_path_text() +
                    "\n"
                    "unless --output or --system says otherwise. Leave the machine alone meanwhile: when repeated\n"
                    "timings differ too much, other programs take too much of it or its clock changes, nothing\n"
                    "is saved without --force (exit code 3). An interrupted run leaves nothing behind.\n");
    return command;
}

CLI::App* add_show(CLI::App& app, ShowOptions& options) {
    CLI::App* command = app.add_subcommand("show", "print a profile as a table");
    command->add_option("file", options.file, "the profile (default: the one in use)")->type_name("FILE");
    command->add_flag("--json", options.json, "print the file's own format");
    return command;
}

CLI::App* add_check(CLI::App& app, CheckOptions& options) {
    CLI::App* command = app.add_subcommand("check", "is there a valid profile for this machine? exit code 0 or 1");
    command->add_option("file", options.file, "the profile (default: where the library looks)")->type_name("FILE");
    return command;
}

CLI::App* add_explain(CLI::App& app, ExplainOptions& options, std::string& rays) {
    const std::map<std::string, std::int32_t> kinds = {{"any", RW_RAYS_ANY_KIND},
                                                       {"random", RW_RAYS_RANDOM},
                                                       {"camera", RW_RAYS_CAMERA},
                                                       {"shadow", RW_RAYS_SHADOW},
                                                       {"diffuse", RW_RAYS_DIFFUSE}};
    CLI::App* command = app.add_subcommand("explain", "what would the library build for a mesh, and why?");
    command->add_option("mesh", options.mesh, "an OBJ, PLY, OFF or STL file")->type_name("MESH")->required();
    command
        ->add_option(
            "--rays", rays,
            "how many rays are expected: a number, or \"unknown\";\nwithout it: what is chosen for 1, 10 ... 10^8 rays")
        ->type_name("N");
    command->add_option("--kind", options.kind, "any, random, camera, shadow or diffuse (default any)")
        ->type_name("KIND")
        ->transform(CLI::CheckedTransformer(kinds).description(""));
    command->add_flag("--json", options.json, "print JSON");
    return command;
}

std::uint64_t parse_rays(const std::string& text) {
    if (text == "unknown") return RW_RAYS_UNKNOWN;
    std::uint64_t count = 0;
    const bool digits = !text.empty() && text.size() <= 16 && text.find_first_not_of("0123456789") == std::string::npos;
    if (digits) count = std::stoull(text);
    if (count < 1 || count > RW_RAYS_LIMIT) {
        throw CLI::ValidationError("--rays",
                                   "\"" + text + "\" is neither \"unknown\" nor a whole number from 1 to 10^15");
    }
    return count;
}

int run(int argc, char** argv) {
    CLI::App app(
        "Measures what each structure of libraywise costs on this machine, once, so that the library\n"
        "can choose among them.");
    app.name("raywise-calibrate");
    app.get_formatter()->column_width(26);
    app.set_version_flag("--version", version_text());
    app.require_subcommand(1);
    app.footer(footer());

    MeasureOptions measure_options;
    ShowOptions show_options;
    CheckOptions check_options;
    ExplainOptions explain_options;
    std::string rays;
    CLI::App* measure_command = add_measure(app, measure_options);
    CLI::App* show_command = add_show(app, show_options);
    CLI::App* check_command = add_check(app, check_options);
    add_explain(app, explain_options, rays);
    measure_options.command = command_line(argc, argv);

    try {
        // Options without a command belong to measure: `raywise-calibrate` alone does what it was called for.
        std::vector<std::string> arguments(argv + 1, argv + argc);
        const bool no_command = arguments.empty() || arguments[0].rfind("-", 0) == 0;
        const bool about_all =
            !arguments.empty() && (arguments[0] == "-h" || arguments[0] == "--help" || arguments[0] == "--version");
        if (no_command && !about_all) arguments.insert(arguments.begin(), "measure");
        std::reverse(arguments.begin(), arguments.end()); // as CLI11 wants them
        app.parse(std::move(arguments));
        if (!rays.empty()) explain_options.rays = parse_rays(rays);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_ok : exit_usage;
    }
    if (measure_command->parsed()) return run_measure(measure_options);
    if (show_command->parsed()) return run_show(show_options);
    if (check_command->parsed()) return run_check(check_options);
    return run_explain(explain_options);
}

} // namespace
} // namespace raywise::calibration

int main(int argc, char** argv) {
    using namespace raywise::calibration;
    try {
        return run(argc, argv);
    } catch (const std::bad_alloc&) {
        complain("out of memory");
    } catch (const std::exception& error) {
        complain(error.what());
    }
    return exit_failed;
}
