// What a profile calls its own codes and lines.

#include "emulator/behaviour/own_words.h"

#include <doctest/doctest.h>

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
    CHECK(explain(*profile, protocol::decode_line("M105", Direction::to_board)).find("temperatures") !=
          std::string::npos);
    CHECK(words_of(*profile, "M2999 S\x1b", Direction::to_board).find('\x1b') == std::string::npos);
}

TEST_CASE("own words: the A30's board says by L18 what its own program means, not what the A30T's does") {
    const auto a30 = host::load_profile_by_name("geeetech-a30");
    CHECK(words_of(*a30, "L18 P26 S3") == "exception: message page, bed temperature abnormal");
    CHECK(words_of(*a30, "L18 P26 S8") == "exception: message page, no card");
    for (const Frame& frame : a30->frames) {
        if (frame.name.starts_with("L18.")) {
            REQUIRE_FALSE(frame.lines.empty());
        }
    }
    CHECK(a30->words.size() == 8);
    CHECK(host::load_profile_by_name("geeetech-a30t")->words.empty());
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
