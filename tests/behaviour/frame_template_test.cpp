#include "emulator/behaviour/frame_template.h"

#include <doctest/doctest.h>

#include <array>
#include <string>

#include "protocol/framing.h"
#include "tests/support/printers.h"
#include "tests/support/small_profile.h"

using namespace fauxboard;
using namespace fauxboard::behaviour;
using std::string;

namespace {

/// A machine and all that a template can see.
struct Bench {
    filament::Printer machine{
        std::static_pointer_cast<const filament::Config>(fauxboard::testing::small_profile()->machine),
        {},
        1};
    std::vector<double> variables{1.5};
    protocol::Command command;
    string body;
    machine::CardEntry entry{"Name.GCO", false, 7};
    Names names;

    explicit Bench(string request = "M1 S12.345 P-2 FW:V1.02 x") : body(std::move(request)) {
        machine.power_on(machine::SimTime{0});
        command = *protocol::parse_command(body);
        names.variables.emplace("count", 0);
        names.request = true;
        names.loop = true;
    }
    Scope scope() { return {machine, variables, &command, &entry, 3}; }
    string render(const string& source) {
        std::array<char, 256> out;
        bool cut = false;
        const Written line = FrameTemplate(source, names).render(scope(), out, cut);
        CHECK_FALSE(cut);
        string text(out.data(), line.size);
        CHECK(line.sum == protocol::xor_checksum(text));
        return text;
    }
    string error(const string& source) {
        try {
            FrameTemplate(source, names);
        } catch (const ExpressionError& e) {
            return string(e.what()) + (e.nearest.empty() ? "" : " -> " + e.nearest);
        }
        return "no error";
    }
};

}  // namespace

TEST_CASE("templates: every format") {
    Bench bench;
    bench.machine.mixer.set_start_height(12.3456);
    const std::array<const char*, 7> fixed{"12",      "12.3",     "12.35",    "12.346",
                                           "12.3456", "12.34560", "12.345600"};
    for (int decimals = 0; decimals <= 6; ++decimals) {
        const std::string d = std::to_string(decimals);
        CHECK(bench.render("{mixer.start_height:." + d + "f}") == fixed[static_cast<std::size_t>(decimals)]);
    }
    CHECK(bench.render("{mixer.start_height:d}") == "12");  // cut off, not rounded
    bench.machine.motion.set_babystep(-0.99);
    CHECK(bench.render("{babystep.z:d}") == "0");
    bench.machine.motion.set_babystep(-1.99);
    CHECK(bench.render("{babystep.z:d}") == "-1");
    CHECK(bench.render("{speed.percent}") == "100");
    CHECK(bench.render("{motors.enabled}") == "0");
    CHECK(bench.render("{leveling.auto:d}") == "1");
    bench.machine.screen.firmware = "V1.02.XX";
    CHECK(bench.render("[{screen.firmware}][{screen.firmware:s}][{screen.firmware:lower}]") ==
          "[V1.02.XX][V1.02.XX][v1.02.xx]");
}

TEST_CASE("templates: every reference") {
    Bench bench;
    CHECK(bench.render("{S:.2f} {P:d}") == "12.35 -2");
    CHECK(bench.render("{S?}{Q?}") == "10");
    CHECK(bench.render("{Q|255:d} {S|255:d}") == "255 12");
    CHECK(bench.render("<{Q:d}>") == "<>");  // not on the line: nothing
    CHECK(bench.render("<{arg}>") == "<S12.345 P-2 FW:V1.02 x>");
    CHECK(bench.render("<{text}>") == "< S12.345 P-2 FW:V1.02 x>");
    CHECK(bench.render("<{FW:}>") == "<V1.02>");
    CHECK(bench.render("<{XX:}>") == "<>");
    CHECK(bench.render("{var.count:.1f}") == "1.5");
    CHECK(bench.render("{entry.index} {entry.name} {entry.name:lower}") == "3 Name.GCO name.gco");
}

TEST_CASE("templates: text outside braces stays, doubled braces are braces") {
    Bench bench;
    CHECK(bench.render("").empty());
    CHECK(bench.render("L1 * N-0 %d \\ \xff") == "L1 * N-0 %d \\ \xff");
    CHECK(bench.render("{{{speed.percent}}}") == "{100}");
    CHECK(bench.render("{{}}") == "{}");
}

TEST_CASE("templates: control characters of a text cannot break the line") {
    Bench bench;
    bench.machine.screen.firmware = string("a\r\nb\0c\x1f\x7f\xff", 9);
    CHECK(bench.render("{screen.firmware}") == "a??b?c?\x7f\xff");
    CHECK(bench.render("{screen.firmware:lower}") == "a??b?c?\x7f\xff");
}

TEST_CASE("templates: what does not fit is cut, and said") {
    Bench bench;
    bench.machine.screen.firmware = "0123456789";
    for (const string source : {"abcdefghijkl", "{screen.firmware}", "{S:.6f}{S:.6f}"}) {
        for (std::size_t room = 0; room < 9; ++room) {
            std::array<char, 16> out;
            out.fill('#');
            bool cut = false;
            const Written line = FrameTemplate(source, bench.names)
                                     .render(bench.scope(), std::span<char>(out).first(room), cut);
            CHECK(line.size <= room);
            CHECK(line.sum == protocol::xor_checksum({out.data(), line.size}));
            CHECK(cut);
            CHECK(out[room] == '#');
        }
    }
}

TEST_CASE("templates: errors say what is wrong and what was meant") {
    Bench bench;
    CHECK(bench.error("{position.x:.3f}") == "no error");
    CHECK(bench.error("{position.w:.3f}") == "unknown field \"position.w\" -> position.x");
    CHECK(bench.error("{heaters.nozzle.printd:.1f}").ends_with("-> heaters.nozzle.printed"));
    CHECK(bench.error("{position.x}").find("needs a format, such as {position.x:.2f}") != string::npos);
    CHECK(bench.error("{S}").find("needs a format") != string::npos);
    CHECK(bench.error("{var.count}").find("needs a format") != string::npos);
    CHECK(bench.error("{position.x:.7f}").find("unknown format \".7f\"") != string::npos);
    CHECK(bench.error("{position.x:%3.2f}")
              .find("expected .0f to .6f (+ before it for a sign), d, x, time, s, .1s to .512s, lower or "
                    "upper") != string::npos);
    CHECK(bench.error("{position.x:s}").find("is a number and cannot be written with the format \"s\"") !=
          string::npos);
    CHECK(bench.error("{screen.firmware:d}").find("is a text and cannot be written") != string::npos);
    CHECK(bench.error("{arg:.1f}").find("is a text") != string::npos);
    CHECK(bench.error("{position.x:.3f").find("a brace without its partner") != string::npos);
    CHECK(bench.error("position.x}").find("a brace without its partner") != string::npos);
    CHECK(bench.error("{}").find("unknown field \"\"") != string::npos);
    CHECK(bench.error("a\nb").find("control character") != string::npos);
    CHECK(bench.error("{var.cuont:d}").ends_with("-> count"));
    CHECK(bench.error("{Q|x:d}").find("is not a number") != string::npos);
    bench.names.request = false;
    CHECK(bench.error("{S:d}").find("known only where a request is answered") != string::npos);
    CHECK(bench.error("{text}").find("known only where a request is answered") != string::npos);
    bench.names.loop = false;
    CHECK(bench.error("{entry.name}").find("known only inside `for_each`") != string::npos);
}
