#include "contract/peers/peers_report.h"

#include "contract/case_json.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

namespace raywise::contract {
namespace {

struct Tally {
    std::uint64_t passed = 0;
    std::uint64_t failed = 0;
    std::uint64_t not_applicable = 0;
    std::uint64_t failed_conventions = 0;

    std::string text() const {
        return passed + failed == 0 ? "–" : std::to_string(passed) + "/" + std::to_string(passed + failed);
    }
};

// Of all families where none is named.
Tally tally_of(const LibraryResult& result, const std::string& family = "") {
    Tally tally;
    for (const CaseResult& one : result.cases) {
        if (!family.empty() && one.family != family) continue;
        switch (one.outcome) {
            case Outcome::passed:
                ++tally.passed;
                break;
            case Outcome::failed:
                ++tally.failed;
                break;
            case Outcome::skipped:
                ++tally.not_applicable;
                break;
        }
        if (one.outcome == Outcome::failed && !one.convention.empty()) ++tally.failed_conventions;
    }
    return tally;
}

// So that a text stays within its cell. Of several lines the first says it.
std::string cell(const std::string& text) {
    std::string out;
    for (const char c : text.substr(0, text.find('\n'))) {
        if (c == '|' || c == '*' || c == '_' || c == '<') out += '\\';
        out += c;
    }
    return out;
}

std::string line_of(const std::vector<std::string>& cells) {
    std::string line = "|";
    for (const std::string& one : cells) line += " " + one + " |";
    return line + "\n";
}

template <class CellOf>
std::string row_of(const std::string& name, const std::vector<Entrant>& entrants, CellOf&& cell_of) {
    std::vector<std::string> cells = {name};
    for (const Entrant& entrant : entrants) cells.push_back(cell_of(entrant.result));
    return line_of(cells);
}

std::string pass_table(const std::vector<Family>& families, const std::vector<Entrant>& entrants) {
    std::string text = row_of("family", entrants, [](const LibraryResult& result) { return result.library; });
    text += row_of("---", entrants, [](const LibraryResult&) { return std::string("---:"); });
    for (const Family& family : families) {
        text += row_of(family.name, entrants,
                       [&](const LibraryResult& result) { return tally_of(result, family.name).text(); });
    }
    text +=
        row_of("**all**", entrants, [](const LibraryResult& result) { return "**" + tally_of(result).text() + "**"; });
    text += row_of("by closest hit alone", entrants, [](const LibraryResult& result) {
        const Tally tally = tally_of(result);
        return std::to_string(result.passed_by_closest()) + "/" + std::to_string(tally.passed + tally.failed);
    });
    text += row_of("not applicable", entrants,
                   [](const LibraryResult& result) { return std::to_string(tally_of(result).not_applicable); });
    return text + row_of("failed, matters of convention", entrants, [](const LibraryResult& result) {
               return std::to_string(tally_of(result).failed_conventions);
           });
}

std::string failures_of(const Entrant& entrant) {
    std::string text = "\n### " + entrant.result.library + "\n\n";
    if (tally_of(entrant.result).failed == 0) return text + "None.\n";
    if (!entrant.why.empty()) text += entrant.why + "\n\n";
    text += line_of({"case", "rays", "the first that went wrong"}) + line_of({"---", "---:", "---"});
    for (const CaseResult& one : entrant.result.cases) {
        if (one.outcome != Outcome::failed) continue;
        const std::string rays =
            one.failed_rays > 0 ? std::to_string(one.failed_rays) + "/" + std::to_string(one.rays) : "–";
        text += line_of({one.family + "/" + one.name + (one.convention.empty() ? "" : " †"), rays, cell(one.reason)});
    }
    return text;
}

std::string conventions_of(const std::vector<Family>& families) {
    std::string text = line_of({"case", "others may say"}) + line_of({"---", "---"});
    for (const Family& family : families) {
        for (const Case& one : family.cases) {
            if (!one.convention.empty()) text += line_of({family.name + "/" + one.name, cell(one.convention)});
        }
    }
    return text;
}

constexpr const char* how_to_read = R"(
## How to read it

A cell is *cases passed / cases that can be put to the library*. A case is passed when every ray of it is answered as its file
says, by the closest hit, by any hit and by all hits where the library has calls for them, and when these do not contradict
each other. The cases are the files of `tests/contract/cases`, with sources and reasons; the `README.md` there describes them.

- **Not applicable** is what a library has no words for: an interval where it takes none, all hits, several meshes in one
  scene, the refusal of a mesh by a library that checks none. It counts neither way.
- **Hit or miss** is decided by exact arithmetic, for all alike: it is what the cases are about.
- **Precision.** Coordinates are handed over in the precision the library works in. A case that needs float64 is put to float32
  libraries all the same: what they then get wrong is what their users get. t may be off by 1e-5 (float32), 1e-9 (float64) or
  2^-37 (raywise, as its header promises) of the distance from the ray's origin to the scene's farthest point.
- **Which triangle.** raywise has to name the one that exact arithmetic finds, and the lowest id of several at the same t. Peers
  may name any triangle at that t, and one that the ray passes by within their tolerance of t.
- **All hits.** raywise counts crossings: a surface is one hit where the ray passes through an edge, so that the number of hits
  tells inside from outside. From peers, which promise less, a list of every triangle touched is as good, with or without those
  met edge-on. What fails is a list that leaves some of them out or holds others. *By closest hit alone* disregards what any hit
  and all hits say.
- **Bad input.** A ray that nothing can be made of is a miss; a triangle with a bad vertex, where the case says that such are to be
  skipped, is handed over as it is.
- **Crashes.** Each library runs in a process of its own. A crash, an exception or no answer within the time limit fails the case
  and no other.
- **Conventions** (†) are cases in which a library may see the matter differently for good reasons. They are listed at the end,
  and counted in a row of their own so that they can be subtracted.
- **raywise** is one column for all its structures and for views: each of them has to pass.

The peers are made for speed or for other tasks than these; a case failed here need not matter to their users. The table says
which answers one can rely on, nothing else.
)";

} // namespace

LibraryResult together(const std::string& name, const std::vector<LibraryResult>& forms) {
    if (forms.empty()) throw std::invalid_argument("no results to put together");
    LibraryResult all{name, forms.front().cases};
    for (const LibraryResult& form : forms) {
        if (form.cases.size() != all.cases.size()) throw std::invalid_argument("results of different cases");
        for (std::size_t i = 0; i < form.cases.size(); ++i) {
            const CaseResult& one = form.cases[i];
            CaseResult& sum = all.cases[i];
            sum.failed_questions.insert(one.failed_questions.begin(), one.failed_questions.end());
            if (one.outcome == Outcome::failed && (sum.outcome != Outcome::failed || &form == &forms.front())) {
                const std::set<std::string> failed_questions = sum.failed_questions;
                sum = one;
                sum.failed_questions = failed_questions;
                sum.reason = form.library + ": " + one.reason;
            } else if (one.outcome == Outcome::passed && sum.outcome == Outcome::skipped) {
                sum = one;
            }
        }
    }
    return all;
}

std::string page_of(const sweep::ReportHead& head, const std::vector<Family>& families,
                    const std::vector<Entrant>& entrants) {
    std::string text = "# The hard cases, library by library\n\n";
    text += "Written by `" + head.command + "` at commit " + head.commit + ", on " + head.date.substr(0, 10) +
            ", on this machine: " + head.machine + ". Not to be edited: run it again.\n\n";
    text += pass_table(families, entrants);
    text += how_to_read;
    text += "\n## Versions, and how each is asked\n\n";
    text += line_of({"library", "version", "how"}) + line_of({"---", "---", "---"});
    for (const Entrant& entrant : entrants) text += line_of({entrant.result.library, entrant.version, entrant.note});
    text += "\n## What each fails\n";
    for (const Entrant& entrant : entrants) text += failures_of(entrant);
    return text + "\n## Matters of convention\n\n" + conventions_of(families);
}

sweep::Json peers_json(const sweep::ReportHead& head, const std::vector<Entrant>& entrants) {
    std::vector<LibraryResult> results;
    sweep::Json summary;
    for (const Entrant& entrant : entrants) {
        const Tally tally = tally_of(entrant.result);
        summary[entrant.result.library] = {{"version", entrant.version},
                                           {"hard_cases_passed", tally.passed},
                                           {"hard_cases", tally.passed + tally.failed},
                                           {"passed_by_closest_hit", entrant.result.passed_by_closest()},
                                           {"not_applicable", tally.not_applicable},
                                           {"failed_conventions", tally.failed_conventions}};
        results.push_back(entrant.result);
    }
    return sweep::merged_report(head, {{{"rows", report_of(results)["rows"]}, {"summary", summary}}});
}

} // namespace raywise::contract
