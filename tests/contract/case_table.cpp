#include "contract/case_table.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

namespace raywise::contract {
namespace {

constexpr std::size_t width = 100;

std::string left(std::string text, std::size_t columns) {
    text.resize(std::max(text.size(), columns), ' ');
    return text;
}
std::string right(const std::string& text, std::size_t columns) {
    return text.size() < columns ? std::string(columns - text.size(), ' ') + text : text;
}

// A library's name over two lines: its first word, and the rest.
std::pair<std::string, std::string> heading(const std::string& name) {
    const auto blank = name.find(' ');
    if (blank == std::string::npos) return {"", name};
    return {name.substr(0, blank), name.substr(blank + 1)};
}

struct Tally {
    std::uint64_t passed = 0;
    std::uint64_t failed = 0;
    std::uint64_t skipped = 0;

    void add(Outcome outcome) {
        ++(outcome == Outcome::passed ? passed : outcome == Outcome::failed ? failed : skipped);
    }
    std::string text() const {
        if (passed + failed == 0) return "-";
        return std::to_string(passed) + "/" + std::to_string(passed + failed);
    }
};

// Breaks at blanks; every line after the first is set in.
std::string wrapped(const std::string& text, const std::string& indent) {
    std::istringstream words(text);
    std::string word, line, result;
    while (words >> word) {
        if (!line.empty() && line.size() + 1 + word.size() > width) {
            result += line + "\n";
            line = indent + word;
        } else {
            line += line.empty() ? word : " " + word;
        }
    }
    return result + line + "\n";
}

void append_table(const std::vector<LibraryResult>& results, std::size_t first, std::size_t last,
                  const std::vector<std::string>& families, std::size_t name_width, std::string& text) {
    std::string top(name_width, ' ');
    std::string bottom = left("family", name_width);
    for (std::size_t i = first; i < last; ++i) {
        const auto [maker, rest] = heading(results[i].library);
        const std::size_t columns = std::max({maker.size(), rest.size(), std::size_t{7}}) + 2;
        top += right(maker, columns);
        bottom += right(rest, columns);
    }
    text += top + "\n" + bottom + "\n";
    const auto row = [&](const std::string& name, auto&& cell) {
        text += left(name, name_width);
        for (std::size_t i = first; i < last; ++i) {
            const auto [maker, rest] = heading(results[i].library);
            text += right(cell(results[i]), std::max({maker.size(), rest.size(), std::size_t{7}}) + 2);
        }
        text += "\n";
    };
    const auto tally_of = [](const LibraryResult& result, const std::string& family) {
        Tally tally;
        for (const CaseResult& one : result.cases) {
            if (family.empty() || one.family == family) tally.add(one.outcome);
        }
        return tally;
    };
    for (const std::string& family : families)
        row(family, [&](const LibraryResult& result) { return tally_of(result, family).text(); });
    row("all", [&](const LibraryResult& result) { return tally_of(result, "").text(); });
    row("closest hit", [](const LibraryResult& result) {
        return std::to_string(result.passed_by_closest()) + "/" +
               std::to_string(result.count(Outcome::passed) + result.count(Outcome::failed));
    });
    row("skipped", [&](const LibraryResult& result) { return std::to_string(tally_of(result, "").skipped); });
}

} // namespace

std::string table_of(const std::vector<LibraryResult>& results) {
    std::vector<std::string> families;
    std::size_t name_width = std::string("closest hit").size();
    for (const LibraryResult& result : results) {
        for (const CaseResult& one : result.cases) {
            if (std::find(families.begin(), families.end(), one.family) == families.end())
                families.push_back(one.family);
            name_width = std::max(name_width, one.family.size());
        }
    }
    std::string text;
    for (std::size_t first = 0; first < results.size();) {
        std::size_t last = first;
        std::size_t used = name_width;
        while (last < results.size()) {
            const auto [maker, rest] = heading(results[last].library);
            const std::size_t columns = std::max({maker.size(), rest.size(), std::size_t{7}}) + 2;
            if (last > first && used + columns > width) break;
            used += columns;
            ++last;
        }
        append_table(results, first, last, families, name_width, text);
        first = last;
        text += "\n";
    }

    // Several structures of one library often fail alike: said once.
    std::vector<std::pair<std::string, std::vector<std::string>>> failures; // text, libraries
    std::map<std::string, std::uint64_t> skipped;                           // reason, cases
    for (const LibraryResult& result : results) {
        for (const CaseResult& one : result.cases) {
            if (one.outcome == Outcome::skipped) ++skipped[result.library + ": " + one.reason];
            if (one.outcome != Outcome::failed) continue;
            std::string what = one.family + "/" + one.name;
            if (!one.convention.empty()) what += " (a convention)";
            if (one.rays > 1) {
                what += ", " + std::to_string(one.failed_rays) + " of " + std::to_string(one.rays) + " rays";
            }
            what += ": " + one.reason;
            const auto known = std::find_if(failures.begin(), failures.end(),
                                            [&](const auto& failure) { return failure.first == what; });
            if (known == failures.end())
                failures.push_back({what, {result.library}});
            else
                known->second.push_back(result.library);
        }
    }
    if (!failures.empty()) text += "failed:\n";
    for (const auto& [what, libraries] : failures) {
        std::string names;
        for (const std::string& name : libraries) names += (names.empty() ? "" : ", ") + name;
        text += wrapped(what, "    ") + "    " + wrapped("failed by " + names, "    ");
    }
    if (!skipped.empty()) text += "skipped:\n";
    for (const auto& [reason, cases] : skipped) text += wrapped(std::to_string(cases) + " cases, " + reason, "    ");
    return text;
}

} // namespace raywise::contract
