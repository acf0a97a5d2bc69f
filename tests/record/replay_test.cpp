#include "emulator/record/replay.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "emulator/host/profile_files.h"
#include "protocol/framing.h"

using namespace fauxboard;
using namespace fauxboard::record;
using machine::SimTime;
using From = RecordedLine::From;

namespace {

SimTime seconds(double s) {
    return machine::from_seconds(s);
}

RecordedLine screen(double t, const std::string& body) {
    std::string line = protocol::frame(body);
    line.resize(line.size() - 2);
    return {seconds(t), From::screen, line};
}

ReplayResult run(const std::vector<RecordedLine>& recording, std::uint64_t seed = 1) {
    return replay(host::load_profile_by_name("geeetech-a30t"), recording, {seed, seconds(1)});
}

std::size_t count(const ReplayResult& result, std::string_view part) {
    return static_cast<std::size_t>(
        std::count_if(result.lines.begin(), result.lines.end(),
                      [&](const RecordedLine& line) { return line.bytes.find(part) != std::string::npos; }));
}

const RecordedLine* first(const ReplayResult& result, std::string_view part) {
    const auto hit = std::find_if(result.lines.begin(), result.lines.end(), [&](const RecordedLine& line) {
        return line.bytes.find(part) != std::string::npos;
    });
    return hit == result.lines.end() ? nullptr : &*hit;
}

}  // namespace

TEST_CASE("replay: without a recorded board line, time begins with power-on") {
    const ReplayResult result = run({screen(5, "M105")});
    REQUIRE(!result.lines.empty());
    CHECK(result.lines[0].bytes.starts_with("N-0 L3 "));
    // 80 characters, CR and LF at 115200 baud.
    CHECK(result.lines[0].t ==
          SimTime{(static_cast<SimTime::rep>(result.lines[0].bytes.size()) + 2) * 10 * 1'000'000 / 115200});
    CHECK(result.lines.back().t <= seconds(6.01));
}

TEST_CASE("replay: the first line ends when the recorded one did, and the rest follows") {
    const RecordedLine board{seconds(0), From::board, "N-0 L3 whatever"};
    const ReplayResult at_zero = run({board, screen(5, "M105")});
    CHECK(at_zero.lines[0].t == SimTime{0});
    RecordedLine later = board;
    later.t = seconds(10);
    const ReplayResult at_ten = run({screen(1, "M105"), later, screen(15, "M105")});
    CHECK(at_ten.lines[0].t == seconds(10));
    // What came before the board had power met nobody.
    REQUIRE(at_ten.lines.size() == at_zero.lines.size());
    for (std::size_t i = 0; i < at_ten.lines.size(); ++i) {
        CHECK(at_ten.lines[i].bytes == at_zero.lines[i].bytes);
        CHECK(at_ten.lines[i].t - seconds(10) == at_zero.lines[i].t);
    }
}

TEST_CASE("replay: screen, host and world reach the board") {
    const ReplayResult result =
        run({screen(2, "M2134 FW:V1"),
             {seconds(3), From::host, "M117 hello"},
             {seconds(3.5), From::world, "filament in"},
             {seconds(4), From::world, R"({"set":{"wifi.signal":3.0}})"},
             {seconds(4), From::world, R"({"heater.target":{"heater":"bed","c":60}})"},
             screen(8, "M105"),
             {seconds(9), From::world, "board reset"},
             screen(12, "M105")});
    CHECK(count(result, "L14  hello") == 1);
    CHECK(count(result, " FT:1 ") >= 1);
    CHECK(count(result, "/60.0 ") >= 1);   // the bed's target, until the reset
    CHECK(count(result, "N-0 L9 ") == 3);  // boot, answer, second boot
    const RecordedLine* hello = first(result, "L14  hello");
    REQUIRE(hello != nullptr);
    CHECK(hello->t > seconds(3));
    CHECK(hello->t < seconds(3.1));
    CHECK(result.counters.unknown_codes == 0);
}

TEST_CASE(
    "replay: a fault of the printer comes again as it was asked for; what is told of faults is passed over") {
    const ReplayResult result =
        run({{seconds(1), From::board, "N-0 L3*1"},
             {seconds(0.5), From::world, R"({"fault.set":{"fault":"filament_out","after_s":6.0}})"},
             {seconds(1), From::fault, "fault 1: drop to screen: N-0 L3*1"},
             {seconds(2), From::world, "filament in"},
             screen(14, "M105")});
    const RecordedLine* there = first(result, " FT:1 ");
    REQUIRE(there != nullptr);
    const auto gone = std::find_if(result.lines.begin(), result.lines.end(), [&](const RecordedLine& line) {
        return line.t > there->t && line.bytes.find(" FT:0 ") != std::string::npos;
    });
    CHECK(gone != result.lines.end());
}

TEST_CASE("replay: unknown things cannot be done, unknown codes are told") {
    CHECK_THROWS_WITH_AS(run({{seconds(1.5), From::world, "coffee in"}}),
                         "at 1.500000 s: \"coffee in\" is nothing that can be done to the machine",
                         ReplayError);
    CHECK_THROWS_WITH_AS(run({{seconds(1.5), From::world, R"({"coffee.make": {}})"}}),
                         "at 1.500000 s: \"{\"coffee.make\": {}}\" cannot be done to the machine: unknown "
                         "action \"coffee.make\"",
                         ReplayError);
    CHECK_THROWS_AS(run({{seconds(1.5), From::world, "{"}}), ReplayError);
    CHECK_THROWS_AS(run({{seconds(1.5), From::world, R"({"heater.target": {"heater": "bed"}})"}}),
                    ReplayError);
    const ReplayResult result = run({screen(1, "M9999")});
    CHECK(result.counters.unknown_codes == 1);
    REQUIRE(!result.notices.empty());
    CHECK(result.notices[0].text.find("M9999") != std::string::npos);
}

TEST_CASE("replay: the same twice, byte by byte; another seed, another noise") {
    const std::vector<RecordedLine> talk{screen(2, "M104 S200"), screen(200, "M105")};
    const auto text = [](const ReplayResult& result) {
        std::string out;
        for (const RecordedLine& line : result.lines) {
            out += recording_line(line);
        }
        return out;
    };
    const std::string once = text(run(talk));
    CHECK(once == text(run(talk)));
    CHECK(once != text(run(talk, 2)));
}

TEST_CASE("replay: lines never overlap on the wire") {
    const ReplayResult result = run({screen(2, "M20 LCD"), screen(2.001, "M27"), screen(2.002, "M105")});
    for (std::size_t i = 1; i < result.lines.size(); ++i) {
        const auto bits = static_cast<SimTime::rep>(result.lines[i].bytes.size() + 2) * 10;
        CHECK(result.lines[i].t - result.lines[i - 1].t >= SimTime{bits * 1'000'000 / 115200 - 1});
    }
}

TEST_CASE("replay: a recording that jumps by decades is refused by a sentence") {
    CHECK_THROWS_WITH_AS(run({screen(1, "M105"), screen(1e9, "M105")}),
                         doctest::Contains("nothing for 11574 days before"), ReplayError);
}

TEST_CASE("replay: piece by piece it says what it says of the whole, and holds nothing") {
    const std::vector<RecordedLine> talk{screen(2, "M104 S200"), screen(3, "M9999"), screen(200, "M105")};
    const ReplayResult whole = run(talk);
    std::size_t lines = 0;
    std::size_t notices = 0;
    auto at = talk.begin();
    ReplayTalk pieces;
    pieces.next = [&] { return at == talk.end() ? std::nullopt : std::optional(*at++); };
    pieces.on_line = [&](const RecordedLine& line) {
        REQUIRE(lines < whole.lines.size());
        CHECK(recording_line(line) == recording_line(whole.lines[lines++]));
    };
    pieces.on_notice = [&](const ReplayNotice&) { ++notices; };
    replay(host::load_profile_by_name("geeetech-a30t"), pieces, {1, seconds(1)});
    CHECK(lines == whole.lines.size());
    CHECK(notices == whole.notices.size());
}
