// A kind of machine that is made up and stands beside the real ones: a folder (beacon/), a row of CMake, a
// profile. Everything shared works with it, and nothing outside knows it.

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "emulator/behaviour/kind.h"
#include "emulator/behaviour/reference.h"
#include "emulator/fault/printer_fault.h"
#include "tests/support/board_driver.h"
#include "tests/support/memory_eeprom.h"
#include "tests/support/small_profile.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using std::string;

namespace {

const std::filesystem::path sources = FAUXBOARD_SOURCE_DIR;

constexpr std::string_view profile_text = R"({
  "name": "lighthouse", "protocol": "gcode",
  "machine": {
    "kind": "beacon", "beacon_period_s": 0.5,
    "card": { "entries": [ { "file": "ten.txt", "lines": [ "123456789" ] } ] }
  },
  "frames": { "ok": "ok", "blink": "blink {beacon.blinks:d} {beacon.brightness:.0f}%", "end": "end" },
  "requests": {
    "M1": { "do": { "beacon.switch": { "on": "{S}" } }, "send": "ok" },
    "M2": { "do": [ { "set": { "beacon.brightness": "{S}" } }, { "eeprom.save": {} } ], "send": "ok" },
    "M3": { "do": [ { "job.select": { "name": "{arg}" } }, "job.start" ], "send": "ok" },
    "M4": { "do": { "heater.target": { "heater": "bed", "c": 50 } }, "send": "ok" }
  },
  "events": { "beacon.blinked": { "send": "blink" }, "job.finished": { "send": "end" } }
})";

std::shared_ptr<const behaviour::Profile> lighthouse() {
    return behaviour::load_profile({"lighthouse.json", string(profile_text)}, finder_in({}));
}

std::vector<string> bodies(const BoardDriver& driver, double from, double to) {
    std::vector<string> out;
    for (const BoardDriver::Line& line : driver.between(from, to)) {
        out.push_back(line.line);
    }
    return out;
}

string text_of(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

/// The sources below some folders of the project.
std::vector<std::filesystem::path> files_in(std::initializer_list<const char*> folders) {
    std::vector<std::filesystem::path> files;
    for (const char* folder : folders) {
        for (const auto& item : std::filesystem::recursive_directory_iterator(sources / folder)) {
            if (item.is_regular_file() && item.path().extension() != ".md") {
                files.push_back(item.path());
            }
        }
    }
    return files;
}

}  // namespace

TEST_CASE("a made-up kind: requests, fields, actions and events of its own") {
    BoardDriver driver(lighthouse(), {});
    driver.feed("M1 S1\n");
    driver.run_until(2.2);
    CHECK(bodies(driver, 0, 2.2) ==
          std::vector<string>{"ok", "blink 1 50%", "blink 2 50%", "blink 3 50%", "blink 4 50%"});
    CHECK(driver.number("beacon.on") == 1);
    driver.feed("M1 S0\n");
    driver.run_until(10);
    CHECK(driver.number("beacon.blinks") == 4);
}

TEST_CASE("a made-up kind: job, EEPROM, faults and resets are those of every machine") {
    MemoryEeprom eeprom;
    BoardDriver::Setup setup;
    setup.services.eeprom = &eeprom;
    BoardDriver driver(lighthouse(), setup);
    driver.feed("M2 S80\n");
    driver.feed("M3 ten.txt\n");
    driver.run_until(5);
    CHECK(driver.number("job.status") == 1);
    driver.run_until(12);
    CHECK(bodies(driver, 10, 11).back() == "end");
    CHECK(driver.number("beacon.on") == 0);

    machine::Machine& machine = driver.machine();
    const auto request = [](const char* spec) { return fault::to_request(fault::fault_from_text(spec)); };
    CHECK(machine.faults.add(machine.now(), request("bulb_dead")) != 0);
    CHECK(machine.faults.add(machine.now(), request("jam")) == 0);
    CHECK(machine.faults.refusal(*request("jam").info) ==
          "a machine of the kind beacon has no part that jam could break");
    driver.run_for(0.1);
    CHECK(driver.number("faults.bulb_dead") == 1);
    const double before = driver.number("beacon.blinks");
    driver.feed("M1 S1\n");
    driver.run_for(3);
    CHECK(driver.number("beacon.blinks") == before);

    BoardDriver again(lighthouse(), setup);
    CHECK(again.number("beacon.brightness") == 80);
}

TEST_CASE("a made-up kind: what other kinds have is nothing to it") {
    BoardDriver driver(lighthouse(), {});
    CHECK(behaviour::find_field("heaters.bed.target")->get(driver.machine()).none());
    driver.feed("M4\n");
    driver.run_until(1);
    CHECK(bodies(driver, 0, 1) == std::vector<string>{"ok"});
}

TEST_CASE("a made-up kind: the reference knows it, and a wrong name of a kind is told") {
    CHECK(behaviour::describe_fields().dump().find("beacon.brightness") != string::npos);
    CHECK(behaviour::describe_actions().dump().find("beacon.switch") != string::npos);
    CHECK(machine::find_event("beacon.blinked").has_value());
    string text(profile_text);
    text.replace(text.find("\"beacon\""), 8, "\"becon\"");
    try {
        behaviour::load_profile({"wrong.json", text}, finder_in({}));
        FAIL("a kind that is not there was taken");
    } catch (const behaviour::ProfileError& error) {
        const string what = error.what();
        CAPTURE(what);
        CHECK(what.find("wrong.json:4: /machine/kind: found the text \"becon\"; expected a kind of machine: "
                        "filament, ") != string::npos);
        CHECK(what.find("did you mean \"beacon\"?") != string::npos);
    }
}

TEST_CASE("a made-up kind takes four files in its folder, one row of CMake, and a profile") {
    std::size_t own = 0;
    for (const auto& file : files_in({"tests/kinds/beacon"})) {
        own += file.extension() == ".h" || file.extension() == ".cpp" ? 1U : 0U;
    }
    CHECK(own == 4);
    for (const auto& file : files_in({"emulator", "protocol", "tools", "profiles"})) {
        CAPTURE(file.string());
        const string text = text_of(file);
        CHECK(text.find("beacon.h") == string::npos);
        CHECK(text.find("beacon::") == string::npos);
        CHECK(text.find("lighthouse") == string::npos);
    }
}
