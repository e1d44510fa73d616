// The profile's format is distrusted member by member: each one is removed, retyped and set beyond belief.
#include "model/profile.h"
#include "profile_fixture.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace raywise {
namespace {

using nlohmann::json;

// OK when the text is accepted.
Status status_of(const std::string& text, std::string* message = nullptr) {
    try {
        parse_profile(text);
        return Status::OK;
    } catch (const Error& error) {
        if (message) *message = error.what();
        return error.status();
    }
}

Status status_of(const json& document, std::string* message = nullptr) { return status_of(document.dump(), message); }

const json& valid() {
    static const json document = json::parse(to_json(sample_profile()));
    return document;
}

// All members, objects included, as JSON pointers.
void collect(const json& value, const json::json_pointer& place, std::vector<json::json_pointer>& places) {
    if (!value.is_object()) return;
    for (const auto& item : value.items()) {
        const json::json_pointer member = place / item.key();
        places.push_back(member);
        collect(item.value(), member, places);
    }
}

std::vector<json::json_pointer> all_members() {
    std::vector<json::json_pointer> places;
    collect(valid(), json::json_pointer(), places);
    return places;
}

// "/structures/bvh/bytes" -> "structures.bvh.bytes", as in messages
std::string message_name(const json::json_pointer& place) {
    std::string name = place.to_string().substr(1);
    for (char& c : name) c = c == '/' ? '.' : c;
    return name;
}

bool is_whole(const json& value) { return value.is_number_integer(); }

TEST(ProfileJson, IsReadAsItWasWritten) {
    const std::string text = to_json(sample_profile());
    const Profile read = parse_profile(text);
    EXPECT_EQ(to_json(read), text);
    EXPECT_EQ(read.machine.key(), this_machine().key());
    EXPECT_EQ(read.provenance.spread, 0.021);
    EXPECT_EQ(read.constants.structures[Structure::kd_tree].ray_ns[2].per_unit,
              sample_profile().constants.structures[Structure::kd_tree].ray_ns[2].per_unit);
}

TEST(ProfileJson, HasManyMembers) { EXPECT_GT(all_members().size(), 100u); }

TEST(ProfileJson, EveryMemberIsRequired) {
    for (const json::json_pointer& place : all_members()) {
        json document = valid();
        document[place.parent_pointer()].erase(place.back());
        std::string message;
        EXPECT_EQ(status_of(document, &message), Status::PROFILE_MALFORMED) << place;
        EXPECT_NE(message.find(message_name(place) + ": is missing"), std::string::npos) << message;
    }
}

TEST(ProfileJson, NoMemberIsBesides) {
    std::vector<json::json_pointer> places = all_members();
    places.emplace_back(); // the document itself
    for (const json::json_pointer& place : places) {
        json document = valid();
        if (!document[place].is_object()) continue;
        document[place]["quad_tree"] = document[place].begin().value();
        std::string message;
        EXPECT_EQ(status_of(document, &message), Status::PROFILE_MALFORMED) << place;
        EXPECT_NE(message.find("quad_tree"), std::string::npos) << message;
    }
}

TEST(ProfileJson, NoMemberMayHaveAnotherType) {
    const std::vector<json> values = {nullptr, true, "text", 7, json::array(), json::object(), json::array({1.0})};
    for (const json::json_pointer& place : all_members()) {
        for (const json& value : values) {
            json document = valid();
            if (document[place].type() == value.type()) continue;
            if (document[place].is_number() && value.is_number()) continue; // 7 is as good as 7.5
            document[place] = value;
            std::string message;
            EXPECT_EQ(status_of(document, &message), Status::PROFILE_MALFORMED) << place << " " << value;
            EXPECT_NE(message.find(message_name(place)), std::string::npos) << message;
        }
    }
}

TEST(ProfileJson, NoNumberMayBeAbsurd) {
    const std::vector<json> values = {-1, -0.001, 1e300, 18446744073709551615u};
    for (const json::json_pointer& place : all_members()) {
        if (!valid()[place].is_number()) continue;
        for (const json& value : values) {
            json document = valid();
            document[place] = value;
            std::string message;
            EXPECT_EQ(status_of(document, &message), Status::PROFILE_RANGE) << place << " " << value;
            EXPECT_NE(message.find(message_name(place)), std::string::npos) << message;
            EXPECT_NE(message.find(value.dump()), std::string::npos) << message;
        }
    }
}

TEST(ProfileJson, NoNumberMayBeNotFinite) {
    for (const json::json_pointer& place : all_members()) {
        if (!valid()[place].is_number()) continue;
        json document = valid();
        document[place] = "PLACE";
        const std::string text = document.dump();
        const std::string mark = "\"PLACE\"";
        const auto with = [&](const std::string& value) {
            std::string changed = text;
            return changed.replace(changed.find(mark), mark.size(), value);
        };
        for (const char* value : {"NaN", "nan", "Infinity", "-Infinity", "inf", "0x10", "1e", "+1", ".5", "1.", ""}) {
            EXPECT_EQ(status_of(with(value)), Status::PROFILE_MALFORMED) << place << " " << value;
        }
        EXPECT_EQ(status_of(with("1e999")), Status::PROFILE_RANGE) << place;
        EXPECT_EQ(status_of(with("-1e999")), Status::PROFILE_RANGE) << place;
    }
}

TEST(ProfileJson, WholeNumbersAreWhole) {
    for (const json::json_pointer& place : all_members()) {
        if (!is_whole(valid()[place])) continue;
        json document = valid();
        document[place] = 1.5;
        EXPECT_EQ(status_of(document), Status::PROFILE_RANGE) << place;
    }
}

TEST(ProfileJson, NothingTakesNoTime) {
    for (const json::json_pointer& place : all_members()) {
        if (!valid()[place].is_object() || !valid()[place].contains("per_unit")) continue;
        json document = valid();
        document[place]["fixed"] = 0.0;
        EXPECT_EQ(status_of(document), Status::OK) << place;
        for (auto& part : document[place]["per_unit"]) part = 0.0;
        // Memory is another matter.
        EXPECT_EQ(status_of(document), place.back() == "bytes" ? Status::OK : Status::PROFILE_RANGE) << place;
    }
    for (const char* place : {"/hapala/build_ns_per_n_log_n", "/hapala/ray_ns_per_log_n", "/primitive_test_ns",
                              "/node_step_ns", "/machine/threads"}) {
        json document = valid();
        document[json::json_pointer(place)] = 0;
        EXPECT_EQ(status_of(document), Status::PROFILE_RANGE) << place;
    }
}

TEST(ProfileJson, UnitsAreThoseOfTheStructure) {
    for (const Structure structure : all_structures()) {
        const json& costs = valid()["structures"][name_of(structure)];
        const auto expect_units = [&](const json& cost, const CostUnits& units) {
            EXPECT_EQ(cost["per_unit"].size(), units.size());
            for (const CostUnit& unit : units) EXPECT_TRUE(cost["per_unit"].contains(unit.name)) << unit.name;
        };
        expect_units(costs["build_ns"], build_units(structure));
        expect_units(costs["bytes"], byte_units(structure));
        for (const char* kind : measured_ray_kind_names) expect_units(costs["ray_ns"][kind], ray_units(structure));
    }
    json document = valid();
    json& per_unit = document["structures"]["linear_scan"]["build_ns"]["per_unit"];
    per_unit["M"] = per_unit["N"];
    per_unit.erase("N");
    std::string message;
    EXPECT_EQ(status_of(document, &message), Status::PROFILE_MALFORMED);
    EXPECT_NE(message.find("structures.linear_scan.build_ns.per_unit"), std::string::npos) << message;
}

TEST(ProfileJson, AnotherSchemaIsToldFirst) {
    json document = valid();
    document["schema"] = "raywise-profile/1";
    document.erase("structures");
    document["epoch"] = 99;
    std::string message;
    EXPECT_EQ(status_of(document, &message), Status::PROFILE_SCHEMA);
    EXPECT_NE(message.find("raywise-profile/1"), std::string::npos) << message;
    EXPECT_NE(message.find("raywise-profile/2"), std::string::npos) << message;
}

TEST(ProfileJson, AnotherEpochIsToldBeforeTheRest) {
    json document = valid();
    document["epoch"] = calibration_epoch + 1;
    document.erase("structures");
    std::string message;
    EXPECT_EQ(status_of(document, &message), Status::PROFILE_EPOCH);
    EXPECT_NE(message.find("epoch " + std::to_string(calibration_epoch)), std::string::npos) << message;
    EXPECT_NE(message.find("it is " + std::to_string(calibration_epoch + 1)), std::string::npos) << message;
}

TEST(ProfileJson, CutOffAnywhereIsMalformed) {
    const std::string text = to_json(sample_profile());
    for (std::size_t length = 0; length + 2 < text.size(); ++length) { // without "}\n"
        ASSERT_EQ(status_of(text.substr(0, length)), Status::PROFILE_MALFORMED) << length;
    }
}

TEST(ProfileJson, ADamagedByteNeverGetsFurtherThanAStatus) {
    const std::string text = to_json(sample_profile());
    const std::string bytes("\0\xFF{\"9- ", 7);
    for (std::size_t i = 0; i < text.size(); ++i) {
        std::string damaged = text;
        damaged[i] = bytes[i % bytes.size()];
        static_cast<void>(status_of(damaged)); // must not throw anything but Error
    }
}

TEST(ProfileJson, OtherTextsAreMalformed) {
    for (const char* text : {"", " ", "null", "7", "\"raywise-profile/2\"", "[]", "{}", "{} {}", "// comment\n{}",
                             "{\"schema\":", "\xEF\xBB\xBF", "\xFF\xFE", "{\"schema\": \"\xFF\"}", "<xml/>"}) {
        EXPECT_EQ(status_of(std::string(text)), Status::PROFILE_MALFORMED) << text;
    }
    EXPECT_EQ(status_of(to_json(sample_profile()) + "{}"), Status::PROFILE_MALFORMED);
    EXPECT_EQ(status_of(to_json(sample_profile()) + std::string(1, '\0')), Status::PROFILE_MALFORMED);
}

TEST(ProfileJson, DeepNestingIsMalformedAndHarmless) {
    for (const char* opening : {"[", "{\"a\":"}) {
        std::string text;
        while (text.size() < (1u << 20)) text += opening;
        EXPECT_EQ(status_of(text), Status::PROFILE_MALFORMED);
    }
}

TEST(ProfileJson, AMemberGivenTwiceIsMalformed) {
    std::string text = to_json(sample_profile());
    const std::string member = "\"epoch\": " + std::to_string(calibration_epoch) + ",";
    text.insert(text.find(member), member);
    std::string message;
    EXPECT_EQ(status_of(text, &message), Status::PROFILE_MALFORMED);
    EXPECT_NE(message.find("\"epoch\" is there twice"), std::string::npos) << message;
}

TEST(ProfileJson, TextsAreFitForTerminals) {
    for (const std::string& text : {std::string("\x1B[2J"), std::string("a\nb"), std::string("\x7F"),
                                    std::string("a\0b", 3), std::string(5000, 'x')}) {
        json document = valid();
        document["provenance"]["tool"] = text;
        std::string message;
        EXPECT_EQ(status_of(document, &message), Status::PROFILE_MALFORMED);
        EXPECT_EQ(message.find_first_of("\x1B\n\x7F"), std::string::npos);
        EXPECT_LT(message.size(), 300u);
    }
}

// What the parser itself complains about it quotes.
TEST(ProfileJson, QuotesOfBrokenTextsAreFitForTerminals) {
    for (const char* text : {"\x7F", "\"\x7F\xFF\"", "{\"a\x1B[2J\"", "[\"\xC2\x9B\""}) {
        try {
            parse_profile(text);
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.status(), Status::PROFILE_MALFORMED);
            const std::string message = error.what();
            EXPECT_TRUE(std::all_of(message.begin(), message.end(), [](char c) { return c >= ' ' && c <= '~'; }))
                << message;
        }
    }
}

TEST(GenericProfile, IsValid) {
    const Profile& profile = generic_profile();
    EXPECT_EQ(profile.source, ProfileSource::generic);
    EXPECT_EQ(profile.status, Status::OK);
    EXPECT_EQ(status_of(to_json(profile)), Status::OK);
}

} // namespace
} // namespace raywise
