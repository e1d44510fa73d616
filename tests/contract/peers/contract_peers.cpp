// contract_peers: the hard cases before other libraries, each in a process of its own, and before raywise.
#include "contract/case_table.h"
#include "contract/peers/peer_list.h"
#include "contract/peers/peer_process.h"
#include "contract/peers/peers_report.h"
#include "contract/peers/server.h"
#include "contract/raywise_library.h"
#include "raywise/raywise.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <unistd.h>

namespace raywise::contract {
namespace {

// A query of a sane library takes milliseconds at most; importing and building in Python takes seconds, on a busy machine many.
constexpr unsigned default_seconds = 60;
// What loops over nonsense must not take the machine's memory with it.
constexpr std::uint64_t most_memory = std::uint64_t{8} << 30;

struct Options {
    std::string program;
    std::string cases = case_folder().string();
    std::vector<std::string> peers;
    std::string serve;
    std::string python;
    std::string python_script = RAYWISE_PYTHON_PEERS;
    std::uint64_t most_sweep_rays = 0;
    unsigned seconds = default_seconds;
    std::string log = "contract_peers.log";
    std::string json;
    std::string page;
    sweep::ReportHead head;
};

std::string raywise_version() {
    std::uint32_t major = 0, minor = 0, patch = 0;
    rw_version(&major, &minor, &patch);
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

void write(const std::string& path, const std::string& text) {
    if (const auto folder = std::filesystem::path(path).parent_path(); !folder.empty())
        std::filesystem::create_directories(folder);
    std::ofstream stream(path, std::ios::binary);
    stream << text;
    stream.flush();
    if (!stream) throw std::runtime_error(path + ": cannot be written");
}

LibraryResult run(Library& library, const std::vector<Family>& families, const Options& options) {
    static const bool terminal = isatty(fileno(stderr)) == 1;
    RunOptions how;
    how.most_sweep_rays = options.most_sweep_rays;
    if (terminal) {
        how.begins = [&](const std::string& family) {
            std::fprintf(stderr, "\r\033[K%s: %s", library.name().c_str(), family.c_str());
        };
    }
    LibraryResult result = run_cases(library, families, how);
    if (terminal) std::fprintf(stderr, "\r\033[K");
    std::printf("%s: %llu passed, %llu failed, %llu not applicable\n", library.name().c_str(),
                static_cast<unsigned long long>(result.count(Outcome::passed)),
                static_cast<unsigned long long>(result.count(Outcome::failed)),
                static_cast<unsigned long long>(result.count(Outcome::skipped)));
    std::fflush(stdout);
    return result;
}

Entrant raywise_entrant(const std::vector<Family>& families, const Options& options) {
    std::vector<LibraryResult> forms;
    for (const auto& library : raywise_libraries()) forms.push_back(run(*library, families, options));
    return {
        raywise_version(),
        "Through its C ABI: every structure, forced by name, and views. float64, or float32 where the case says so.",
        "", together("raywise", forms)};
}

Entrant entrant_of(const Peer& peer, const std::vector<Family>& families, const Options& options) {
    const std::vector<std::string> command =
        peer.in_python() ? std::vector<std::string>{options.python, options.python_script, peer.key}
                         : std::vector<std::string>{options.program, "--serve", peer.key};
    PeerProcess process(command, {std::chrono::seconds(options.seconds), most_memory}, options.log);
    LibraryResult result = run(process, families, options);
    return {process.version(), peer.note, peer.why, std::move(result)};
}

std::vector<const Peer*> wanted_peers(const Options& options) {
    std::vector<const Peer*> wanted;
    for (const Peer& peer : peers()) {
        const bool named = std::find(options.peers.begin(), options.peers.end(), peer.key) != options.peers.end();
        if (!options.peers.empty() && !named) continue;
        if (peer.in_python() && options.python.empty())
            throw std::runtime_error(std::string(peer.key) + " needs --python");
        wanted.push_back(&peer);
    }
    return wanted;
}

void compare(const Options& options) {
    const std::vector<Family> families = read_case_folder(options.cases);
    const std::vector<const Peer*> wanted = wanted_peers(options);
    std::filesystem::remove(options.log);
    std::vector<Entrant> entrants = {raywise_entrant(families, options)};
    for (const Peer* peer : wanted) entrants.push_back(entrant_of(*peer, families, options));

    std::vector<LibraryResult> results;
    for (const Entrant& entrant : entrants) results.push_back(entrant.result);
    std::printf("\n%s", table_of(results).c_str());
    if (!options.json.empty()) sweep::write_json(options.json, peers_json(options.head, entrants));
    if (!options.page.empty()) write(options.page, page_of(options.head, families, entrants));
}

void serve_peer(const Peer& peer) {
    if (peer.in_python()) throw std::runtime_error(std::string(peer.key) + " is served by python_peers.py");
    // Replies go to the descriptor that was standard output; whatever the library prints goes to standard error.
    const int replies = dup(STDOUT_FILENO);
    if (replies < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) throw std::runtime_error("no descriptor for replies");
    const auto library = peer.make();
    serve(*library, peer.version(), STDIN_FILENO, replies);
}

int run(int argc, char** argv) {
    Options options;
    options.program = std::filesystem::read_symlink("/proc/self/exe").string();
    CLI::App app(
        "Puts other libraries before the hard cases, and raywise, and prints how many each passes.\n"
        "A benchmark: what a library fails is a result. Exit code: 0 when the run came to its end,\n"
        "2 for a wrong command line or case file, or a library that does not start.");
    app.name("contract_peers");
    app.get_formatter()->column_width(28);
    app.add_option("--cases", options.cases, "folder of case files (default: the repository's)")->type_name("FOLDER");
    app.add_option("--peer", options.peers, "only this one beside raywise; may be repeated")->type_name("NAME");
    app.add_option("--python", options.python, "a Python that has trimesh and embreex")->type_name("PROGRAM");
    app.add_option("--most-sweep-rays", options.most_sweep_rays, "so many rays of each sweep at most")->type_name("N");
    app.add_option("--seconds", options.seconds, "how long an answer may take (default: 60)")
        ->type_name("N")
        ->check(CLI::Range(1u, 3600u));
    app.add_option("--log", options.log, "what the libraries print (default: contract_peers.log)")->type_name("FILE");
    app.add_option("--json", options.json, "write the results to this file")->type_name("FILE");
    app.add_option("--page", options.page, "write the page for docs/ to this file")->type_name("FILE");
    app.add_option("--commit", options.head.commit, "for the reports: what was built")->type_name("NAME");
    app.add_option("--command", options.head.command, "for the reports: what was typed")->type_name("TEXT");
    app.add_option("--serve", options.serve, "answer requests on standard input with this peer, and do nothing else")
        ->type_name("NAME");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }

    std::string known;
    for (const Peer& peer : peers()) known += std::string(" ") + peer.key;
    for (const std::string& name : options.serve.empty() ? options.peers : std::vector<std::string>{options.serve}) {
        if (!peer_named(name)) throw std::runtime_error("no peer is called " + name + "; there are" + known);
    }
    if (!options.serve.empty()) {
        serve_peer(*peer_named(options.serve));
        return 0;
    }
    options.head.target = "contract-peers";
    options.head.machine = sweep::machine_text();
    options.head.date = sweep::date_text();
    compare(options);
    return 0;
}

} // namespace
} // namespace raywise::contract

int main(int argc, char** argv) {
    try {
        return raywise::contract::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "contract_peers: %s\n", error.what());
        return 2;
    }
}
