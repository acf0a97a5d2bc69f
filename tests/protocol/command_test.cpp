#include "protocol/command.h"

#include <doctest/doctest.h>

#include <charconv>
#include <cmath>
#include <random>
#include <string>

using namespace fauxboard::protocol;

namespace {

Command parse(std::string_view body) {
    const auto command = parse_command(body);
    REQUIRE(command.has_value());
    return *command;
}

}  // namespace

TEST_CASE("a code, its number and its parameters") {
    const Command move = parse("G1 F6000 X-30.00");
    CHECK(move.letter == 'G');
    CHECK(move.number == 1);
    CHECK(move.word == "G1");
    CHECK(move.text == " F6000 X-30.00");
    CHECK(move.argument == "F6000 X-30.00");
    CHECK(move.number_of('F') == 6000.0);
    CHECK(move.number_of('X') == -30.0);
    CHECK_FALSE(move.number_of('Y').has_value());
    CHECK(move.has('X'));
    CHECK_FALSE(move.has('Y'));
    CHECK_FALSE(move.has('x'));
    CHECK_FALSE(move.has('@'));
    CHECK_FALSE(move.has('['));
}

TEST_CASE("parameters without blanks, and letters that are none") {
    const Command packed = parse("G1X10Y-.5Z+2.E1F600");
    CHECK(packed.number_of('X') == 10.0);
    CHECK(packed.number_of('Y') == -0.5);
    CHECK(packed.number_of('Z') == 2.0);
    CHECK(packed.number_of('E') == 1.0);
    CHECK(packed.number_of('F') == 600.0);
    const Command lcd = parse("M20 LCD");
    CHECK(lcd.has('L'));
    CHECK_FALSE(lcd.has('C'));
    CHECK_FALSE(parse("M117 hello World").has('H'));
    CHECK(parse("M117 hello World").has('W'));
    CHECK_FALSE(parse("M117 xS5").has('S'));
}

TEST_CASE("a capital E is the extruder, a small one an exponent") {
    const Command command = parse("G1 X1E2 Y1e2");
    CHECK(command.number_of('X') == 1.0);
    CHECK(command.number_of('E') == 2.0);
    CHECK(command.number_of('Y') == 100.0);
    CHECK(parse("M104 S2e").number_of('S') == 2.0);
    CHECK(parse("M104 S2e-1").number_of('S') == 0.2);
}

TEST_CASE("odd parameters") {
    CHECK(parse("G28 X").number_of('X') == 0.0);
    CHECK_FALSE(parse("M104").number_of('S').has_value());
    CHECK(parse("M104 S1e99").number_of('S') == 1e30);
    CHECK(parse("M104 S-1e99").number_of('S') == -1e30);
    CHECK(parse("M104 S1e-999").number_of('S') == 0.0);
    CHECK(parse("M104 S1e99999999999999999999").number_of('S') == 1e30);
    CHECK(parse("M290 Z").number_of('Z') == 0.0);
    for (const std::string_view body : {"M104 Snan", "M104 Sinf", "M104 S-inf", "M104 S0x10", "M104 S-",
                                        "M104 S.", "M104 S-.e5", "M104 S*", "M104 S--1"}) {
        CAPTURE(body);
        CHECK(parse(body).number_of('S') == 0.0);
    }
    CHECK(parse("M104 S100 S200").number_of('S') == 100.0);
    CHECK(parse("M104 S 55").number_of('S') == 55.0);
    CHECK(parse("M104 S 55").number_of('S') == 55.0);
    CHECK(parse("M104 S12abc").number_of('S') == 12.0);
    CHECK(parse("M104 S0.0").number_of('S') == 0.0);
    CHECK(std::signbit(*parse("M290 Z-0.00").number_of('Z')));
    CHECK(parse("M104 S" + std::string(400, '9')).number_of('S') == 1e30);
    CHECK(parse("M104 S0." + std::string(400, '0') + "1").number_of('S') == 0.0);
    CHECK(parse("M104 S0." + std::string(400, '0') + "25e401").number_of('S') == 2.5);
}

TEST_CASE("codes") {
    CHECK(parse("T0").letter == 'T');
    CHECK(parse("T0").number == 0);
    CHECK(parse("L101").number == 101);
    CHECK(parse("M65535").number == 65535);
    CHECK(parse("M0105 S1").number == 105);
    CHECK(parse("  M105").word == "M105");
    CHECK(parse("G28.1").text == ".1");
    for (const char* word : {"M65536", "M99999", "M99999999999999999999"}) {
        CHECK(parse(word).letter == 0);
        CHECK(parse(word).number == 0);
        CHECK(parse(word).word == word);
    }
    CHECK_FALSE(parse_command("").has_value());
    CHECK_FALSE(parse_command(" \t ").has_value());
}

TEST_CASE("words and junk") {
    struct Row {
        std::string_view body, word, argument;
    };
    const Row rows[] = {
        {"log Geeetech LCD OK", "log", "Geeetech LCD OK"},
        {"?!", "?!", ""},
        {"x:12,y:30;", "x:12,y:30;", ""},
        {"M", "M", ""},
        {"G 28", "G", "28"},
        {"g28 X", "g28", "X"},
        {"X10", "X10", ""},
        {"\xFF\xFE z", "\xFF\xFE", "z"},
        {"M-1", "M-1", ""},
    };
    for (const Row& row : rows) {
        CAPTURE(row.body);
        const Command command = parse(row.body);
        CHECK(command.letter == 0);
        CHECK(command.number == 0);
        CHECK(command.word == row.word);
        CHECK(command.argument == row.argument);
    }
}

TEST_CASE("texts") {
    CHECK(parse("M117 Layer 1/21").text == " Layer 1/21");
    CHECK(parse("M117").text.empty());
    CHECK(parse("M23   a b.gco  ").argument == "a b.gco");
    const Command version = parse("M2134 FW:V1.02.xx rest");
    CHECK(version.value_of("FW:") == "V1.02.xx");
    CHECK(version.value_of("W:").empty());
    CHECK(version.value_of("").empty());
    CHECK(parse("M20 file:SD1:/A30T").value_of("file:") == "SD1:/A30T");
    CHECK(parse("M20 file:SD1:/A30T").value_of("SD1:").empty());
    CHECK(parse("L9 DN:a;DM:b;").value_of("DM:") == "b;");
}

TEST_CASE("a default command has no parameters") {
    const Command none;
    CHECK_FALSE(none.has('A'));
    CHECK_FALSE(none.number_of('Z').has_value());
}

TEST_CASE("a parameter is found however far along it stands") {
    const std::string body = "M117 " + std::string(40000, 'a') + " S5 ";
    CHECK(parse(body).number_of('S') == 5.0);
    CHECK(parse("M117 S5 " + std::string(40000, 'a')).number_of('S') == 5.0);
}

TEST_CASE("property: numbers read as the standard library reads them") {
    std::mt19937_64 random(3);
    for (int round = 0; round < 20000; ++round) {
        std::string text = random() % 2 == 0 ? "-" : "";
        text += std::to_string(random() >> (random() % 64));
        if (random() % 2 == 0) text += '.' + std::to_string(random() >> (random() % 64));
        if (random() % 4 == 0) text += 'e' + std::to_string(static_cast<int>(random() % 60) - 50);
        double wanted = 0;
        std::from_chars(text.data(), text.data() + text.size(), wanted);
        wanted = std::max(-1e30, std::min(1e30, wanted));
        CAPTURE(text);
        REQUIRE(parse("M290 Z" + text).number_of('Z') == wanted);
    }
}

TEST_CASE("property: random bodies are taken without harm") {
    std::mt19937 random(5);
    const std::string_view alphabet = "GMTLXSE019.-+e: *\xFF";
    std::size_t codes = 0;
    for (int round = 0; round < 20000; ++round) {
        std::string body(random() % 20, ' ');
        for (char& byte : body) {
            byte = alphabet[random() % alphabet.size()];
        }
        const auto command = parse_command(body);
        if (!command) continue;
        if (command->letter != 0) ++codes;
        REQUIRE_FALSE(command->word.empty());
        for (char letter = 'A'; letter <= 'Z'; ++letter) {
            const auto number = command->number_of(letter);
            REQUIRE(number.has_value() == command->has(letter));
            if (number) REQUIRE(std::abs(*number) <= 1e30);
        }
    }
    CHECK(codes > 500);
}
