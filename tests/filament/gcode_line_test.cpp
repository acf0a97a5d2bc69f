#include "emulator/filament/gcode_line.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace fauxboard::filament;

namespace {

GcodeLine parse(std::string_view text) {
    GcodeLine line;
    parse_gcode(text, line);
    return line;
}

std::string code(std::string_view text) {
    const GcodeLine line = parse(text);
    return line.letter == 0 ? "" : line.letter + std::to_string(line.code);
}

}  // namespace

TEST_CASE("gcode: a move, as slicers write it") {
    const GcodeLine line = parse("G1 X104.453 Y-0.5 E.03125 F1800 ; perimeter");
    CHECK(line.letter == 'G');
    CHECK(line.code == 1);
    CHECK(line.number('X') == doctest::Approx(104.453).epsilon(1e-12));
    CHECK(line.number('Y') == -0.5);
    CHECK(line.number('E') == 0.03125);
    CHECK(line.number('F') == 1800);
    CHECK_FALSE(line.has('Z'));
    CHECK(line.number('Z', 7) == 7);
    CHECK(line.comment == " perimeter");
    CHECK(line.text == "X104.453 Y-0.5 E.03125 F1800");
}

TEST_CASE("gcode: blanks, line numbers, checksums, remarks and control bytes are no hindrance") {
    for (const std::string text :
         {"G1X5Y6", "  G1\tX5   Y6\r", "N42 G1 X5 Y6*103", "N42G1X5Y6 *3", "(a G0) G1 X5 (Y9) Y6",
          "G01 X+5.0 Y06", "G1 X 5 Y 6", "G1.1 X5 Y6", "N1 (x) G1 X5 Y6;Z7"}) {
        CAPTURE(text);
        const GcodeLine line = parse(text);
        CHECK(code(text) == "G1");
        CHECK(line.number('X') == 5);
        CHECK(line.number('Y') == 6);
        CHECK_FALSE(line.has('Z'));
    }
    CHECK(parse(std::string_view("G1\0X5\0Y6", 8)).number('Y') == 6);
}

TEST_CASE("gcode: E is a parameter, never an exponent") {
    const GcodeLine line = parse("G1 X1E5");
    CHECK(line.number('X') == 1);
    CHECK(line.number('E') == 5);
}

TEST_CASE("gcode: lines without a command") {
    for (const char* text : {"", "   ", ";LAYER:3", "(remark)", "%", "*12", "123", "\xEF\xBB\xBF"}) {
        CAPTURE(std::string(text));
        CHECK(code(text).empty());
    }
    CHECK(parse(";LAYER:3").comment == "LAYER:3");
    CHECK(parse("  ; x;y").comment == " x;y");
}

TEST_CASE("gcode: a word is no code, and neither are small letters") {
    for (const char* text :
         {"TIMELAPSE_TAKE_FRAME", "GET_POSITION", "MESH_CLEAR", "M", "Mx", "T-1", "Gcode 1"}) {
        CAPTURE(std::string(text));
        CHECK(parse(text).code == GcodeLine::no_code);
    }
    CHECK(parse("g1 X5").letter == 'g');
    CHECK_FALSE(parse("G1 x5").has('X'));
}

TEST_CASE("gcode: parameters without a number, twice, and numbers beyond reason") {
    CHECK(parse("G28 X Y").has('X'));
    CHECK(parse("G28 X Y").number('X', 9) == 0);
    CHECK(parse("G1 X1 X2").number('X') == 2);
    CHECK(parse("G1 X99999999999999999999999999").number('X') == 1e9);
    CHECK(parse("G1 X-99999999999").number('X') == -1e9);
    CHECK(parse("G1 X0.00000000000000000000000000000001").number('X') == 0);
    CHECK(parse("G1 X1.23456789012345678901234567890").number('X') ==
          doctest::Approx(1.2345678901234567).epsilon(1e-15));
    CHECK(parse("G1 X--5").number('X') == 0);
    CHECK(code("M99999999999") == "M99999");
}

TEST_CASE("gcode: the text of a message ends at the comment, blanks at its ends off") {
    CHECK(parse("M117 Layer 1 of 2 ; said").text == "Layer 1 of 2");
    CHECK(parse("M117").text.empty());
    CHECK(parse("M117 ").text.empty());
    CHECK(parse("M117hello").text == "hello");
}

TEST_CASE("gcode: any bytes give some result, with finite numbers") {
    std::uint64_t state = 7;
    for (int round = 0; round < 20000; ++round) {
        std::string text;
        for (int i = 0; i < 24; ++i) {
            state = state * 6364136223846793005ULL + 1442695040888963407ULL;
            constexpr std::string_view likely = "GMTXYZEFS0123456789.-+ ;*(\0\r";
            text += state >> 63U ? likely[(state >> 33U) % likely.size()] : static_cast<char>(state >> 40U);
        }
        const GcodeLine line = parse(text);
        for (char name = 'A'; name <= 'Z'; ++name) {
            const double value = line.number(name);
            REQUIRE(std::isfinite(value));
            REQUIRE(std::abs(value) <= 1e9);
        }
        REQUIRE(line.code >= GcodeLine::no_code);
        REQUIRE(line.text.size() <= text.size());
    }
}
