// A recorded line of a real A30T. The recordings are third-party data, read where they are.

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "emulator/behaviour/wire_text.h"
#include "emulator/screen/tour_report.h"
#include "tests/screen/harness.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using machine::from_seconds;

namespace {

struct Recorded {
    double at;
    std::string from;
    std::string line;
};

std::vector<Recorded> read_capture() {
    const std::filesystem::path file =
        FAUXBOARD_SOURCE_DIR "/../shared/captures/a30t-boot-heat-load-home.jsonl";
    std::vector<Recorded> out;
    std::ifstream in(file);
    for (std::string text; std::getline(in, text);) {
        const auto node = nlohmann::json::parse(text);
        if (node.contains("line")) {
            out.push_back({node.at("t"), node.at("from"),
                           behaviour::to_wire(node.at("line").get<std::string>()).value()});
        }
    }
    return out;
}

/// What the person of the recording pressed, and when.
struct Touch {
    double at;
    std::string_view path;
};
constexpr std::string_view babystep = "Control/Motion Param/babystep";
const std::vector<Touch> touches{{43.4, "Control/Filament/Hotend on"},
                                 {189.95, "Load on"},
                                 {212.4, "Load off"},
                                 {213.3, "Extruder 2"},
                                 {214.4, "Load on"},
                                 {248.3, "Load off"},
                                 {248.9, "Extruder 1"},
                                 {249.5, "Load on"},
                                 {268.3, "Load off"},
                                 {283.3, "Control/Filament/Hotend off"},
                                 {382.0, babystep},
                                 {385.3, "babystep up"},
                                 {385.7, "babystep up"},
                                 {386.1, "babystep up"},
                                 {386.4, "babystep down"},
                                 {386.8, "babystep down"},
                                 {387.2, "babystep up"},
                                 {408.1, "Home all"},
                                 {451.8, babystep},
                                 {454.1, "babystep down"},
                                 {455.4, "babystep up"},
                                 {455.75, "babystep up"},
                                 {456.25, "babystep up"},
                                 {456.45, "babystep up"},
                                 {456.7, "babystep up"},
                                 {456.9, "babystep up"},
                                 {457.1, "babystep up"},
                                 {457.4, "babystep up"},
                                 {457.75, "babystep up"},
                                 {458.1, "babystep up"},
                                 {458.4, "babystep up"},
                                 {458.75, "babystep up"},
                                 {459.1, "babystep up"},
                                 {459.4, "babystep up"},
                                 {459.9, "babystep up"},
                                 {460.5, "babystep up"},
                                 {463.1, "Store settings"},
                                 {463.9, babystep}};

/// A screen that lives through the recording: the board's lines come in, the person presses.
class Replay {
  public:
    void to(double seconds) {
        const SimTime end = from_seconds(seconds);
        while (screen.advance(end) <= end || !screen.output().empty()) {
            take();
        }
    }
    void take() {
        bytes += screen.output();
        screen.clear_output();
    }
    screen::Screen screen{shipped_screen("geeetech-a30t")};
    std::string bytes;
};

/// Texts up to the end of the line: of these a screen that knows no frames takes the checksum for a part.
bool ends_with_frame(const std::string& frame) {
    return frame == "L7" || frame == "L14";
}

}  // namespace

TEST_CASE(
    "the A30T's screen through the recording: the same bytes, and what a person would have read at its end") {
    const auto lines = read_capture();
    if (lines.empty()) {
        MESSAGE("skipped: no recording here");
        return;
    }
    Replay replay;
    bool on = false;
    std::size_t touch = 0;
    std::string expected;
    for (const Recorded& line : lines) {
        if (!on && line.at > 15.23) {
            replay.screen.power_on(from_seconds(15.23));  // it heard the L21 of 16.439
            on = true;
        }
        for (; touch < touches.size() && touches[touch].at <= line.at; ++touch) {
            replay.to(touches[touch].at);
            const auto pressed = replay.screen.press(touches[touch].path, from_seconds(touches[touch].at));
            CHECK_MESSAGE(pressed.pressed, pressed.sentence);
            replay.take();
        }
        replay.to(line.at);
        if (line.from == "board") {
            replay.screen.receive(from_seconds(line.at), line.line + "\r\n");
            replay.take();
        } else if (line.from == "screen") {
            expected += line.line + "\r\n";
        }
    }
    replay.to(lines.back().at + 1);
    CHECK(touch == touches.size());
    CHECK(replay.bytes == expected);
    CHECK(replay.screen.show() ==
          "Babystep  (Control/Motion Param/babystep)\n"
          "-----------------------------------------\n"
          "Babystep 0.15 mm\n"
          "[babystep up]  [babystep down]  [Rset]\n"
          "[Bar chart button]  [Main menu button]  [Return button]\n");
    CHECK(replay.screen.show("Main") ==
          "Main menu  (Main)\n"
          "-----------------\n"
          "Nozzle 103.8 / 0.0 °C   Bed 22.3 / 0.0 °C\n"
          "X 198.200   Y 160.000   Z 2.500 mm   5 mm/s\n"
          "Fan 0 %   Speed 100 %   Motors on\n"
          "SD card in   Filament in   Print idle\n"
          "Mix E0 100 %   E1 0 %   E2 0 %\n"
          "[Control]  [Printing]  [Setting]\n"
          "[Bar chart button]\n");
    CHECK(replay.screen.show("Control/Motion Param/Jerk").find("X 7.00   Y 7.00   Z 0.50   E 5.00") !=
          std::string::npos);
    CHECK(replay.screen.show("Setting/About").find("Firmware  V1.xx.03") != std::string::npos);
    CHECK(replay.screen.get("files") == "testpattern.gcode\nA30T\n");
}

TEST_CASE("the recorded lines, all fed to each screen: none would crash it, and the board's are all taken") {
    const auto lines = read_capture();
    if (lines.empty()) {
        MESSAGE("skipped: no recording here");
        return;
    }
    CHECK(lines.size() >= 504);
    for (const char* name : {"geeetech-a30t", "geeetech-a30"}) {
        CAPTURE(name);
        Bench bench(name);
        std::size_t board_lines = 0;
        std::size_t not_ok = 0;
        for (const Recorded& line : lines) {
            const screen::Judgement& judgement = bench.say_raw(line.line);
            if (line.from != "board") continue;
            ++board_lines;
            const bool known = std::string_view(name) == "geeetech-a30t"
                                   ? judgement.frame != "L12"
                                   : !ends_with_frame(judgement.frame) && judgement.frame != "L12" &&
                                         judgement.frame != "L22" && judgement.frame != "L23" &&
                                         judgement.frame != "L24";
            not_ok += known && judgement.verdict != screen::Verdict::ok ? 1U : 0U;
            CHECK_MESSAGE((!known || judgement.verdict == screen::Verdict::ok), judgement.sentence());
        }
        CHECK(board_lines == 460);
        CHECK(not_ok == 0);
        CHECK(bench->counters().crashes == 0);
    }
}
