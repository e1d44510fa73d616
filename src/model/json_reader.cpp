#include "model/json_reader.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace raywise {
namespace {

using nlohmann::json;

// A profile nests five deep: structures, a structure, ray_ns, a kind, a value.
constexpr int deepest = 8;

// Longer than any name, date or command line worth keeping.
constexpr std::size_t longest_text = 1024;

// Values in messages: enough to recognise them by.
std::string excerpt(const json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "a list";
    std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    return text;
}

// What the parser says, without its own prefix "[json.exception.parse_error.101] ".
std::string plain_words(const char* what) {
    const std::string text = what;
    const std::size_t end = text.find("] ");
    const std::string words = end == std::string::npos ? text : text.substr(end + 2);
    return words.size() > 200 ? words.substr(0, 197) + "..." : words;
}

} // namespace

json parse_bounded(const std::string& text) {
    // The parser takes a zero for the end and would not look at what follows.
    if (text.find('\0') != std::string::npos) throw Error(Status::PROFILE_MALFORMED, "holds a zero byte");
    std::vector<std::set<std::string>> keys; // of the objects that are open, to find members given twice
    const auto watch = [&](int depth, json::parse_event_t event, json& parsed) {
        if (depth > deepest) {
            throw Error(Status::PROFILE_MALFORMED, "nested more than " + std::to_string(deepest) + " deep");
        }
        if (event == json::parse_event_t::object_start) keys.emplace_back();
        if (event == json::parse_event_t::object_end) keys.pop_back();
        if (event == json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second) {
            throw Error(Status::PROFILE_MALFORMED, "member " + excerpt(parsed) + " is there twice");
        }
        return true;
    };
    try {
        return json::parse(text, watch);
    } catch (const json::out_of_range& error) {
        throw Error(Status::PROFILE_RANGE, plain_words(error.what()));
    } catch (const json::exception& error) {
        throw Error(Status::PROFILE_MALFORMED, plain_words(error.what()));
    }
}

void JsonValue::refuse(Status status, const std::string& problem) const {
    throw Error(status, (name_.empty() ? "the file" : name_) + ": " + problem + "; it is " + excerpt(value_));
}

JsonValue JsonValue::operator[](const char* member) const {
    if (!value_.is_object()) refuse(Status::PROFILE_MALFORMED, "has to be an object");
    const std::string name = name_.empty() ? member : name_ + "." + member;
    const auto found = value_.find(member);
    if (found == value_.end()) throw Error(Status::PROFILE_MALFORMED, name + ": is missing");
    return {*found, name};
}

void JsonValue::expect_members(const std::vector<std::string>& members) const {
    for (const std::string& member : members) (*this)[member.c_str()];
    for (const auto& item : value_.items()) {
        if (std::find(members.begin(), members.end(), item.key()) == members.end()) {
            const std::string place = name_.empty() ? "" : " in " + name_;
            throw Error(Status::PROFILE_MALFORMED, "unexpected member " + excerpt(json(item.key())) + place);
        }
    }
}

double JsonValue::number(double lowest, double highest) const {
    if (!value_.is_number()) refuse(Status::PROFILE_MALFORMED, "has to be a number");
    const double number = value_.get<double>();
    if (!(number >= lowest && number <= highest)) {
        refuse(Status::PROFILE_RANGE, "has to lie between " + excerpt(json(lowest)) + " and " + excerpt(json(highest)));
    }
    return number;
}

std::uint64_t JsonValue::whole_number(std::uint64_t lowest, std::uint64_t highest) const {
    if (!value_.is_number()) refuse(Status::PROFILE_MALFORMED, "has to be a whole number");
    if (!value_.is_number_unsigned() || value_.get<std::uint64_t>() < lowest || value_.get<std::uint64_t>() > highest) {
        refuse(Status::PROFILE_RANGE,
               "has to be a whole number between " + std::to_string(lowest) + " and " + std::to_string(highest));
    }
    return value_.get<std::uint64_t>();
}

std::string JsonValue::text() const {
    if (!value_.is_string()) refuse(Status::PROFILE_MALFORMED, "has to be a text");
    std::string text = value_.get<std::string>();
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
    if (!value_.is_boolean()) refuse(Status::PROFILE_MALFORMED, "has to be true or false");
    return value_.get<bool>();
}

} // namespace raywise
