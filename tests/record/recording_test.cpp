#include "emulator/record/recording.h"

#include <doctest/doctest.h>

#include <sstream>

using namespace fauxboard::record;
using fauxboard::machine::SimTime;
using From = RecordedLine::From;

namespace {

std::vector<RecordedLine> read(const std::string& text) {
    std::istringstream in(text);
    return load_recording(in, "talk.jsonl");
}

std::string error_of(const std::string& text) {
    try {
        read(text);
    } catch (const RecordingError& error) {
        return error.what();
    }
    return "none";
}

}  // namespace

TEST_CASE("recording: lines, things done, and blank lines between them") {
    const auto lines = read(
        "{\"t\": 0, \"from\": \"board\", \"line\": \"N-0 L21 P0 S0*63\"}\n"
        "\n  \r\n"
        "{\"t\": 16.451778, \"from\": \"screen\", \"line\": \"N-0 M2134\", \"note\": \"not ours\"}\r\n"
        "{\"t\": 20, \"from\": \"host\", \"line\": \"M117 hi\"}\n"
        "{\"t\": 135.5, \"from\": \"world\", \"do\": \"filament in\"}");
    REQUIRE(lines.size() == 4);
    CHECK(lines[0].from == From::board);
    CHECK(lines[0].bytes == "N-0 L21 P0 S0*63");
    CHECK(lines[1].t == SimTime{16'451'778});
    CHECK(lines[1].from == From::screen);
    CHECK(lines[2].from == From::host);
    CHECK(lines[3].from == From::world);
    CHECK(lines[3].bytes == "filament in");
}

TEST_CASE("recording: what is written reads back, byte by byte") {
    std::string bytes;
    for (int c = 1; c < 256; ++c) {
        if (c != '\r' && c != '\n') {
            bytes += static_cast<char>(c);
        }
    }
    const std::string text = recording_line(SimTime{1'000'001}, "screen", "line", bytes);
    CHECK(text.starts_with("{\"t\": 1.000001, \"from\": \"screen\", \"line\": \""));
    CHECK(text.back() == '\n');
    for (const char c : text) {
        CHECK(static_cast<unsigned char>(c) < 0x80);
    }
    const auto lines = read(text);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].bytes == bytes);
    CHECK(lines[0].t == SimTime{1'000'001});
    CHECK(recording_line(lines[0]) == text);
    CHECK(recording_line({SimTime{500}, From::world, "board reset"}) ==
          "{\"t\": 0.000500, \"from\": \"world\", \"do\": \"board reset\"}\n");
}

TEST_CASE("recording: datagrams are kept whole, with who is at the other end") {
    std::string bytes;
    for (int c = 0; c < 256; ++c) {
        bytes += static_cast<char>(c);
    }
    for (const From from : {From::network, From::module}) {
        RecordedLine written{SimTime{2'500'000}, from, bytes};
        written.peer = 7;
        const std::string text = recording_line(written);
        CHECK(text.starts_with("{\"t\": 2.500000, \"from\": \"" + std::string(from_name(from)) +
                               "\", \"peer\": 7, \"datagram\": \""));
        const auto lines = read(text);
        REQUIRE(lines.size() == 1);
        CHECK(lines[0].from == from);
        CHECK(lines[0].bytes == bytes);
        CHECK(lines[0].peer == 7);
    }
    CHECK_THROWS_WITH_AS(read("{\"t\": 0, \"from\": \"network\", \"datagram\": \"M20\"}"),
                         "talk.jsonl:1: the key \"peer\" is missing", RecordingError);
    CHECK_THROWS_AS(read("{\"t\": 0, \"from\": \"network\", \"peer\": 0, \"datagram\": \"M20\"}"),
                    RecordingError);
    CHECK_THROWS_AS(read("{\"t\": 0, \"from\": \"network\", \"peer\": 1, \"line\": \"M20\"}"),
                    RecordingError);
}

TEST_CASE("recording: entries come out in the order of time") {
    const auto lines = read(
        "{\"t\": 2, \"from\": \"host\", \"line\": \"c\"}\n"
        "{\"t\": 1, \"from\": \"host\", \"line\": \"a\"}\n"
        "{\"t\": 1, \"from\": \"host\", \"line\": \"b\"}\n");
    REQUIRE(lines.size() == 3);
    CHECK(lines[0].bytes == "a");
    CHECK(lines[1].bytes == "b");
    CHECK(lines[2].bytes == "c");
}

TEST_CASE("recording: a wrong line is told by file, line and what is wrong") {
    const std::string good = "{\"t\": 0, \"from\": \"board\", \"line\": \"x\"}\n\n";
    CHECK(error_of(good + "nonsense") == "talk.jsonl:3: not JSON; expected one JSON object a line");
    CHECK(error_of(good + "[1]") ==
          "talk.jsonl:3: found [1]; expected an object with t, from, and line or do");
    CHECK(error_of("{\"from\": \"board\", \"line\": \"x\"}") == "talk.jsonl:1: the key \"t\" is missing");
    CHECK(error_of("{\"t\": -1, \"from\": \"board\", \"line\": \"x\"}") ==
          "talk.jsonl:1: t: found -1; expected seconds from 0 to 1e9");
    CHECK(error_of("{\"t\": 1e99, \"from\": \"board\", \"line\": \"x\"}").find("expected seconds") !=
          std::string::npos);
    CHECK(error_of("{\"t\": 0, \"from\": \"moon\", \"line\": \"x\"}") ==
          "talk.jsonl:1: from: found \"moon\"; expected board, screen, host, world, usb, network, module or "
          "fault");
    CHECK(error_of("{\"t\": 0, \"from\": \"world\", \"line\": \"x\"}") ==
          "talk.jsonl:1: the key \"do\" is missing");
    for (const char* bytes : {"\"\\u0100\"", "\"a\\nb\"", "7"}) {
        CHECK(error_of(std::string("{\"t\": 0, \"from\": \"host\", \"line\": ") + bytes + "}")
                  .find("without line ends") != std::string::npos);
    }
    CHECK(error_of(good + std::string(70'000, ' ')) ==
          "talk.jsonl:3: a line of more than 64 KiB; expected one JSON object a line");
    CHECK_THROWS_WITH_AS(load_recording(std::filesystem::path("/no/such.jsonl")),
                         "/no/such.jsonl: there is no such file", RecordingError);
    CHECK_THROWS_WITH_AS(load_recording(std::filesystem::path("/")), "/: it is no file", RecordingError);
}

TEST_CASE("recording: lines take their time on the wire, one after the other") {
    WireClock wire(115200);
    CHECK(wire.send(SimTime{1000}, 82) == SimTime{1000 + 7118});
    CHECK(wire.send(SimTime{2000}, 36) == SimTime{1000 + 7118 + 3125});  // waits for the first
    CHECK(wire.send(SimTime{50'000}, 36) == SimTime{53'125});
}

namespace fauxboard::record {
namespace {

TEST_CASE("an ordered recording: any order within the window, a sentence beyond it") {
    const auto entry = [](double t) {
        return recording_line(machine::from_seconds(t), "screen", "line", std::to_string(t));
    };
    std::istringstream few(entry(3) + entry(1) + entry(2));
    OrderedRecording ordered(RecordingReader(few, "few"));
    for (const double t : {1.0, 2.0, 3.0}) {
        CHECK(ordered.next()->t == machine::from_seconds(t));
    }
    CHECK_FALSE(ordered.next());
    std::string text;
    for (std::size_t i = 0; i <= OrderedRecording::window; ++i) {
        text += entry(10 + static_cast<double>(i));
    }
    std::istringstream many(text + entry(5));
    OrderedRecording late(RecordingReader(many, "many"));
    CHECK(late.next()->t == machine::from_seconds(10));
    CHECK_NOTHROW(late.next());
    CHECK_THROWS_WITH_AS(late.next(), doctest::Contains("its time lies before"), RecordingError);
}

}  // namespace
}  // namespace fauxboard::record
