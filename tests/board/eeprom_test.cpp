// M500, M501, M502, the settings that are stored at once, and what survives a reset.

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/board_driver.h"
#include "tests/support/memory_eeprom.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

BoardDriver::Setup with(MemoryEeprom& eeprom) {
    BoardDriver::Setup setup;
    setup.services.eeprom = &eeprom;
    return setup;
}

void do_all(BoardDriver& driver, const std::vector<std::string>& requests) {
    for (const std::string& request : requests) {
        driver.press(request);
        driver.run_for(0.2);
    }
}

std::string steps(BoardDriver& driver) {
    driver.run_to_quiet();
    return join(driver.ask("M2140 S0", 0.15));
}

constexpr const char* factory_steps = "L24 P0 A80.00 B80.00 C400.00 D390.00\n";

}  // namespace

TEST_CASE("EEPROM: what M500 stored comes back with M501, M2140 R0 and a reset") {
    for (const char* way : {"M501", "M2140 R0", ""}) {
        CAPTURE(way);
        BoardDriver driver;
        driver.run_until(1);
        do_all(driver, {"M2134 FW:1", "M92 X81.5 E400", "M500", "M92 X99"});
        CHECK(driver.number("settings.steps.x") == 99);
        if (*way != 0) {
            do_all(driver, {way});
        } else {
            driver.world("board reset");
            driver.run_for(1);
        }
        CHECK(driver.number("settings.steps.x") == 81.5);
        CHECK(driver.number("settings.steps.e") == 400);
        CHECK(driver.number("settings.steps.y") == 80);
    }
}

TEST_CASE("EEPROM: what was not stored is gone after a reset") {
    BoardDriver driver;
    driver.run_until(1);
    do_all(driver, {"M92 X99", "M201 X900", "M2011 P0 S0.5"});
    driver.world("board reset");
    driver.run_for(1);
    do_all(driver, {"M2134 FW:1"});
    CHECK(steps(driver) == factory_steps);
    CHECK(driver.number("settings.acceleration.x") == 500);
    CHECK(driver.number("settings.double_z.z0") == 0);
}

TEST_CASE("EEPROM: M2140 R0 brings back the steps and leaves the other pages alone") {
    BoardDriver driver;
    driver.run_until(1);
    do_all(driver, {"M92 X99", "M203 X99", "M2140 R0"});
    CHECK(driver.number("settings.steps.x") == 80);
    CHECK(driver.number("settings.velocity.x") == 99);
}

TEST_CASE("EEPROM: M502 is the factory's state, and stays out of the EEPROM until M500") {
    BoardDriver driver;
    driver.run_until(1);
    do_all(driver, {"M92 X99", "M2139 P0 S1", "M2120 P2 S-1.5", "M500", "M502"});
    CHECK(driver.number("settings.steps.x") == 80);
    CHECK(driver.number("addons.sound") == 0);
    CHECK(driver.number("leveling.z_offset") == -2.67);
    do_all(driver, {"M501"});
    CHECK(driver.number("settings.steps.x") == 99);
    CHECK(driver.number("addons.sound") == 1);
    do_all(driver, {"M502", "M500"});
    driver.world("board reset");
    driver.run_for(1);
    CHECK(driver.number("settings.steps.x") == 80);
    CHECK(driver.number("leveling.z_offset") == -2.67);
}

TEST_CASE("EEPROM: pages without a save button store at once, and nothing but their own") {
    struct Row {
        const char* request;
        const char* field;
        double value;
    };
    for (const Row& row :
         {Row{"M2139 P0 S1", "addons.sound", 1}, Row{"M2139 P1 E33", "addons.backlight_percent", 33},
          Row{"M2139 P2 W77", "addons.lock_password", 77}, Row{"M2106 P0 S0", "filament.detector", 0},
          Row{"M2120 P0 S0", "leveling.auto", 0}, Row{"M2120 P2 S-1.25", "leveling.z_offset", -1.25},
          Row{"M2120 P9 S0", "leveling.sensor", 0}}) {
        CAPTURE(row.request);
        BoardDriver driver;
        driver.run_until(1);
        do_all(driver, {"M92 X99", row.request});
        driver.world("board reset");
        driver.run_for(1);
        CHECK(driver.number(row.field) == row.value);
        CHECK(driver.number("settings.steps.x") == 80);
    }
}

TEST_CASE("EEPROM: manual leveling is stored with S8 and not before") {
    BoardDriver driver;
    driver.run_until(1);
    do_all(driver, {"M2107 S6", "M2107 S8", "M2107 S6"});
    driver.world("board reset");
    driver.run_for(1);
    CHECK(driver.number("leveling.manual_z") == 8.5);
}

TEST_CASE("EEPROM: a store keeps the settings from one board to the next") {
    MemoryEeprom eeprom;
    {
        BoardDriver driver("geeetech-a30t", with(eeprom));
        driver.run_until(1);
        CHECK(eeprom.saves == 0);  // looking at it writes nothing
        do_all(driver, {"M92 X81", "M500"});
        CHECK(eeprom.saves == 1);
    }
    BoardDriver driver("geeetech-a30t", with(eeprom));
    driver.run_until(1);
    CHECK(driver.number("settings.steps.x") == 81);
    do_all(driver, {"M502"});
    CHECK(driver.number("settings.steps.x") == 80);  // what the factory set, not what was stored
}

TEST_CASE("EEPROM: a store that fails is told, and the board goes on") {
    MemoryEeprom eeprom;
    eeprom.works = false;
    BoardDriver driver("geeetech-a30t", with(eeprom));
    driver.run_until(1);
    do_all(driver, {"M92 X81", "M500", "M501"});
    CHECK(eeprom.saves == 1);
    CHECK(driver.number("settings.steps.x") == 81);
    const auto& told = driver.notices();
    CHECK(std::any_of(told.begin(), told.end(), [](const std::string& text) {
        return text.find("EEPROM could not be written") != std::string::npos;
    }));
}

TEST_CASE("EEPROM: a broken image is read as far as it makes sense") {
    MemoryEeprom eeprom;
    eeprom.image =
        "settings.steps.x 81\nsettings.steps.y\nsettings.steps.z lots\nsettings.steps.e 1e999\n"
        "no.such.field 7\nsettings.velocity.x nan\nposition.x 5\nsettings.velocity.y -3\n\n \nleveling.auto "
        "0";
    BoardDriver driver("geeetech-a30t", with(eeprom));
    driver.run_until(1);
    CHECK(driver.number("settings.steps.x") == 81);
    CHECK(driver.number("settings.steps.y") == 80);
    CHECK(driver.number("settings.steps.z") == 400);
    CHECK(driver.number("settings.steps.e") == 390);
    CHECK(driver.number("settings.velocity.x") == 150);
    CHECK(driver.number("settings.velocity.y") == 0.01);  // kept within its bounds
    CHECK(driver.number("position.x") == 0);
    CHECK(driver.number("leveling.auto") == 0);
    do_all(driver, {"M500"});
    REQUIRE(eeprom.image.has_value());
    CHECK(eeprom.image->find("no.such.field 7\n") != std::string::npos);
}

TEST_CASE("EEPROM: M500 stalls the schedule for 40 to 150 ms, and replies not at all") {
    BoardDriver driver;
    driver.run_until(1);
    driver.meet_screen();
    driver.run_until(8);
    double shortest = 1;
    double longest = 0;
    for (int i = 0; i < 40; ++i) {
        driver.run_to_quiet();
        const double before = driver.matching("L3").back().at;
        driver.press("M500");
        driver.press("M2140 S5");
        const double pressed = driver.now();
        driver.run_for(8.4);
        const auto reply = driver.matching("L24 P5", pressed);
        REQUIRE(reply.size() == 1);
        CHECK(reply[0].at - pressed <= 0.155);
        const double next = driver.matching("L3", pressed)[0].at;
        const double rounds = std::floor((next - before) / 4.19916);
        const double stall = next - before - rounds * 4.19916;
        CHECK(stall >= 0.0399);
        CHECK(stall <= 0.2001);  // and up to one tick more, since frames leave on ticks
        shortest = std::min(shortest, stall);
        longest = std::max(longest, stall);
    }
    CHECK(longest - shortest > 0.03);  // it varies, as on the real board
}
