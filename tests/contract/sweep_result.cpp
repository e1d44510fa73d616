#include "contract/sweep_result.h"

#include <cstdarg>
#include <cstdio>

namespace raywise::sweep {
namespace {

// Faults kept in the report; the counts tell of all.
constexpr std::size_t most_faults = 100;

__attribute__((format(printf, 2, 3))) void add_line(std::string& text, const char* format, ...) {
    char line[256];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    text += line;
    text += '\n';
}

unsigned long long number(std::uint64_t x) { return x; }

void agreement_lines(std::string& text, const SweepResult& result) {
    add_line(text, "%-34s %9s %11s %11s %12s %9s %7s", "agreement: scene", "triangles", "rays", "hits", "comparisons",
             "differing", "seconds");
    for (const AgreementRow& row : result.agreement) {
        add_line(text, "%-34.34s %9llu %11llu %11llu %12llu %9llu %7.1f", row.name.c_str(), number(row.triangles),
                 number(row.count.rays), number(row.count.hits), number(row.count.comparisons),
                 number(row.count.disagreements), row.count.seconds);
    }
    const AgreementCount total = result.agreement_total();
    add_line(text, "%-34s %9s %11llu %11llu %12llu %9llu %7.1f", "all", "", number(total.rays), number(total.hits),
             number(total.comparisons), number(total.disagreements), total.seconds);
    add_line(text, "%-34s %9s %11llu %11s %12s %9llu", "of these before the exact judge", "", number(total.judge_rays),
             "", "", number(total.judge_disagreements));
}

void watertight_lines(std::string& text, const SweepResult& result) {
    add_line(text, "%-42s %9s %10s %6s %10s %9s %7s", "watertightness: mesh", "triangles", "edge rays", "leaks",
             "crossings", "wrong", "seconds");
    for (const WatertightRow& row : result.watertight) {
        add_line(text, "%-42.42s %9llu %10llu %6llu %10llu %9llu %7.1f",
                 (row.name + (row.convex ? " (convex)" : "")).c_str(), number(row.triangles), number(row.count.rays),
                 number(row.count.leaks), number(row.count.parity_rays), number(row.count.parity_errors),
                 row.count.seconds);
    }
    const WatertightCount total = result.watertight_total();
    add_line(text, "%-42s %9s %10llu %6llu %10llu %9llu %7.1f", "all", "", number(total.rays), number(total.leaks),
             number(total.parity_rays), number(total.parity_errors), total.seconds);
}

} // namespace

AgreementCount SweepResult::agreement_total() const {
    AgreementCount total;
    for (const AgreementRow& row : agreement) total.add(row.count);
    return total;
}

WatertightCount SweepResult::watertight_total() const {
    WatertightCount total;
    for (const WatertightRow& row : watertight) total.add(row.count);
    return total;
}

bool SweepResult::complete() const {
    return !interrupted && agreement_total().comparisons >= comparisons_wanted &&
           watertight_total().rays >= edge_rays_wanted;
}

bool SweepResult::right() const {
    const AgreementCount a = agreement_total();
    const WatertightCount w = watertight_total();
    return a.disagreements == 0 && a.judge_disagreements == 0 && w.leaks == 0 && w.parity_errors == 0;
}

std::string table_of(const SweepResult& result) {
    std::string text;
    if (!result.agreement.empty()) agreement_lines(text, result);
    if (!result.agreement.empty() && !result.watertight.empty()) text += '\n';
    if (!result.watertight.empty()) watertight_lines(text, result);
    if (!result.complete()) text += "\nINCOMPLETE: fewer comparisons or edge rays than were asked for\n";
    return text;
}

Json part_of(const SweepResult& result) {
    Json part = empty_part();
    Json& rows = part["rows"];
    std::size_t faults = 0;
    const auto add_faults = [&rows, &faults](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) {
            if (faults++ < most_faults) rows.push_back({{"part", "fault"}, {"text", text}});
        }
    };
    for (const AgreementRow& row : result.agreement) {
        rows.push_back({{"part", "agreement"},
                        {"family", row.family},
                        {"scene", row.name},
                        {"triangles", row.triangles},
                        {"rays", row.count.rays},
                        {"hits", row.count.hits},
                        {"comparisons", row.count.comparisons},
                        {"disagreements", row.count.disagreements},
                        {"judge_rays", row.count.judge_rays},
                        {"judge_disagreements", row.count.judge_disagreements},
                        {"seconds", row.count.seconds}});
    }
    for (const WatertightRow& row : result.watertight) {
        rows.push_back({{"part", "watertightness"},
                        {"scene", row.name},
                        {"triangles", row.triangles},
                        {"convex", row.convex},
                        {"edge_rays", row.count.rays},
                        {"leaks", row.count.leaks},
                        {"parity_rays", row.count.parity_rays},
                        {"parity_errors", row.count.parity_errors},
                        {"seconds", row.count.seconds}});
    }
    const AgreementCount agreement = result.agreement_total();
    const WatertightCount watertight = result.watertight_total();
    add_faults(agreement.faults);
    add_faults(watertight.faults);
    part["summary"] = {{"comparisons", agreement.comparisons},
                       {"disagreements", agreement.disagreements},
                       {"edge_rays", watertight.rays},
                       {"leaks", watertight.leaks},
                       {"judge_rays", agreement.judge_rays},
                       {"judge_disagreements", agreement.judge_disagreements},
                       {"parity_rays", watertight.parity_rays},
                       {"parity_errors", watertight.parity_errors},
                       {"seed", result.seed},
                       {"complete", result.complete()}};
    return part;
}

} // namespace raywise::sweep
