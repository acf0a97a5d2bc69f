// The burst at power-on of each shipped profile, byte for byte, and what a reset does.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "protocol/framing.h"
#include "tests/support/board_driver.h"
#include "tests/support/printers.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using std::string;
using std::vector;

namespace {

const string serial(16, '\xff');
const string l3 = "L3 PS:0 VL:0 MT:0 FT:0 AL:1 ST:1 WF:0 MR:100 FN: PG:0 TM:0 LA:0 LC:0";
const string l1 = "L1 X0.000 Y0.000 Z0.000 F0";
const string l22 = "L22 MS:0 MR:100 SP:100 EP:100 SH:0.00 EH:0.00";
const string jerk = "L24 P3 A7.00 B7.00 C0.50 D5.00";
const string l23 = "L23 SE:0 BE:1 BP:50 CE:0 HE:0 SP:0 ST:16 HC:0 HO:0";

string zero_l2(const string& sd) {
    return "L2 B:0.0 /0.0 /0 T0:0.0 /0.0 /0 T1:0.0 /0.0 /0 T2:0.0 /0.0 /0 SD:" + sd +
           " F0:0 F2:50 R:100 FR:0";
}

string l9(const string& name, const string& model, const string& version, const string& volume) {
    return "L9 DN:" + name + ";DM:" + model + ";SN:" + serial + ";FV:" + version + ";PV:" + volume +
           ";HV:V1.6;";
}

/// A message of the burst: its lines leave together.
using Message = vector<string>;
const Message l7{"L7 begin file list:0", "L7 P0 testpattern.gcode", "L7 P1 A30T", "L7 end file list:0"};

void check_burst(const char* profile, const vector<Message>& expected) {
    CAPTURE(profile);
    BoardDriver driver(profile);
    driver.run_until(0.7);
    string bytes;
    vector<string> timed;
    const double tick = machine::to_seconds(driver.board().profile().tick);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        for (const string& body : expected[i]) {
            bytes += protocol::frame(body);
            char at[32];
            std::snprintf(at, sizeof at, "%.2f ", static_cast<double>(i) * tick);
            timed.push_back(at + body);
        }
    }
    CHECK(join(driver.timed(0)) == join(timed));
    CHECK(driver.bytes() == bytes);
}

}  // namespace

TEST_CASE("boot: the A30T says 13 messages, one a tick of 50 ms") {
    const string id = l9("GEEETECH-A30T", "A30T", "V1.xx.03", "320.00 x 320.00 x 420.00");
    check_burst(
        "geeetech-a30t",
        {{l3}, {l1}, {zero_l2("0")}, {l3}, {id}, l7, {l22}, {jerk}, {jerk}, {jerk}, {jerk}, {l23}, {l23}});
}

TEST_CASE("boot: without a card there is no file list, and SD is 1") {
    const string id = l9("GEEETECH-A30T", "A30T", "V1.xx.03", "320.00 x 320.00 x 420.00");
    check_burst(
        "geeetech-a30t-no-card",
        {{l3}, {l1}, {zero_l2("1")}, {l3}, {id}, {l22}, {jerk}, {jerk}, {jerk}, {jerk}, {l23}, {l23}});
}

TEST_CASE("boot: the A30 and its screen through the first minute, as the golden transcript has it") {
    // The screen is plugged in after 12 s: what follows its message at power-up is lost, and L21 is answered
    // later.
    BoardDriver driver("geeetech-a30");
    std::string talk;
    const auto screen = [&](double at, const std::string& bytes) {
        driver.run_until(at);
        driver.feed(bytes);
    };
    screen(12.0, std::string("log A30 LCD OK\r\n\0", 17));
    screen(12.345, "M2134 FW:Vx.37.xx\r\n");
    screen(13.85, "M2134 FW:Vx.37.xx\r\n");
    screen(20.0, "M20 LCD\r\n");
    screen(22.0, "M104 S200.0\r\n");
    screen(24.0, "M23 cube.gco\r\nM24\r\nM105\r\nM27\r\n");
    driver.run_until(60);
    auto heard = driver.received().begin();
    for (const auto& line : driver.lines()) {
        for (; heard != driver.received().end() && heard->at <= line.at; ++heard)
            talk += fmt::format("{:.2f} < {}\n", heard->at, heard->line);
        talk += fmt::format("{:.2f} > {}\n", line.at, line.line);
    }
    std::replace(talk.begin(), talk.end(), '\xff', '?');  // the erased serial number
    std::ifstream in(FAUXBOARD_SOURCE_DIR "/tests/vectors/geeetech-a30-first-minute.txt");
    std::string golden;
    for (string text; std::getline(in, text);)
        golden += text.starts_with('#') ? "" : text + "\n";
    CHECK(talk == golden);
}

TEST_CASE("boot: the delta differs from the A30T by its name") {
    const string id = l9("GEEETECH-DELTA", "DELTA", "V1.xx.03", "170.00 x 170.00 x 260.00");
    check_burst(
        "smartto-delta",
        {{l3}, {l1}, {zero_l2("0")}, {l3}, {id}, l7, {l22}, {jerk}, {jerk}, {jerk}, {jerk}, {l23}, {l23}});
}

TEST_CASE("boot: the first seconds after the burst are those of the recorded board") {
    BoardDriver driver;
    driver.run_until(5.5);
    // The bed's first reading is one count high and prints 23.9: recorded.
    const string rest = " T0:22.3 /0.0 /0 T1:88.6 /0.0 /0 T2:106.0 /0.0 /0 SD:0 F0:0 F2:50 R:100 FR:0";
    CHECK(join(driver.timed(0.7)) == join({"0.85 L2 B:23.9 /0.0 /0" + rest, "1.75 L21 P0 S0",
                                           "2.95 L2 B:22.0 /0.0 /0" + rest, "3.25 " + l3, "3.85 L21 P0 S0"}));
}

TEST_CASE("boot: a missing card is told between the first temperatures and the first L21") {
    BoardDriver driver("geeetech-a30t-no-card");
    driver.run_until(1.9);
    const auto lines = driver.between(0.7, 1.9);
    REQUIRE(lines.size() == 3);
    CHECK(lines[0].body.starts_with("L2 B:23.9 "));
    CHECK(lines[0].body.find(" SD:1 ") != string::npos);
    CHECK(lines[1].body == "L18 P26 S1");
    CHECK(lines[2].body == "L21 P0 S0");
}

TEST_CASE("boot: a job that a power loss cut off is offered at the end of the burst") {
    struct Saved final : machine::JobPlaceStore {
        std::optional<std::string> load() override {
            filament::JobPlace place;
            place.path = "testpattern.gcode";
            place.bytes = 109;
            std::string bytes;
            filament::put_place(place, bytes);
            return bytes;
        }
        void keep(std::string_view) override {}
        void drop() override {}
    } store;
    {
        const char* profile = "geeetech-a30t";
        BoardDriver::Setup setup;
        setup.services.job_place = &store;
        BoardDriver driver(profile, setup);
        driver.run_until(0.8);
        CHECK(driver.lines().back().body == "L16 P0 15");
        driver.run_until(1);
        CHECK(driver.ask("M2130 P0 S0", 0.15).size() == 1);
        driver.world("board reset");
        driver.run_for(0.8);
        CHECK(driver.matching("L16").size() == 1);
    }
}

TEST_CASE("boot: the time of power-on shifts everything and changes nothing") {
    BoardDriver early;
    BoardDriver::Setup setup;
    setup.power_on_at = 1000;
    BoardDriver late("geeetech-a30t", setup);
    early.run_until(60);
    late.run_until(1060);
    CHECK(early.bytes() == late.bytes());
    CHECK(late.lines().front().at == doctest::Approx(1000));
    CHECK(late.lines().size() == early.lines().size());
}

TEST_CASE("boot: a reset starts anew, but what is physical stays") {
    BoardDriver driver;
    driver.run_until(1);
    driver.meet_screen();
    driver.world("filament in");
    driver.press_all(
        {"M140 S60", "M165 A0 B1 C0", "G1 X100 Y50 F6000", "M2139 P0 S0", "M92 X99", "M220 S50"});
    driver.heat_nozzle(160);
    driver.run_for(10);
    const double nozzle_c = driver.number("heaters.nozzle.true");
    CHECK(driver.number("position.x") == 100);
    driver.press("M290 Z1");  // queued, and gone with the reset
    const double reset = driver.now();
    driver.world("board reset");
    driver.run_for(4.5);

    // The second burst: filament is in, so FT is 1.
    const auto again = driver.bodies(reset, reset + 0.65);
    REQUIRE(again.size() == 16);
    CHECK(again[0] == "L3 PS:0 VL:0 MT:0 FT:1 AL:1 ST:1 WF:0 MR:100 FN: PG:0 TM:0 LA:0 LC:0");
    CHECK(again[1] == l1);
    CHECK(again[2] == zero_l2("0"));
    CHECK(again[15] == l23);
    CHECK(driver.matching("L24 P5", reset).empty());
    CHECK(driver.matching("L21", reset).size() == 2);
    CHECK(driver.number("heaters.bed.target") == 0);
    CHECK(driver.number("mixer.packed") == 100);
    CHECK(driver.number("position.x") == 0);
    CHECK(driver.number("settings.steps.x") == 80);
    CHECK(driver.number("speed.percent") == 100);
    CHECK(driver.number("filament.present") == 1);
    CHECK(driver.number("heaters.nozzle.true") == doctest::Approx(nozzle_c).epsilon(0.02));
    CHECK(driver.number("heaters.nozzle.true") < nozzle_c);
}

TEST_CASE("boot: half a request from before a reset is not joined to one after it") {
    BoardDriver driver;
    driver.run_until(1);
    driver.feed("N-0 M1");
    driver.world("board reset");
    driver.run_for(1);
    CHECK(driver.ask("M115").size() == 1);
    CHECK(driver.board().counters().bad_frames == 0);
}
