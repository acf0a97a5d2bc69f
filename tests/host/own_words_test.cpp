// What a profile calls its own codes and lines.

#include "emulator/behaviour/own_words.h"

#include <doctest/doctest.h>

#include <cctype>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "emulator/behaviour/profile.h"
#include "emulator/host/profile_files.h"

namespace fauxboard::behaviour {
namespace {

using protocol::Direction;

std::shared_ptr<const Profile> with(const std::string& words) {
    return load_profile(
        {"mine.json", R"({"name": "mine", "extends": "geeetech-a30t", "words": )" + words + "}"},
        host::profile_finder());
}

std::string words_of(const Profile& profile, std::string_view line,
                     Direction direction = Direction::to_screen) {
    return own_words(profile, protocol::decode_line(line, direction));
}

TEST_CASE("own words: of a code, with its fields, and of the longest beginning of a line") {
    const auto profile = with(R"({
        "M2999": { "title": "blow", "fields": { "S": "power" } },
        "L18": "exception", "L18 P26 S3": "too cold", "L18 P26": "page 26" })");
    CHECK(words_of(*profile, "N-0 M2999 S3*87", Direction::to_board) == "blow: power 3");
    CHECK(words_of(*profile, "M2999 P1", Direction::to_board) == "blow");
    CHECK(words_of(*profile, "L18 P26 S3") == "too cold");
    CHECK(words_of(*profile, "L18 P26 S30") == "page 26");
    CHECK(words_of(*profile, "L18 P2") == "exception");
    CHECK(words_of(*profile, "L180") == "");
    CHECK(words_of(*profile, "L1 X0.000 Y0.000 Z0.000 F0") == "");
    CHECK(explain(*profile, protocol::decode_line("L18 P2", Direction::to_screen)) == "exception");
    CHECK(explain(*profile, protocol::decode_line("L1 X1 Y2 Z3 F4", Direction::to_screen)).find("position") !=
          std::string::npos);
    CHECK(words_of(*profile, "M2999 S\x1b", Direction::to_board).find('\x1b') == std::string::npos);
}

TEST_CASE("own words: the A30's board says by L18 what its own program means, not what the A30T's does") {
    const auto a30 = host::load_profile_by_name("geeetech-a30");
    CHECK(words_of(*a30, "L18 P26 S3") == "exception: message page, bed temperature abnormal");
    CHECK(words_of(*a30, "L18 P26 S8") == "exception: message page, SD card removed");
    CHECK(host::load_profile_by_name("geeetech-a30t")->words.empty());
}

/// What a screen shows of an exception, by its number; those of what it extends first.
std::map<std::string, std::string> shown_by(std::initializer_list<const char*> screens) {
    std::map<std::string, std::string> out;
    for (const char* name : screens) {
        std::ifstream in(std::string(FAUXBOARD_SOURCE_DIR "/profiles/screens/") + name + ".json");
        const auto names = nlohmann::json::parse(in)["values"]["exception.code"]["names"];
        for (const auto& [code, text] : names.items()) {
            text.is_null() ? void(out.erase(code)) : void(out[code] = text.get<std::string>());
        }
    }
    return out;
}

std::string small(std::string text) {
    for (char& c : text) {
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return text;
}

TEST_CASE("what a screen shows of an exception is what decode and the reference say of it") {
    const auto a30t = host::load_profile_by_name("geeetech-a30t");
    for (const auto& [code, text] : shown_by({"smartto-screen"})) {
        CHECK(small(explain(*a30t, protocol::decode_line("L18 P26 S" + code, Direction::to_screen))) ==
              small("exception: message page, " + text));
    }
    const auto a30 = host::load_profile_by_name("geeetech-a30");
    const auto shown = shown_by({"smartto-screen", "geeetech-a30"});
    const std::string page = "L18 P26 S";
    for (const auto& [line, words] : a30->words) {
        if (line.starts_with(page)) {
            REQUIRE(shown.contains(line.substr(page.size())));
            CHECK(small(words.title) ==
                  small("exception: message page, " + shown.at(line.substr(page.size()))));
        }
    }
}

TEST_CASE("own words: mistakes are told") {
    for (const char* wrong :
         {R"(7)", R"({"": "x"})", R"({"M1 ": "x"})", R"({"M1": 7})", R"({"M1": {}})",
          R"({"M1": {"title": "t", "feilds": {}}})", R"({"M1": {"title": "t", "fields": {"S": 1}}})"}) {
        CAPTURE(wrong);
        CHECK_THROWS_WITH_AS(with(wrong), doctest::Contains("/words"), ProfileError);
    }
}

}  // namespace
}  // namespace fauxboard::behaviour
