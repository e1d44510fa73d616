// Distrustful reading of JSON values: every complaint names the member and what it holds.
#pragma once

#include "base/error.h"
#include "model/json_tree.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace raywise {

// A value inside a parsed text, and the way to it for messages: "structures.bvh.build_ns.fixed".
// Wrong types and missing or unexpected members throw Error(PROFILE_MALFORMED), bad numbers Error(PROFILE_RANGE).
class JsonValue {
public:
    JsonValue(const JsonNode& value, std::string name) : value_(value), name_(std::move(name)) {}

    // A member of an object.
    JsonValue operator[](const char* member) const;
    // Demands exactly these members, so that neither a typing mistake nor an unknown structure goes unnoticed.
    void expect_members(const std::vector<std::string>& members) const;

    // lowest <= number <= highest
    double number(double lowest, double highest) const;
    std::uint64_t whole_number(std::uint64_t lowest, std::uint64_t highest) const;
    // Printable text: it is shown on terminals.
    std::string text() const;
    bool boolean() const;

    // "name: problem; it is value"
    [[noreturn]] void refuse(Status status, const std::string& problem) const;

private:
    const JsonNode& value_;
    std::string name_;
};

} // namespace raywise
