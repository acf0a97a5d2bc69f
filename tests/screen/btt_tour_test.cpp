// The BIGTREETECH TFT against the board `marlin`: every button, and boards that say what the screen dies of.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

#include "emulator/screen/tour_report.h"
#include "tests/screen/harness.h"
#include "tests/support/board_driver.h"
#include "tests/support/sliced_file.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using screen::Verdict;

namespace {

/// A card with a print that lasts.
struct Card {
    MemoryDisk disk;
    Card() {
        std::string text;
        for (int i = 0; i < 4000; ++i) {
            text += fmt::format("G1 X{} Y{} F1200\n", 50 + i % 2 * 60, 60 + i % 7);
        }
        disk.put("part of mine.gcode", text);
    }
    machine::Services services() {
        machine::Services out;
        out.sd = &disk;
        return out;
    }
};

std::shared_ptr<const behaviour::Profile> changed(const std::string& changes) {
    const auto find = [](std::string_view name, std::string_view) -> std::optional<behaviour::SourceText> {
        std::ifstream in(FAUXBOARD_SOURCE_DIR "/profiles/" + std::string(name) + ".json");
        return behaviour::SourceText{std::string(name), std::string(std::istreambuf_iterator<char>(in), {})};
    };
    return behaviour::load_profile(
        {"broken.json", R"({"name": "broken", "extends": "marlin", )" + changes + "}"}, find);
}

/// What is found when the screen is switched on with that board and these buttons are pressed.
std::string found(const std::string& changes, const std::vector<std::string>& presses, Verdict verdict) {
    Card card;
    for (int i = 0; i < 150; ++i) {
        if (changes.find("many files") != std::string::npos) {
            card.disk.put(fmt::format("file number {} of so many.gcode", 100 + i), "G28\n");
        }
    }
    const Together run(changed(changes), shipped_screen("btt-tft"), card.services(), presses);
    std::string out;
    for (const screen::Finding& finding : run.findings) {
        out += finding.first.verdict == verdict ? finding.first.sentence() + "\n" : "";
    }
    return out;
}

}  // namespace

TEST_CASE("the tour of the BIGTREETECH TFT against marlin: all met, no time-out, never out of step") {
    Card card;
    const TourRun run = run_tour("btt-tft", shipped_profile("marlin"), 7200, card.services());
    std::string complaints;
    for (const screen::TourResult& result : run.results) {
        complaints += result.verdict != screen::TourVerdict::met ? result.sentence + '\n' : "";
    }
    INFO(screen::findings_text(run.findings));
    CHECK(complaints == "");
    CHECK(screen::talk_text(run.counters) == "0 time-outs, 0 desynchronised, 0 stalls, 0 jams, 0 crashes\n");
    CHECK(run.done);
    CHECK(run.results.size() == run.total);
}

TEST_CASE("each fatal input, said by a profile of one's own, is named with its reason") {
    struct Row {
        std::string changes;
        std::vector<std::string> presses;
        Verdict verdict;
        std::string why;
    };
    const std::string word(120, 'x');
    const Row rows[] = {
        {R"("host_requests": {"M92": {"send": ["M92", "ok", "ok"]}})",
         {},
         Verdict::runs_ahead,
         "two acknowledgements for one command (\"M92\")"},
        {R"("host_requests": {"M211": {"do": "code.unanswered"}})",
         {},
         Verdict::timed_out,
         "no line in 15 s after it: ACK timed out"},
        {R"("frames": {"M105": "ok T:22.3 /0.0 B:22.0 /0.0"})",
         {},
         Verdict::ignored,
         "only with \"@\", \"T0:\" or \"T:0\""},
        {R"("frames": {"M115": "Cap:EEPROM:1"})",
         {},
         Verdict::part_missed,
         "no FIRMWARE_NAME line before it"},
        {R"("host_requests": {"M21": {"send": null}})",
         {"Print"},
         Verdict::stalls,
         "\"M21\" is acknowledged without its answer"},
        {R"("host_requests": {"M20": {}})",
         {"Print"},
         Verdict::stalls,
         "\"M20 L\" is acknowledged without its answer"},
        {R"("frames": {"none": "???"}, "host_requests": {"M33": {"send": "none"}})",
         {"Print", "Print/File 1", "Print/Confirm/Long name"},
         Verdict::stalls,
         "is acknowledged without its answer"},
        {R"("comment": "many files")", {"Print"}, Verdict::rest_dropped, "a list of more than 5000 bytes"},
        {R"("frames": {"word": "Error:)" + word + R"("}, "host_requests": {"M211": {"send": "word"}})",
         {},
         Verdict::would_crash,
         "a word of 120 characters or more in a pop-up"},
        {R"("frames": {"long": "echo:)" + std::string(507, 'y') +
             R"("}, "host_requests": {"M211": {"send": "long"}})",
         {},
         Verdict::jams,
         "a line of 512 bytes or more: the screen never reads again"},
        {R"("frames": {"three": {"lines": ["//action:prompt_begin A", "//action:prompt_button B",
            "//action:prompt_button C", "//action:prompt_button D", "//action:prompt_show"]}},
            "host_requests": {"M211": {"send": "three"}})",
         {},
         Verdict::part_missed,
         "a third button: the screen has two"},
        {R"("frames": {"speed": "ok Feedrate: 100"}, "host_requests": {"M220": {"send": "speed"}})",
         {},
         Verdict::ignored,
         "a speed is looked for behind \"FR:\" only"},
        {R"("frames": {"place": "ok X:1.00 Y:1.00 Z:1.00 E:0.00"}, "host_requests": {"M114": {"send": "place"}})",
         {},
         Verdict::part_missed,
         "a position is taken only from a line that starts with \"X:\""},
    };
    for (const Row& row : rows) {
        CAPTURE(row.changes);
        CAPTURE(row.why);
        const std::string all = found(row.changes, row.presses, row.verdict);
        CAPTURE(all);
        CHECK(all.find(row.why) != std::string::npos);
    }
}
