#include "emulator/resin/resin_commands.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "emulator/machine/memory_volume.h"

using namespace fauxboard::resin;

namespace {

struct Bench {
    ResinConfig config;
    ResinSettings settings;
    EventQueue events;
    ResinAxis axis{config, settings};
    ResinCommands commands{axis};
    fauxboard::machine::MemoryVolume stick;
    SimTime now{0};

    explicit Bench(const std::string& text) {
        axis.power_on();
        stick.create("x.gcode");
        stick.append("x.gcode", 0, text);
        commands.begin(stick, "x.gcode", now);
    }
    /// Does what is due up to `end` as a machine and its board do; the lines taken. Fails where time stands
    /// still.
    std::vector<std::string> run(SimTime end) {
        std::vector<std::string> out;
        for (int steps = 0; commands.next_event() <= end; ++steps) {
            REQUIRE(steps < 10'000);
            now = commands.next_event();
            commands.advance(now);
            // The machine goes on until the board takes the line; there is nothing more to do meanwhile.
            REQUIRE((commands.next_event() > now || !commands.running()));
            if (auto line = commands.take(now)) {
                out.push_back(*line);
            }
            CHECK_FALSE(commands.take(now).has_value());
        }
        now = end;
        return out;
    }
};

}  // namespace

TEST_CASE("commands: a line a millisecond, without remarks, to the file's end") {
    Bench bench("M8026 I1200 ; travel\r\nM8500");
    CHECK(bench.run(SimTime{999}).empty());
    CHECK(bench.run(SimTime{1000}) == std::vector<std::string>{"M8026 I1200 "});
    CHECK(bench.run(SimTime{5000}) == std::vector<std::string>{"", "M8500"});
    CHECK_FALSE(bench.commands.running());
    CHECK(bench.commands.next_event() == never);
}

TEST_CASE("commands: nothing is due while the axis moves, or after stop()") {
    Bench bench("G0 Z5\nG0 Z1\n");
    REQUIRE(bench.axis.move(5, false, 600, bench.now));
    CHECK(bench.commands.next_event() == never);
    while (bench.axis.busy()) {
        bench.now = bench.axis.next_event();
        bench.axis.advance(bench.now, bench.events);
    }
    CHECK(bench.commands.next_event() <= bench.now);
    bench.commands.stop();
    CHECK(bench.commands.next_event() == never);
    CHECK_FALSE(bench.commands.take(bench.now).has_value());
}

TEST_CASE("commands: which files are carried out") {
    CHECK(ResinCommands::fits("a.gcode"));
    CHECK(ResinCommands::fits("folder/A.GCode"));
    CHECK_FALSE(ResinCommands::fits(".gcode"));
    CHECK_FALSE(ResinCommands::fits("a.ctb"));
    CHECK_FALSE(ResinCommands::fits("gcode"));
}
