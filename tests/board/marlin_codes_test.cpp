// Codes of a Marlin board that take their time, or need an option: what they say from the first line to the
// ok.

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "emulator/behaviour/profile.h"
#include "emulator/host/profile_files.h"
#include "tests/support/board_driver.h"
#include "tests/support/marlin.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using board::Channel;

namespace {

struct Marlin : MarlinBench {
    Marlin() = default;
    explicit Marlin(const std::string& variables)
        : MarlinBench(behaviour::load_profile(
              {"own.json", R"({"name": "own", "extends": "marlin", "variables": {)" + variables + "}}"},
              host::profile_finder())) {}
};

/// What stands behind the last `key`, up to a blank or the line's end.
double behind(const std::string& text, const std::string& key) {
    const std::size_t at = text.rfind(key);
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + key.size()));
}

constexpr std::string_view paused =
    "//action:prompt_end\n//action:prompt_begin Paused\n//action:prompt_button PurgeMore\n";

TEST_CASE_FIXTURE(Marlin,
                  "Marlin: M48 touches one place again and again, and tells how far the touches lie apart") {
    CHECK(told("M48") == "echo:Home XYZ First\r\nok\n");
    home();
    CHECK(told("M48 P3") == "?Sample size not plausible (4-50).\nok\n");
    CHECK(told("M48 V5") == "?(V)erbose level implausible (0-4).\nok\n");
    const std::string usual = told("M48", 60);
    CHECK(usual.starts_with("M48 Z-Probe Repeatability Test\n"));
    CHECK_FALSE(has(usual, " of 10: z: "));
    CHECK(has(usual, "Finished!\nMean: "));
    CHECK(behind(usual, "Mean: ") == doctest::Approx(0.05).epsilon(0.1));
    CHECK(behind(usual, "Range: ") > 0);
    CHECK(behind(usual, "Range: ") ==
          doctest::Approx(behind(usual, "Max: ") - behind(usual, "Min: ")).epsilon(0.3));
    CHECK(behind(usual, "Standard Deviation: ") > 0);
    CHECK(behind(usual, "Standard Deviation: ") < 0.01);
    CHECK(has(usual, "\n\nX:"));
    CHECK(usual.ends_with("ok\n"));
    const std::string each = told("M48 P4 V2", 60);
    for (const char* touch : {"1 of 4: z: ", "2 of 4: z: ", "3 of 4: z: ", "4 of 4: z: "}) {
        CHECK(has(each, touch));
    }
    CHECK(behind(each, "Mean: ") != behind(usual, "Mean: "));
    CHECK_FALSE(has(told("M48 P4 V0", 60), "Mean"));
    // The same board finds the same.
    Marlin again;
    again.home();
    CHECK(again.told("M48", 60) == usual);
}

TEST_CASE_FIXTURE(Marlin,
                  "Marlin: G29 tells each point where it is asked to, and a dry run changes nothing") {
    home();
    CHECK(told("G29 L-5") == "? (L,R,F,B) out of bounds.\nok\n");
    CHECK(told("G29 V9") == "?(V)erbose level implausible (0-4).\nok\n");
    const std::string dry = told("G29 D V1", 120);
    CHECK(dry.starts_with("G29 Auto Bed Leveling (DRYRUN)\n"));
    CHECK(has(dry, "Probing mesh point 9/9.\nBilinear Leveling Grid:\n"));
    CHECK(has(told("M420"), "echo:Bed Leveling OFF\n"));
    const std::string all = told("G29 V3", 120);
    CHECK(has(all, "Probing mesh point 1/9.\nBed X: 10.00 Y: 10.00 Z: 0.05\n"));
    CHECK(has(told("M420"), "echo:Bed Leveling ON\n"));
}

TEST_CASE_FIXTURE(Marlin, "Marlin: M303 finds what the heater is like") {
    CHECK(told("M303 E0 S300") == "PID Autotune failed! Temperature too high\nok\n");
    CHECK(told("M303 E3") == "PID Autotune failed! Bad heater id\nok\n");
    const std::string nozzle = told("M303 E0 S100 C3", 300);
    CHECK(nozzle.starts_with("PID Autotune start\n"));
    CHECK(has(nozzle, "\n Classic PID\n"));
    CHECK(behind(nozzle, "min: ") < 100);
    CHECK(behind(nozzle, "max: ") > 100);
    const double ku = behind(nozzle, "Ku: ");
    const double tu = behind(nozzle, "Tu: ");
    CHECK(behind(nozzle, "#define DEFAULT_KP ") == doctest::Approx(0.6 * ku).epsilon(0.01));
    CHECK(behind(nozzle, "#define DEFAULT_KI ") == doctest::Approx(1.2 * ku / tu).epsilon(0.01));
    CHECK(behind(nozzle, "#define DEFAULT_KD ") == doctest::Approx(0.075 * ku * tu).epsilon(0.01));
    CHECK(nozzle.ends_with("ok\n"));
    // What it found is used only where U says so.
    CHECK(told("M301") == "  M301 P22.20 I1.08 D114.00\nok\n");
    const std::string hotter = told("M303 E0 S200 U1", 300);
    CHECK(behind(hotter, "bias: ") > behind(nozzle, "bias: "));
    char gains[64];
    (void)std::snprintf(gains, sizeof gains, "  M301 P%.2f I%.2f D%.2f\nok\n", behind(hotter, "DEFAULT_KP "),
                        behind(hotter, "DEFAULT_KI "), behind(hotter, "DEFAULT_KD "));
    CHECK(told("M301") == gains);
    const std::string bed = told("M303 E-1 S60", 600);
    CHECK(has(bed, "\n No overshoot\n"));
    CHECK(behind(bed, "#define DEFAULT_BED_KP ") == doctest::Approx(0.2 * behind(bed, "Ku: ")).epsilon(0.01));
}

TEST_CASE_FIXTURE(Marlin,
                  "Marlin: M701 and M702 move what M603 says, or what stands on the line, and nothing cold") {
    CHECK(told("M702") == "echo:Hotend too cold\nok\n");
    say("M104 S200", Channel::main, 200);
    CHECK(told("M702", 20) == "ok\n");
    CHECK(number("position.e") == doctest::Approx(-100));
    say("M603 L30 U20");
    say("M702", Channel::main, 20);
    CHECK(number("position.e") == doctest::Approx(-120));
    say("M702 U5", Channel::main, 20);
    CHECK(number("position.e") == doctest::Approx(-125));
    CHECK(has(told("M701", 20), paused));
    CHECK(number("position.e") == doctest::Approx(-95));
    // The feed of a host's moves is still its own.
    say("M876 S1");
    home();
    say("G1 X1 F6000", Channel::main, 1);
    say("M702 U5", Channel::main, 20);
    say("G1 X101", Channel::main, 1.5);
    CHECK(number("motion.busy") == 0);
}

TEST_CASE_FIXTURE(Marlin, "Marlin: M928 writes what comes, and carries it out as well") {
    CHECK(told("M928 log.gco") == "echo:Now fresh file: log.gco\nWriting to file: log.gco\nok\n");
    say("M110 N0");
    forget();
    const auto numbered = [&](const std::string& body) {
        unsigned sum = 0;
        for (const char c : body) {
            sum ^= static_cast<unsigned char>(c);
        }
        return told(body + "*" + std::to_string(sum), 1);
    };
    CHECK(numbered("N1 M92") == "  M92 X80.00 Y80.00 Z400.00 E500.00\nok\n");
    CHECK(numbered("N2 G1 X10 F3000") == "ok\n");
    CHECK(number("position.x") == doctest::Approx(10));
    CHECK(numbered("N3 M29") == "Done saving file.\nok\n");
    CHECK(has(told("M20"), "LOG.GCO "));
    std::string text(100, '\0');
    const auto read = card.read("log.gco", 0, text);
    REQUIRE(read.has_value());
    CHECK(text.substr(0, *read) == "M92\r\nG1 X10 F3000\r\n");
    // M28 after it is still in the log, and what follows in its file alone.
    say("M928 log.gco");
    CHECK(numbered("N4 M28 up.gco") == "echo:Now fresh file: up.gco\nWriting to file: up.gco\nok\n");
    CHECK(numbered("N5 G1 X20") == "ok\n");
    CHECK(numbered("N6 M29") == "Done saving file.\nok\n");
    const auto content = [&](const char* name) {
        const auto size = card.read(name, 0, text);
        return size ? text.substr(0, *size) : "";
    };
    CHECK(content("log.gco") == "M28 up.gco\r\n");
    CHECK(content("up.gco") == "G1 X20\r\n");
    CHECK(number("position.x") == doctest::Approx(20));
    // M28 carries nothing out, also after it.
    say("M110 N3");
    say("M28 up.gco");
    CHECK(numbered("N4 M92") == "ok\n");
    CHECK(numbered("N5 M29") == "Done saving file.\nok\n");
}

TEST_CASE_FIXTURE(Marlin, "Marlin: M78 counts the prints, their time and the filament") {
    say("M104 S200", Channel::main, 200);
    put("ONE.G", "M302 P1\nG92 E0\nG1 E100 F600\nG4 S30\n");
    say("M23 one.g");
    say("M24", Channel::main, 120);
    say("M23 one.g");
    say("M24", Channel::main, 10);
    say("M524", Channel::main, 10);
    const std::string stats = told("M78");
    CHECK(has(stats, "Stats: Prints: 2, Finished: 1, Failed: 1\n"));
    CHECK(behind(stats, "Filament used: ") > 0);
    CHECK(told("M78 S78") == "ok\n");
    CHECK(has(told("M78"), "Stats: Prints: 0, Finished: 0, Failed: 0\n"));
}

TEST_CASE("Marlin: filament that runs out pauses the print, asks, and goes on with new filament") {
    Marlin board(R"("runout": {"value": 1})");
    CHECK(board.told("M412") == "echo:Filament runout ON ; Distance 25.00mm ; Host handling OFF\nok\n");
    CHECK(has(board.told("M115"), "Cap:RUNOUT:1\n"));
    board.world("filament in");
    board.home();
    board.say("M104 S200", Channel::main, 200);
    board.put("LONG.G", "G1 X100 Z1 F6000\nG1 X0\nM400\nG1 X100\nG1 X0\nM400\nG1 X100\nG1 X7\n");
    board.say("M23 long.g");
    board.say("M24", Channel::main, 0.5);
    board.forget();
    board.world("filament out");
    CHECK(has(board.said(),
              "//action:prompt_end\n//action:prompt_begin FilamentRunout T0\n//action:prompt_show\n"
              "//action:paused filament_runout 0\n//action:paused\n"));
    board.run_for(30);
    CHECK(has(board.said(), "echo:Insert filament and send M108\n"));
    CHECK(board.number("job.status") == 2);
    board.forget();
    SUBCASE("new filament") {
        board.world("filament in");
        const std::string question = board.told("M108");
        CHECK(has(question, std::string(paused) + "//action:prompt_button Continue\n"));
        CHECK(has(board.told("M876 S1", 1), "//action:prompt_end\n//action:resumed\n"));
        CHECK(board.told("M412") == "echo:Filament runout ON ; Distance 25.00mm ; Host handling OFF\nok\n");
    }
    SUBCASE("none: the detector can be switched off") {
        const std::string question = board.told("M876 S0");
        CHECK(has(question, std::string(paused) + "//action:prompt_button DisableRunout\n"));
        CHECK(has(board.told("M876 S1", 1), "//action:resumed\n"));
        CHECK(board.told("M412") == "echo:Filament runout OFF ; Distance 25.00mm ; Host handling OFF\nok\n");
    }
    CHECK(board.number("job.status") == 1);
    board.forget();
    board.run_for(120);
    CHECK(has(board.said(), "Done printing file\n"));
    // Parked 20 mm higher meanwhile, it went on where it was.
    CHECK(board.number("position.x") == doctest::Approx(7));
    CHECK(board.number("position.z") == doctest::Approx(1));
}

TEST_CASE(
    "Marlin: filament that runs out is the host's business where M412 H1 says so, and nobody's where it is "
    "off") {
    Marlin board(R"("runout": {"value": 1})");
    board.world("filament in");
    board.home();
    board.say("M412 H1");
    CHECK(board.told("M412") == "echo:Filament runout ON ; Distance 25.00mm ; Host handling ON\nok\n");
    board.put("LONG.G", "G1 X100 F600\nG1 X0\nG1 X100\nG1 X0\n");
    board.say("M23 long.g");
    board.say("M24", Channel::main, 2);
    board.forget();
    board.world("filament out");
    CHECK(has(board.said(), "//action:filament_runout T0\n//action:pause filament_runout 0\n"));
    CHECK(board.number("job.status") == 1);
    board.world("filament in");
    board.say("M412 S0");
    board.forget();
    board.world("filament out");
    CHECK(board.said().empty());
}

TEST_CASE_FIXTURE(
    Marlin, "Marlin: after M600 and M125 the head goes back to where it was, for a host and for a file") {
    home();
    say("M104 S200", Channel::main, 200);
    const auto answer = [&](bool two) {
        run_for(20);
        say("M876 S0", Channel::main, two ? 1 : 20);
        if (two) {
            say("M876 S1", Channel::main, 20);
        }
    };
    for (const char* code : {"M600", "M125"}) {
        CAPTURE(code);
        const bool two = code == std::string("M600");
        say("G1 X50 Y40 Z1 F6000", Channel::main, 5);
        say(code);
        answer(two);
        CHECK(told("M114").starts_with("X:50.00 Y:40.00 Z:1.00 "));
        put("F.G", std::string("G1 X30 Y20 Z2 F6000\n") + code + "\nG1 X31\nM400\n");
        say("M23 f.g");
        say("M24");
        answer(two);
        CHECK(told("M114").starts_with("X:31.00 Y:20.00 Z:2.00 "));
        REQUIRE(card.remove("F.G"));
    }
}

TEST_CASE("Marlin: texts for the display are told the host, where it was built so") {
    Marlin board(R"("notifications": {"value": 1})");
    CHECK(board.told("M117 hello") == "//action:notification hello\r\nok\n");
    CHECK(has(board.told("M500"), "//action:notification Settings Stored\n"));
    Marlin usual;
    CHECK(usual.told("M117 hello") == "ok\n");
}

TEST_CASE("Marlin: a cold arc takes as long as its way, however much filament it asks for") {
    Marlin board;
    CHECK(board.told("G2 I5 E965811781806281208 F6000", 1) == "echo: cold extrusion prevented\nok\n");
    CHECK(board.told("M400", 1) == "ok\n");
}

TEST_CASE("Marlin: the power switch, the input shaping, where they are there") {
    Marlin board(R"("power_switch": {"value": 1}, "input_shaping": {"value": 1})");
    CHECK(board.told("M80 S") == "PS:1\nok\n");
    CHECK(board.told("M81") == "PowerOff\nok\n");
    CHECK(board.told("M81") == "ok\n");
    CHECK(board.told("M593") == "  M593 X F40.00 D0.15\n  M593 Y F40.00 D0.15\nok\n");
    CHECK(board.told("M593 F5") == "?Frequency (F) must be greater than 20 or 0 to disable\nok\n");
    CHECK(board.told("M593 D2") == "echo:?Zeta (D) value out of range (0-1)\nok\n");
    Marlin usual;
    CHECK(usual.told("M81") == "ok\n");
}

}  // namespace
