#include "emulator/script/units.h"

#include <doctest/doctest.h>

#include "emulator/script/pattern.h"
#include "emulator/script/placeholders.h"

namespace fauxboard::script {
namespace {

TEST_CASE("units: a quantity is in its own unit, or in one of its family") {
    CHECK(quantity_from_text("200C", "C") == 200);
    CHECK(quantity_from_text("1.5min", "s") == 90);
    CHECK(quantity_from_text("500ms", "s") == 0.5);
    CHECK(*quantity_from_text("6000mm/min", "mm/s") == doctest::Approx(100));
    CHECK(*quantity_from_text("100mm/s", "mm/min") == doctest::Approx(6000));
    CHECK(quantity_from_text("2cm", "mm") == 20);
    CHECK(quantity_from_text("-1.25mm", "mm") == -1.25);
    CHECK(quantity_from_text("1.2A", "mA") == 1200);
    CHECK(quantity_from_text("7", "") == 7);
}

TEST_CASE("units: what is no quantity of that family is nothing") {
    for (const char* text : {"200", "200K", "C", "", "200 C", "0x10C", "1e3C", "nanC", "infC", "2mm"}) {
        CAPTURE(text);
        CHECK_FALSE(quantity_from_text(text, "C"));
    }
    CHECK_FALSE(quantity_from_text("7C", ""));
}

TEST_CASE("units: times are not negative and have an end") {
    CHECK(time_from_text("500ms") == SimTime{500'000});
    CHECK(time_from_text("2h") == SimTime{7'200'000'000});
    CHECK(time_from_text("0s") == SimTime{0});
    CHECK(time_from_text("1d") == SimTime{86'400'000'000});
    for (const char* text : {"-1s", "5", "1w", "99999999999999h", "s", ""}) {
        CAPTURE(text);
        CHECK_FALSE(time_from_text(text));
    }
}

TEST_CASE("units: times in words") {
    CHECK(time_words(SimTime{500'000}) == "500 ms");
    CHECK(time_words(SimTime{1'500'000}) == "1.5 s");
    CHECK(time_words(SimTime{60'000'000}) == "1 min");
    CHECK(time_words(SimTime{200'000'000}) == "3 min 20 s");
    CHECK(time_words(SimTime{7'200'000'000}) == "2 h");
    CHECK(time_words(SimTime{5'400'000'000}) == "1 h 30 min");
}

TEST_CASE("patterns: found anywhere, groups by name, bytes as Latin-1") {
    const Pattern pattern(R"(^M104 S(?P<target>[0-9.]+))");
    Captures captures;
    CHECK(pattern.search("M104 S205.5 T0", captures));
    CHECK(captures.at("target") == "205.5");
    CHECK_FALSE(pattern.search("N-0 M104 S1", captures));
    CHECK(captures.at("target") == "205.5");
    CHECK(Pattern("ü").search("gr\xfcn", captures));
    CHECK(pattern.names() == std::vector<std::string>{"target"});
}

TEST_CASE("patterns: a wrong one says what is wrong, and none can hold anybody up") {
    for (const char* text : {"", "(", "[a", "a**", "(?P<x>", "a{2000}", "\\", "\u20ac"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(Pattern{text}, PatternError);
    }
    CHECK_THROWS_AS(Pattern(std::string(2000, 'a')), PatternError);
    // Exponential for a matcher that backtracks.
    Captures captures;
    CHECK_FALSE(Pattern("(a+)+$").search(std::string(5000, 'a') + "b", captures));
}

TEST_CASE("placeholders: whole texts take values, parts of texts their words") {
    const auto lookup = [](std::string_view name) -> std::optional<Json> {
        return name == "n" ? std::optional<Json>(5) : name == "t" ? std::optional<Json>("x") : std::nullopt;
    };
    const auto fill = [&](const char* json) {
        return filled(Json::parse(json), lookup, Escapes::resolve, true).dump();
    };
    CHECK(fill(R"(["${n}", "a${n}b${t}", "$${n}", "${m}", "$5", "${", "${1}"])") ==
          R"([5,"a5bx","${n}","${m}","$5","${","${1}"])");
    CHECK(fill(R"({"steps": ["${n}"]})") == R"({"steps":[5]})");
    CHECK(
        filled(Json::parse(R"({"steps": ["${n}"], "x": "${n}"})"), lookup, Escapes::resolve, false).dump() ==
        R"({"steps":["${n}"],"x":5})");
    CHECK(filled(Json("$${n}"), lookup, Escapes::keep, true) == "$${n}");
    const auto found = mentions(Json::parse(R"({"a": ["${x}"], "b": "$${y} ${"})"), "", true);
    REQUIRE(found.size() == 2);
    CHECK(found[0].name == "x");
    CHECK(found[0].pointer == "/a/0");
    CHECK(found[1].name.empty());
}

}  // namespace
}  // namespace fauxboard::script
