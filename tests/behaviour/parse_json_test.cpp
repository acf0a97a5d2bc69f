#include "emulator/behaviour/parse_json.h"

#include <doctest/doctest.h>

#include <string>

namespace fauxboard::behaviour {
namespace {

std::string nested(std::size_t levels) {
    return std::string(levels, '[') + std::string(levels, ']');
}

TEST_CASE("JSON from outside is as deep as it may be, and no deeper") {
    CHECK(parse_json(nested(most_levels)).is_array());
    CHECK(parse_json(nested(most_levels + 1)).is_discarded());
    CHECK(parse_json(nested(5'000'000)).is_discarded());
    CHECK(parse_json(std::string(5'000'000, '[')).is_discarded());
    CHECK(parse_json("{\"a\":" + nested(most_levels - 1) + "}").is_object());
    CHECK(parse_json("{\"a\":" + nested(most_levels) + "}").is_discarded());
}

TEST_CASE("brackets side by side, and in texts, are no levels") {
    std::string row = "[";
    for (int i = 0; i < 1000; ++i) {
        row += "[{}],";
    }
    CHECK(parse_json(row + "1]").size() == 1001);
    const std::string brackets(1000, '{');
    CHECK(parse_json("\"" + brackets + "\"") == brackets);
    CHECK(parse_json(R"(["\"", "\\", ")" + brackets + "\"]").size() == 3);
}

TEST_CASE("what is no JSON is told as such") {
    for (const char* text : {"", "]]]]", "[", "\"", "\"\\", "{\"a\"}", "[1,]", "nul", "1 2"}) {
        CAPTURE(text);
        CHECK(parse_json(text).is_discarded());
    }
}

}  // namespace
}  // namespace fauxboard::behaviour
