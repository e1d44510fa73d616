#include "model/json_tree.h"

#include "base/error.h"
#include "base/format.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace raywise {
namespace {

using nlohmann::json;

// A profile nests five deep: structures, a structure, ray_ns, a kind, a value.
constexpr std::size_t deepest = 8;

// What the parser says, without its own prefix "[json.exception.parse_error.101] ". It quotes the file, and messages go to
// terminals: nothing but printable ASCII.
std::string plain_words(const char* what) {
    const std::string text = what;
    const std::size_t end = text.find("] ");
    std::string words = end == std::string::npos ? text : text.substr(end + 2);
    std::replace_if(
        words.begin(), words.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return words.size() > 200 ? words.substr(0, 197) + "..." : words;
}

// Takes the parser's events, in nlohmann-json's SAX interface, and builds the tree.
class Builder {
public:
    explicit Builder(JsonNode& root) : root_(root) {}

    bool null() {
        add(JsonNode::Type::null);
        return true;
    }
    bool boolean(bool value) {
        add(JsonNode::Type::boolean).boolean = value;
        return true;
    }
    bool number_integer(std::int64_t value) { return number_float(static_cast<double>(value), {}); }
    bool number_unsigned(std::uint64_t value) {
        JsonNode& node = add(JsonNode::Type::whole);
        node.whole = value;
        node.number = static_cast<double>(value);
        return true;
    }
    bool number_float(double value, const std::string&) {
        add(JsonNode::Type::number).number = value;
        return true;
    }
    bool string(std::string& value) {
        add(JsonNode::Type::text).text = value;
        return true;
    }
    bool binary(json::binary_t&) { return true; } // does not occur in JSON texts
    bool start_object(std::size_t) { return open(JsonNode::Type::object); }
    bool start_array(std::size_t) { return open(JsonNode::Type::list); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }
    bool key(std::string& name) {
        if (open_.back()->find(name) != nullptr) {
            throw Error(Status::PROFILE_MALFORMED, "member " + json_text(name) + " is there twice");
        }
        key_ = name;
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const json::exception& error) {
        constexpr int number_overflow = 406;
        throw Error(error.id == number_overflow ? Status::PROFILE_RANGE : Status::PROFILE_MALFORMED,
                    plain_words(error.what()));
    }

private:
    JsonNode& add(JsonNode::Type type) {
        JsonNode* node = &root_;
        if (!open_.empty()) {
            open_.back()->members.emplace_back(std::move(key_), JsonNode{});
            key_.clear();
            node = &open_.back()->members.back().second;
        }
        node->type = type;
        return *node;
    }
    bool open(JsonNode::Type type) {
        if (open_.size() >= deepest)
            throw Error(Status::PROFILE_MALFORMED, "nested more than " + std::to_string(deepest) + " deep");
        open_.push_back(&add(type));
        return true;
    }
    bool close() {
        open_.pop_back();
        return true;
    }

    JsonNode& root_;
    std::vector<JsonNode*> open_; // members are only added to the last, so the others do not move
    std::string key_;
};

} // namespace

const JsonNode* JsonNode::find(const std::string& name) const {
    for (const auto& member : members) {
        if (member.first == name) return &member.second;
    }
    return nullptr;
}

std::string JsonNode::excerpt() const {
    std::string words;
    switch (type) {
        case Type::null:
            return "null";
        case Type::boolean:
            return boolean ? "true" : "false";
        case Type::whole:
            return std::to_string(whole);
        case Type::number:
            return json_number(number);
        case Type::object:
            return "an object";
        case Type::list:
            return "a list";
        case Type::text:
            words = json_text(text);
            break;
    }
    return words.size() > 60 ? words.substr(0, 57) + "..." : words;
}

JsonNode parse_json(const std::string& text) {
    // The parser takes a zero for the end and would not look at what follows.
    if (text.find('\0') != std::string::npos) throw Error(Status::PROFILE_MALFORMED, "holds a zero byte");
    // The parser hands numbers to strtod and asks the locale for its decimal point, of which it takes one byte.
    const PlainLocale plain;
    JsonNode root;
    Builder builder(root);
    json::sax_parse(text, &builder);
    return root;
}

std::string json_text(const std::string& text) {
    return json(text).dump(-1, ' ', true, json::error_handler_t::replace);
}

std::string json_number(double number) { return std::isfinite(number) ? json(number).dump() : "null"; }

} // namespace raywise
