#include "emulator/record/transcript_words.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace fauxboard::record {
namespace {

JudgedLine judged(const std::string& text) {
    std::istringstream in(text);
    TranscriptReader reader(in, "file");
    return judge(reader.next().value(), line_judges());
}

std::string words(const std::string& text) {
    return text_line(judged(text));
}

nlohmann::json json(const std::string& text) {
    return nlohmann::json::parse(json_line(judged(text)));
}

TEST_CASE("a line in words, marked where something is wrong") {
    CHECK(words(R"({"t": 16.5, "from": "screen", "line": "N-0 M104 S200*74"})") ==
          "        16.500000  screen → board  N-0 M104 S200*74                      nozzle: target 200 °C\n");
    CHECK(words("15:15:12.123456789 - N-0 M27*59") ==
          "  15:15:12.123456  screen → board  N-0 M27*59                            SD progress query\n");
    CHECK(words("N-0 M27*58").starts_with("! screen → board  N-0 M27*58  "));
    CHECK(words("N-0 M27*58").ends_with("[checksum 58 is wrong, 59 is right]\n"));
    CHECK(words("M998").starts_with("? board → screen  M998  "));
    CHECK(words("M27 Q5").starts_with("? screen → board  M27 Q5  "));
    CHECK(words("M117 " + std::string(600, 'a')).find("a board takes 512 at most") != std::string::npos);
    CHECK(words(std::string("\0M27\0", 5)) ==
          "* screen → board  \\x00M27\\x00                           SD progress query [2 NUL bytes, "
          "which a "
          "board drops]\n");
    CHECK(words(R"({"t": 1, "from": "world", "do": "filament in"})") ==
          "         1.000000  world           filament in\n");
    CHECK(words("{\"t\": \n") == "x file:1: not JSON; expected one JSON object a line: \"{\"t\": \"\n");
}

TEST_CASE("bytes that could harm a terminal are shown as numbers") {
    const std::string text = words("M23 \x1B[2J\xFF\x7F.gcode");
    CHECK(text.find("\\x1B[2J\\xFF\\x7F.gcode") != std::string::npos);
    for (const std::string& line : {text, words("{\x1B\x07"), json_line(judged("\x1B\xFF"))}) {
        CHECK(std::none_of(line.begin(), line.end() - 1,
                           [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }));
    }
}

TEST_CASE("as JSON: code, fields with name, value, unit and meaning, checksum") {
    const auto out =
        json(R"({"t": 0.25, "from": "board", "line": "N-0 L3 PS:1 VL:0 FN:a\u00ff.gcode PG:12*1"})");
    CHECK(out["t"] == 0.25);
    CHECK(out["from"] == "board");
    CHECK(out["line"] == "N-0 L3 PS:1 VL:0 FN:a\u00ff.gcode PG:12*1");
    CHECK(out["code"] == "L3");
    CHECK(out["title"] == "print status");
    CHECK(out["checksum"] == "wrong");
    CHECK(out["checksum_expected"].is_number());
    CHECK(out["known"] == true);
    REQUIRE(out["fields"].size() == 4);
    CHECK(out["fields"][0]["key"] == "PS:");
    CHECK(out["fields"][0]["name"] == "print status");
    CHECK(out["fields"][0]["value"] == 1);
    CHECK(out["fields"][0]["meaning"] == "printing");
    CHECK(out["fields"][2]["text"] == "a\u00ff.gcode");
    CHECK(out["fields"][3]["unit"] == "%");
    CHECK(out["marks"][0]["kind"] == "checksum");
}

TEST_CASE("as JSON: what is unknown, unframed or unreadable") {
    CHECK(json("M27")["checksum"] == "none");
    CHECK_FALSE(json("M27").contains("t"));
    CHECK(json("N-0 M27*59")["checksum"] == "right");
    CHECK(json("N-0 L14 Pausing*")["checksum"] == "unfinished");
    CHECK(json("M27 Q5")["fields"][0]["known"] == false);
    CHECK(json("M27 Q5")["known"] == false);
    CHECK(json("M998")["marks"][0]["kind"] == "unknown code");
    const auto bad = json("{\"t\": \xFF");
    CHECK(bad["file"] == "file");
    CHECK(bad["number"] == 1);
    CHECK(bad["text"] == "{\"t\": \u00ff");
    CHECK(bad.contains("problem"));
}

TEST_CASE("datagrams: requests in words, pieces of files as what they bring") {
    const auto entry = [](const std::string& from, const std::string& datagram) {
        return judged(R"({"t": 1, "from": ")" + from + R"(", "peer": 3, "datagram": ")" + datagram + "\"}");
    };
    const std::string request = text_line(entry("network", R"(M4002\u0000\u0000)"));
    CHECK(request.find("network → board") != std::string::npos);
    CHECK(request.find("M4002 ") != std::string::npos);
    CHECK(request.find("version query") != std::string::npos);
    CHECK(text_line(entry("module", R"(ok V4.3.3_LCDC\n)")).find("board → network") != std::string::npos);
    // 'a' 'b' at 2: their XOR with the offset's bytes, and the mark
    const std::string piece = text_line(entry("network", R"(ab\u0002\u0000\u0000\u0000\u0001\u0083)"));
    CHECK(piece.find("(8 bytes)") != std::string::npos);
    CHECK(piece.find("piece of a file: 2 bytes from 2 on\n") != std::string::npos);
    const auto damaged = entry("network", R"(ac\u0002\u0000\u0000\u0000\u0001\u0083)");
    CHECK(text_line(damaged).find("from 2 on; damaged") != std::string::npos);
    CHECK(nlohmann::json::parse(json_line(damaged))["words"] ==
          "piece of a file: 2 bytes from 2 on; damaged");
    std::istringstream in(json_line(damaged));
    const auto again = RecordingReader(in, "again").next();
    REQUIRE(again);
    CHECK(again->peer == 3);
    CHECK(again->bytes == damaged.entry.bytes);
}

TEST_CASE("the other end has the name that its talk gives it") {
    protocol::PeerName peer;
    const auto said = [&](const std::string& text) {
        JudgedLine line = judged(text);
        line.peer = peer.at(*line.decoded);
        return text_line(line);
    };
    CHECK(said("N1 M105*38").find(" host → board ") != std::string::npos);
    CHECK(said("ok T:22.00 /0.00 @:0").find(" board → host ") != std::string::npos);
    CHECK(said("G0 Z10 F300 I0").find(" host → board ") != std::string::npos);
    CHECK(said("N-0 M105*10").find(" screen → board ") != std::string::npos);
    CHECK(said("M27").find(" screen → board ") != std::string::npos);
    for (const char* line : {"N-0 L21 P0 S0*63", "log Geeetech LCD OK"}) {
        peer = {};
        CHECK(said(line).find("screen") != std::string::npos);
    }
}

TEST_CASE("the USB side's answers have words; what is meant for people only is no mistake") {
    CHECK(words(R"({"t": 1, "from": "usb", "line": "ok T:22.0 /0.0 B:22.0 /0.0 @:0 B@:0"})")
              .find("temperatures: nozzle 22.0 °C (target 0.0 °C)") != std::string::npos);
    CHECK(words(R"({"t": 1, "from": "usb", "line": "SD printing byte 3/4500"})").find("of 4500 bytes") !=
          std::string::npos);
    CHECK(words(R"({"t": 1, "from": "usb", "line": "mcu_init"})") ==
          "         1.000000  board → host    mcu_init\n");
}

TEST_CASE("timed lines as JSON are a recording again") {
    const JudgedLine line = judged(R"({"t": 16.451778, "from": "screen", "line": "N-0 M23 \u00e4*1"})");
    std::istringstream in(json_line(line));
    const auto again = RecordingReader(in, "again").next();
    REQUIRE(again);
    CHECK(again->t == machine::SimTime{16'451'778});
    CHECK(again->from == RecordedLine::From::screen);
    CHECK(again->bytes == "N-0 M23 \xE4*1");
}

TEST_CASE("whoever knows more adds a judge") {
    std::vector<LineJudge> judges = line_judges();
    judges.emplace_back(
        [](const TranscriptEntry&, const protocol::DecodedLine& line, std::vector<LineMark>& marks) {
            if (line.code_text == "L3") {
                marks.push_back({"screen", "this screen ends here"});
            }
        });
    std::istringstream in("N-0 L3 PS:0*37");
    const std::string text = text_line(judge(TranscriptReader(in, "x").next().value(), judges));
    CHECK(text.starts_with("* board → screen"));
    CHECK(text.find("[this screen ends here]") != std::string::npos);
}

}  // namespace
}  // namespace fauxboard::record
