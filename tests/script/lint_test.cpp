// What the board says in the shipped scenarios, as the A30's screen would take it: that screen has no checks
// of its own, and some frames crash it.

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>
#include <string_view>

#include "emulator/host/screen_files.h"
#include "emulator/screen/screen.h"
#include "tests/support/scenario_run.h"

namespace fauxboard::script {
namespace {

/// The A30T's page for a user who is waited for. The A30's screen reads past its table there, so the board of
/// that printer leaves it out, which the tests of faults see to.
constexpr std::string_view not_said_by_its_board = "L18 P26 S15";

/// An A30's screen that is told what a recording holds.
struct A30 {
    screen::Screen screen{host::load_screen_by_name("geeetech-a30")};
    SimTime start{0};
    SimTime now{0};
    std::size_t lines = 0;

    A30() {
        screen.power_on(SimTime{0});
        while (!screen.ready()) {
            start += SimTime{100'000};
            screen.advance(start);
            screen.clear_output();
        }
    }
    /// "TIME < LINE": only what the board said, `but` not these.
    void hear(std::string_view recording, std::string_view but) {
        while (!recording.empty()) {
            const std::size_t end = recording.find('\n');
            const std::string line(recording.substr(0, end));
            recording.remove_prefix(end + 1);
            const std::size_t mark = line.find(" < ");
            if (mark != std::string::npos && line.find_first_not_of("0123456789") == mark &&
                line.find(but) == std::string::npos) {
                now = start + SimTime{std::atoll(line.c_str())};
                screen.receive(now, line.substr(mark + 3) + "\r\n");
                screen.clear_output();
                ++lines;
            }
        }
        for (int i = 0; i < 10; ++i) {  // it takes what came last as well
            now += SimTime{100'000};
            screen.advance(now);
            screen.clear_output();
        }
    }
    std::string crashes() const {
        std::string out;
        for (const screen::Finding& finding : screen.findings()) {
            if (finding.first.verdict == screen::Verdict::would_crash) {
                out += finding.first.sentence() + "\n";
            }
        }
        return out;
    }
};

TEST_CASE(
    "shipped pairs: a board and its screen through a print and all that can befall it, each line taken as "
    "meant") {
    for (const char* name : {"pair-a30", "pair-a30t"}) {
        CAPTURE(std::string(name));
        const testing::ScenarioRun run = testing::play(testing::shipped_scenario(name), {});
        CHECK_MESSAGE(run.outcome.verdict == Outcome::Verdict::passed, run.outcome.sentence);
    }
}

TEST_CASE("shipped scenarios: nothing that the board says in them crashes the A30's screen") {
    for (const char* name : {"day-of-bad-luck", "leveling-session", "power-loss",
                             "print-with-filament-change", "soak", "tour-of-pages"}) {
        CAPTURE(std::string(name));
        testing::ScenarioSetup setup;
        if (std::string_view(name) == "soak" || std::string_view(name) == "tour-of-pages") {
            setup.arguments["rounds"] = "2";
        }
        const testing::ScenarioRun run = testing::play(testing::shipped_scenario(name), setup);
        REQUIRE(run.outcome.verdict == Outcome::Verdict::passed);
        A30 a30;
        a30.hear(run.recording, not_said_by_its_board);
        CHECK(a30.lines > 50);
        CHECK(a30.crashes() == "");
    }
}

TEST_CASE("shipped scenarios: the check above finds what crashes that screen") {
    A30 a30;
    a30.hear("1000 < N-0 L18 P26 S15*53\n2000 > N-0 L18 P26 S15*53\n3000 < N-0 L9\n", "L9");
    CHECK(a30.lines == 1);
    CHECK(a30.crashes().find("would crash") != std::string::npos);
}

}  // namespace
}  // namespace fauxboard::script
