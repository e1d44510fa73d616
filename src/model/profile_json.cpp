// The profile's file format, "raywise-profile/2": JSON, every member required, none besides.
#include "model/cost_units.h"
#include "model/json_reader.h"
#include "model/json_writer.h"
#include "model/profile.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace raywise {
namespace {

constexpr const char* schema = "raywise-profile/2";

// What is believed at most. Ten thousand seconds for something that costs the same for every scene, a second per
// triangle or ray: slower than any machine by orders of magnitude, and far from overflow in any sum.
constexpr double most_fixed_ns = 1e13;
constexpr double most_ns_per_unit = 1e9;
constexpr double most_fixed_bytes = 1e12;
constexpr double most_bytes_per_triangle = 1e6;
constexpr double most_residual = 1e3;  // relative: a thousandfold misfit
constexpr double most_single_ns = 1e6; // one triangle test or one step between nodes
constexpr double most_seconds = 1e7;   // spent on measuring: four months
constexpr std::uint64_t most_cache_bytes = std::uint64_t{1} << 40;
constexpr std::uint64_t most_threads = 1u << 20;

void write_cost(JsonWriter& json, const char* name, const LinearCost& cost, const CostUnits& units) {
    json.open_object(name);
    json.put("fixed", cost.fixed);
    json.open_object("per_unit");
    for (std::size_t i = 0; i < units.size(); ++i) json.put(units[i].name, cost.per_unit[i]);
    json.close_object();
    json.put("residual", cost.residual);
    json.close_object();
}

struct CostLimits {
    double fixed;
    double per_unit;
    bool may_be_zero; // a structure may take no memory, but nothing takes no time
};
constexpr CostLimits time_limits{most_fixed_ns, most_ns_per_unit, false};
constexpr CostLimits byte_limits{most_fixed_bytes, most_bytes_per_triangle, true};

LinearCost parse_cost(const JsonValue& value, const CostUnits& units, const CostLimits& limits) {
    value.expect_members({"fixed", "per_unit", "residual"});
    LinearCost cost;
    cost.fixed = value["fixed"].number(0.0, limits.fixed);
    const JsonValue per_unit = value["per_unit"];
    std::vector<std::string> names;
    for (const CostUnit& unit : units) names.emplace_back(unit.name);
    per_unit.expect_members(names);
    bool is_zero = cost.fixed <= 0.0;
    for (std::size_t i = 0; i < units.size(); ++i) {
        cost.per_unit[i] = per_unit[units[i].name].number(0.0, limits.per_unit);
        is_zero = is_zero && cost.per_unit[i] <= 0.0;
    }
    cost.residual = value["residual"].number(0.0, most_residual);
    if (is_zero && !limits.may_be_zero) value.refuse(Status::PROFILE_RANGE, "fixed and per_unit are all zero");
    return cost;
}

StructureConstants parse_structure(const JsonValue& value, Structure structure) {
    value.expect_members({"build_ns", "ray_ns", "bytes"});
    StructureConstants constants;
    constants.build_ns = parse_cost(value["build_ns"], build_units(structure), time_limits);
    constants.bytes = parse_cost(value["bytes"], byte_units(structure), byte_limits);
    const JsonValue rays = value["ray_ns"];
    rays.expect_members({measured_ray_kind_names.begin(), measured_ray_kind_names.end()});
    for (std::size_t kind = 0; kind < measured_ray_kinds.size(); ++kind) {
        constants.ray_ns[kind] = parse_cost(rays[measured_ray_kind_names[kind]], ray_units(structure), time_limits);
    }
    return constants;
}

Machine parse_machine(const JsonValue& value) {
    value.expect_members({"vendor", "brand", "family", "model", "stepping", "instruction_set", "l1_bytes", "l2_bytes",
                          "l3_bytes", "threads", "precision", "virtualised"});
    constexpr std::uint64_t most_id = std::numeric_limits<std::uint32_t>::max();
    Machine machine;
    machine.vendor = value["vendor"].text();
    machine.brand = value["brand"].text();
    machine.family = static_cast<unsigned>(value["family"].whole_number(0, most_id));
    machine.model = static_cast<unsigned>(value["model"].whole_number(0, most_id));
    machine.stepping = static_cast<unsigned>(value["stepping"].whole_number(0, most_id));
    machine.instruction_set = value["instruction_set"].text();
    machine.l1_bytes = value["l1_bytes"].whole_number(0, most_cache_bytes);
    machine.l2_bytes = value["l2_bytes"].whole_number(0, most_cache_bytes);
    machine.l3_bytes = value["l3_bytes"].whole_number(0, most_cache_bytes);
    machine.threads = static_cast<unsigned>(value["threads"].whole_number(1, most_threads));
    machine.precision = value["precision"].text();
    machine.virtualised = value["virtualised"].boolean();
    return machine;
}

Provenance parse_provenance(const JsonValue& value) {
    value.expect_members({"tool", "command", "date", "mode", "spread", "seconds"});
    Provenance provenance;
    provenance.tool = value["tool"].text();
    provenance.command = value["command"].text();
    provenance.date = value["date"].text();
    provenance.mode = value["mode"].text();
    provenance.spread = value["spread"].number(0.0, most_residual);
    provenance.seconds = value["seconds"].number(0.0, most_seconds);
    return provenance;
}

// A cost of nothing would make every quotient of the published rule meaningless.
double parse_positive(const JsonValue& value, double highest) {
    return value.number(std::numeric_limits<double>::min(), highest);
}

} // namespace

std::string to_json(const Profile& profile) {
    const Machine& machine = profile.machine;
    const Provenance& provenance = profile.provenance;
    const MachineConstants& constants = profile.constants;

    JsonWriter json;
    json.open_object();
    json.put("schema", schema);
    json.put("epoch", profile.epoch);

    json.open_object("machine");
    json.put("vendor", machine.vendor);
    json.put("brand", machine.brand);
    json.put("family", machine.family);
    json.put("model", machine.model);
    json.put("stepping", machine.stepping);
    json.put("instruction_set", machine.instruction_set);
    json.put("l1_bytes", machine.l1_bytes);
    json.put("l2_bytes", machine.l2_bytes);
    json.put("l3_bytes", machine.l3_bytes);
    json.put("threads", machine.threads);
    json.put("precision", machine.precision);
    json.put("virtualised", machine.virtualised);
    json.close_object();

    json.open_object("provenance");
    json.put("tool", provenance.tool);
    json.put("command", provenance.command);
    json.put("date", provenance.date);
    json.put("mode", provenance.mode);
    json.put("spread", provenance.spread);
    json.put("seconds", provenance.seconds);
    json.close_object();

    json.open_object("structures");
    for (const Structure structure : all_structures()) {
        const StructureConstants& lines = constants.structures[structure];
        json.open_object(name_of(structure));
        write_cost(json, "build_ns", lines.build_ns, build_units(structure));
        json.open_object("ray_ns");
        for (std::size_t kind = 0; kind < measured_ray_kinds.size(); ++kind) {
            write_cost(json, measured_ray_kind_names[kind], lines.ray_ns[kind], ray_units(structure));
        }
        json.close_object();
        write_cost(json, "bytes", lines.bytes, byte_units(structure));
        json.close_object();
    }
    json.close_object();

    json.open_object("hapala");
    json.put("build_ns_per_n_log_n", constants.hapala.build_ns_per_n_log_n);
    json.put("ray_ns_per_log_n", constants.hapala.ray_ns_per_log_n);
    json.close_object();
    json.put("primitive_test_ns", constants.primitive_test_ns);
    json.put("node_step_ns", constants.node_step_ns);
    json.close_object();
    return json.finish();
}

Profile parse_profile(const std::string& text) {
    const JsonNode document = parse_json(text);
    const JsonValue root(document, "");

    // First what tells whether the rest means anything.
    if (root["schema"].text() != schema) {
        root["schema"].refuse(Status::PROFILE_SCHEMA, std::string("this library reads \"") + schema + "\"");
    }
    const std::uint64_t epoch = root["epoch"].whole_number(0, std::numeric_limits<std::uint32_t>::max());
    if (epoch != calibration_epoch) {
        root["epoch"].refuse(Status::PROFILE_EPOCH,
                             "this library's kernels are of epoch " + std::to_string(calibration_epoch));
    }

    root.expect_members(
        {"schema", "epoch", "machine", "provenance", "structures", "hapala", "primitive_test_ns", "node_step_ns"});
    Profile profile;
    profile.epoch = static_cast<unsigned>(epoch);
    profile.machine = parse_machine(root["machine"]);
    profile.provenance = parse_provenance(root["provenance"]);

    const JsonValue structures = root["structures"];
    structures.expect_members({structure_names.begin(), structure_names.end()});
    for (const Structure structure : all_structures()) {
        profile.constants.structures[structure] = parse_structure(structures[name_of(structure)], structure);
    }
    const JsonValue hapala = root["hapala"];
    hapala.expect_members({"build_ns_per_n_log_n", "ray_ns_per_log_n"});
    profile.constants.hapala.build_ns_per_n_log_n = parse_positive(hapala["build_ns_per_n_log_n"], most_ns_per_unit);
    profile.constants.hapala.ray_ns_per_log_n = parse_positive(hapala["ray_ns_per_log_n"], most_ns_per_unit);
    profile.constants.primitive_test_ns = parse_positive(root["primitive_test_ns"], most_single_ns);
    profile.constants.node_step_ns = parse_positive(root["node_step_ns"], most_single_ns);
    return profile;
}

} // namespace raywise
