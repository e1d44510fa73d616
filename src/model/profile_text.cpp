// A profile as a table for people, at most 100 columns wide as far as words can be broken.
#include "base/format.h"
#include "base/words.h"
#include "model/cost_functions.h"
#include "model/profile.h"

#include <string_view>

namespace raywise {
namespace {

constexpr std::size_t columns = 100;

// "label    words that go on", continued under the first word.
std::string paragraph(const std::string& label, const std::string& words) {
    constexpr std::size_t indent = 12;
    std::string text = label + std::string(label.size() < indent ? indent - label.size() : 1, ' ');
    std::size_t column = indent;
    bool first = true;
    std::string_view rest = words;
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest), first = false) {
        if (!first && column + 1 + word.size() > columns) {
            text += "\n" + std::string(indent, ' ');
            column = indent;
        } else if (!first) {
            text += ' ';
            ++column;
        }
        text += word;
        column += word.size();
    }
    return text + "\n";
}

std::string cache_text(std::uint64_t bytes) {
    if (bytes >= std::uint64_t{1} << 20) return format("%g MiB", static_cast<double>(bytes) / (1 << 20));
    return format("%g KiB", static_cast<double>(bytes) / (1 << 10));
}

std::string row(const char* structure, const std::string& cost, const CostLine& line, const char* quantity,
                const char* unit) {
    return format("%-14s %-12s %14.6g %s %14.6g %s %-8s %9.0f %%\n", structure, cost.c_str(), line.fixed, quantity,
                  line.per_unit, quantity, unit, line.residual * 100.0);
}

} // namespace

std::string source_text(const Profile& profile) {
    switch (profile.source) {
        case ProfileSource::generic:
            return "generic constants, compiled in";
        case ProfileSource::path:
            return profile.path;
        case ProfileSource::environment:
            return profile.path + " (RAYWISE_CALIBRATION)";
        case ProfileSource::user:
            return profile.path + " (user)";
        case ProfileSource::system:
            return profile.path + " (system)";
    }
    return {};
}

std::string to_text(const Profile& profile) {
    const Machine& machine = profile.machine;
    const Provenance& provenance = profile.provenance;
    const MachineConstants& constants = profile.constants;

    std::string text = paragraph("profile", source_text(profile));
    if (profile.status != Status::OK) text += paragraph("passed over", profile.reason);
    text += paragraph("measured on",
                      machine.brand + " (" + machine.vendor + " family " + std::to_string(machine.family) + " model " +
                          std::to_string(machine.model) + " stepping " + std::to_string(machine.stepping) + "), " +
                          machine.instruction_set + ", " + machine.precision + ", " + std::to_string(machine.threads) +
                          " threads, caches " + cache_text(machine.l1_bytes) + " / " + cache_text(machine.l2_bytes) +
                          " / " + cache_text(machine.l3_bytes) + (machine.virtualised ? ", virtual" : ""));
    text += paragraph("key", machine.key());
    text += paragraph("measured at", provenance.date + ", mode " + provenance.mode + ", " +
                                         format("%.0f s, spread of repeated timings %.1f %%", provenance.seconds,
                                                provenance.spread * 100.0));
    text += paragraph("by", provenance.tool + ", epoch " + std::to_string(profile.epoch));
    text += paragraph("command", provenance.command);

    text += "\ncost = fixed + per unit * unit(N) for N triangles, on one thread; misfit: root mean square\n\n";
    text += format("%-14s %-12s %17s %17s %-8s %11s\n", "structure", "cost", "fixed", "per unit", "unit", "misfit");
    for (const Structure structure : all_structures()) {
        const StructureConstants& lines = constants.structures[structure];
        text += row(name_of(structure), "build", lines.build_ns, "ns", build_unit_name(structure));
        for (std::size_t kind = 0; kind < measured_ray_kinds.size(); ++kind) {
            text += row("", std::string("ray ") + measured_ray_kind_names[kind], lines.ray_ns[kind], "ns",
                        ray_unit_name(structure));
        }
        text += row("", "memory", lines.bytes, "B ", "N");
    }
    text += "\n";
    text += format("%-44s %12.6g ns\n", "one triangle test", constants.primitive_test_ns);
    text += format("%-44s %12.6g ns\n", "one step from node to node", constants.node_step_ns);
    text +=
        format("%-44s %12.6g ns\n", "published rule, eq. 7: build per N log2 N", constants.hapala.build_ns_per_n_log_n);
    text += format("%-44s %12.6g ns\n", "published rule, eq. 8: ray per log2 N", constants.hapala.ray_ns_per_log_n);
    return text;
}

} // namespace raywise
