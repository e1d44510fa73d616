// A profile as a table for people, at most 100 columns wide as far as words can be broken.
#include "base/format.h"
#include "base/words.h"
#include "model/cost_units.h"
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

// "build       1234.5 ns + 12.3 N + 4.5 references", and the misfit.
std::string row(const char* structure, const std::string& cost, const LinearCost& constants, const char* quantity,
                const CostUnits& units) {
    std::string sum = format("%.3g %s", constants.fixed, quantity);
    for (std::size_t i = 0; i < units.size(); ++i) {
        if (constants.per_unit[i] != 0.0) sum += format(" + %.3g ", constants.per_unit[i]) + units[i].name;
    }
    return format("%-13s %-11s %-66s %4.0f %%\n", structure, cost.c_str(), sum.c_str(), constants.residual * 100.0);
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

    text +=
        "\nOn one thread; misfit: root mean square. N: triangles; boxes, cells, filled: boxes of triangles and\n"
        "(filled) cells that a line meets; crowding: triangles around one; references: cells that triangles\n"
        "reach into, counted for each; far levels: log2 N beyond 15.\n\n";
    text += format("%-13s %-11s %-66s %6s\n", "structure", "cost", "of a scene", "misfit");
    for (const Structure structure : all_structures()) {
        const StructureConstants& costs = constants.structures[structure];
        text += row(name_of(structure), "build", costs.build_ns, "ns", build_units(structure));
        for (std::size_t kind = 0; kind < measured_ray_kinds.size(); ++kind) {
            text += row("", std::string("ray ") + measured_ray_kind_names[kind], costs.ray_ns[kind], "ns",
                        ray_units(structure));
        }
        text += row("", "memory", costs.bytes, "B", byte_units(structure));
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
