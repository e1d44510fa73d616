#include "model/json_reader.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace raywise {
namespace {

// Longer than any name, date or command line worth keeping.
constexpr std::size_t longest_text = 1024;

} // namespace

void JsonValue::refuse(Status status, const std::string& problem) const {
    throw Error(status, (name_.empty() ? "the file" : name_) + ": " + problem + "; it is " + value_.excerpt());
}

JsonValue JsonValue::operator[](const char* member) const {
    if (value_.type != JsonNode::Type::object) refuse(Status::PROFILE_MALFORMED, "has to be an object");
    const std::string name = name_.empty() ? member : name_ + "." + member;
    const JsonNode* found = value_.find(member);
    if (found == nullptr) throw Error(Status::PROFILE_MALFORMED, name + ": is missing");
    return {*found, name};
}

void JsonValue::expect_members(const std::vector<std::string>& members) const {
    for (const std::string& member : members) (*this)[member.c_str()];
    for (const auto& item : value_.members) {
        if (std::find(members.begin(), members.end(), item.first) == members.end()) {
            const std::string place = name_.empty() ? "" : " in " + name_;
            JsonNode name;
            name.type = JsonNode::Type::text;
            name.text = item.first;
            throw Error(Status::PROFILE_MALFORMED, "unexpected member " + name.excerpt() + place);
        }
    }
}

double JsonValue::number(double lowest, double highest) const {
    if (value_.type != JsonNode::Type::number && value_.type != JsonNode::Type::whole) {
        refuse(Status::PROFILE_MALFORMED, "has to be a number");
    }
    if (!(value_.number >= lowest && value_.number <= highest)) {
        refuse(Status::PROFILE_RANGE, "has to lie between " + json_number(lowest) + " and " + json_number(highest));
    }
    return value_.number;
}

std::uint64_t JsonValue::whole_number(std::uint64_t lowest, std::uint64_t highest) const {
    if (value_.type != JsonNode::Type::number && value_.type != JsonNode::Type::whole) {
        refuse(Status::PROFILE_MALFORMED, "has to be a whole number");
    }
    if (value_.type != JsonNode::Type::whole || value_.whole < lowest || value_.whole > highest) {
        refuse(Status::PROFILE_RANGE,
               "has to be a whole number between " + std::to_string(lowest) + " and " + std::to_string(highest));
    }
    return value_.whole;
}

std::string JsonValue::text() const {
    if (value_.type != JsonNode::Type::text) refuse(Status::PROFILE_MALFORMED, "has to be a text");
    const std::string& text = value_.text;
    if (text.size() > longest_text) {
        refuse(Status::PROFILE_MALFORMED, "has more than " + std::to_string(longest_text) + " bytes");
    }
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
    if (std::any_of(text.begin(), text.end(), is_control)) {
        refuse(Status::PROFILE_MALFORMED, "holds a control character");
    }
    return text;
}

bool JsonValue::boolean() const {
    if (value_.type != JsonNode::Type::boolean) refuse(Status::PROFILE_MALFORMED, "has to be true or false");
    return value_.boolean;
}

} // namespace raywise
