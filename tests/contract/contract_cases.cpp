// contract_cases: puts raywise, structure by structure, before the hard cases.
#include "contract/case_json.h"
#include "contract/case_table.h"
#include "contract/check_cases.h"
#include "contract/raywise_library.h"
#include "contract/run_cases.h"

#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

namespace raywise::contract {
namespace {

struct Options {
    std::string cases = case_folder().string();
    std::vector<std::string> structures;
    std::vector<std::string> families;
    bool list = false;
    bool check = false;
    std::uint64_t sweep_factor = 1;
    std::string json;
    std::string export_file;
    std::string command;
};

void write(const std::string& path, const nlohmann::ordered_json& json) {
    std::ofstream stream(path, std::ios::binary);
    stream << json.dump() << '\n';
    stream.flush();
    if (!stream) throw std::runtime_error(path + ": cannot be written");
}

template <class Known>
void insist_on_known(const std::vector<std::string>& wanted, const Known& known, const char* what) {
    for (const std::string& name : wanted) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        std::string text = std::string("no ") + what + " is called " + name + "; there are";
        for (const std::string& other : known) text += " " + other;
        throw std::runtime_error(text);
    }
}

std::vector<Family> wanted_families(const Options& options) {
    std::vector<Family> families = read_case_folder(options.cases);
    if (options.families.empty()) return families;
    std::vector<std::string> names;
    for (const Family& family : families) names.push_back(family.name);
    insist_on_known(options.families, names, "family");
    families.erase(std::remove_if(families.begin(), families.end(),
                                  [&](const Family& family) {
                                      return std::find(options.families.begin(), options.families.end(), family.name) ==
                                             options.families.end();
                                  }),
                   families.end());
    return families;
}

// "bvh" for the library "raywise bvh".
std::string structure_of(const Library& library) { return library.name().substr(library.name().find(' ') + 1); }

std::vector<std::unique_ptr<Library>> wanted_libraries(const Options& options) {
    std::vector<std::unique_ptr<Library>> libraries = raywise_libraries();
    if (options.structures.empty()) return libraries;
    std::vector<std::string> names;
    for (const auto& library : libraries) names.push_back(structure_of(*library));
    insist_on_known(options.structures, names, "structure");
    libraries.erase(std::remove_if(libraries.begin(), libraries.end(),
                                   [&](const std::unique_ptr<Library>& library) {
                                       return std::find(options.structures.begin(), options.structures.end(),
                                                        structure_of(*library)) == options.structures.end();
                                   }),
                    libraries.end());
    return libraries;
}

void list(const std::vector<Family>& families) {
    for (const Family& family : families) {
        std::printf("%s: %s\n", family.name.c_str(), family.about.c_str());
        for (const Case& source : family.cases) {
            std::printf("    %s (%s): %s\n", source.name.c_str(), source.float32 ? "float32" : "float64",
                        source.about.c_str());
        }
    }
}

bool files_are_sound(const std::vector<Family>& families, std::uint64_t sweep_factor) {
    const std::vector<std::string> faults = faults_of(families, sweep_factor);
    for (const std::string& fault : faults) std::printf("%s\n", fault.c_str());
    std::size_t cases = 0;
    for (const Family& family : families) cases += family.cases.size();
    std::printf("%zu cases in %zu files before the exact judge: %zu faults\n", cases, families.size(), faults.size());
    return faults.empty();
}

bool all_pass(const Options& options, const std::vector<Family>& families) {
    const bool terminal = isatty(fileno(stderr)) == 1;
    std::vector<LibraryResult> results;
    for (const auto& library : wanted_libraries(options)) {
        RunOptions run;
        run.sweep_factor = options.sweep_factor;
        if (terminal) {
            run.begins = [&](const std::string& family) {
                std::fprintf(stderr, "\r\033[K%s: %s", library->name().c_str(), family.c_str());
            };
        }
        results.push_back(run_cases(*library, families, run));
    }
    if (terminal) std::fprintf(stderr, "\r\033[K");
    std::fputs(table_of(results).c_str(), stdout);
    const nlohmann::ordered_json report = report_of(results);
    const auto& summary = report["summary"];
    std::printf("hard cases passed by all: %s of %s\n", summary["hard_cases_passed"].dump().c_str(),
                summary["hard_cases"].dump().c_str());
    if (!options.json.empty()) {
        nlohmann::ordered_json json = {{"target", "contract-cases"}, {"command", options.command}};
        json.update(report);
        write(options.json, json);
    }
    return std::all_of(results.begin(), results.end(),
                       [](const LibraryResult& result) { return result.count(Outcome::failed) == 0; });
}

int run(int argc, char** argv) {
    Options options;
    CLI::App app(
        "Puts raywise, structure by structure and through views, before the hard cases, and prints how\n"
        "many each passes. Exit code: 0 when all pass, 1 when not, 2 for a wrong command line or case file.");
    app.name("contract_cases");
    app.get_formatter()->column_width(28);
    app.add_option("--cases", options.cases, "folder of case files (default: the repository's)")->type_name("FOLDER");
    app.add_option("--structure", options.structures, "only this one, or \"view\"; may be repeated")->type_name("NAME");
    app.add_option("--family", options.families, "only this one; may be repeated")->type_name("NAME");
    app.add_option("--sweep-factor", options.sweep_factor, "times as many rays in every sweep")
        ->type_name("N")
        ->check(CLI::Range(1u, 100000u));
    app.add_option("--json", options.json, "write the results to this file")->type_name("FILE");
    app.add_flag("--list", options.list, "list the cases and do nothing else");
    app.add_flag("--check", options.check, "put the case files before the exact judge and do nothing else");
    app.add_option("--export", options.export_file, "write all cases in full as JSON and do nothing else")
        ->type_name("FILE");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    options.command = "contract_cases";
    for (int i = 1; i < argc; ++i) options.command += std::string(" ") + argv[i];

    const std::vector<Family> families = wanted_families(options);
    if (options.list) {
        list(families);
        return 0;
    }
    if (options.check) return files_are_sound(families, options.sweep_factor) ? 0 : 1;
    if (!options.export_file.empty()) {
        write(options.export_file, export_of(families, options.sweep_factor));
        return 0;
    }
    return all_pass(options, families) ? 0 : 1;
}

} // namespace
} // namespace raywise::contract

int main(int argc, char** argv) {
    try {
        return raywise::contract::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "contract_cases: %s\n", error.what());
        return 2;
    }
}
