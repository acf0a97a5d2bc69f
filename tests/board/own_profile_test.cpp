// What a user's own profile can do without compiling, and a profile put in force while the board runs.

#include <doctest/doctest.h>

#include "emulator/host/profile_files.h"
#include "tests/support/board_driver.h"
#include "tests/support/small_profile.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using std::string;

namespace {

/// A profile on top of a shipped one.
std::shared_ptr<const behaviour::Profile> own(const string& rest, const char* base = "geeetech-a30t") {
    return behaviour::load_profile(
        {"own.json", R"({ "name": "own", "extends": ")" + string(base) + "\"" + rest + " }"},
        host::profile_finder());
}

void get_ready(BoardDriver& driver) {
    driver.run_until(1);
    driver.meet_screen();
    driver.run_to_quiet();
}

}  // namespace

TEST_CASE("own profile: a new code with a reply, a changed format, a new event") {
    BoardDriver driver(own(R"(,
        "frames": { "hello": "L99 hello {S|7:d} of {identity.model}", "L24.babystep": "L24 P5 A{babystep.z:.3f}" },
        "requests": { "M9999": { "send": "hello" } },
        "events": { "filament.inserted": { "send": "hello" } })"),
                       {});
    get_ready(driver);
    CHECK(join(driver.ask("M9999 S3", 0.15)) == "L99 hello 3 of A30T\n");
    CHECK(join(driver.ask("M9999", 0.15)) == "L99 hello 7 of A30T\n");
    CHECK(join(driver.ask("M2140 S5", 0.15)) == "L24 P5 A0.000\n");
    driver.run_to_quiet();
    const double from = driver.now();
    driver.world("filament in");
    driver.run_for(0.2);
    CHECK(join(driver.bodies(from)) == "L99 hello  of A30T\n");  // no request, so no parameter
}

TEST_CASE("own profile: null takes a request away, and it is unknown then") {
    BoardDriver driver(own(R"(, "requests": { "M115": null })"), {});
    get_ready(driver);
    CHECK(driver.ask("M115", 0.15).empty());
    CHECK(driver.board().counters().unknown_codes == 1);
}

TEST_CASE("own profile: the switches of the base bring L5 and L6") {
    BoardDriver driver(
        own(R"(, "variables": { "l5_replies": { "value": 1 }, "l6_replies": { "value": 1 } })"), {});
    get_ready(driver);
    CHECK(join(driver.ask("M220 S150", 0.15)) == "L5 S150\n");
    CHECK(join(driver.ask("M106 P0 S255", 0.15)) == "L6 P0 S100\n");
    driver.run_to_quiet();
    CHECK(join(driver.ask("M106 P2 S128", 0.15)) == "L6 P2 S50\n");
    CHECK(join(driver.ask("M107", 0.15)) == "L6 P0 S0\n");
}

TEST_CASE("own profile: a U-disk port shows in SD, and its disk can be chosen") {
    BoardDriver driver(own(R"(, "machine": { "udisk_port": true })"), {});
    get_ready(driver);
    CHECK(driver.ask("M105", 0.15).at(0).find(" SD:16 ") != string::npos);
}

TEST_CASE("own profile: events that raise each other without end are stopped and told") {
    BoardDriver driver(own(R"(, "events": { "filament.inserted": { "do": "filament.remove" },
                                            "filament.removed": { "do": "filament.insert" } })"),
                       {});
    get_ready(driver);
    driver.world("filament in");
    const auto& told = driver.notices();
    CHECK(std::any_of(told.begin(), told.end(), [](const string& text) {
        return text.find("raise each other without end") != string::npos;
    }));
    CHECK(driver.ask("M115", 0.15).size() == 1);
}

TEST_CASE("own profile: a reset out of a rule drops what that rule still had to send") {
    BoardDriver driver(own(R"(, "requests": { "M9999": { "do": "board.reset", "send": "L9" } })"), {});
    get_ready(driver);
    const double pressed = driver.now();
    driver.press_all({"M9999", "M2140 S5"});
    driver.run_for(0.7);
    const auto said_lines = driver.bodies(pressed);
    CHECK(said_lines.size() == 16);
    CHECK(said_lines.front().starts_with("L3 PS:0 "));
    CHECK(driver.matching("L24 P5", pressed).empty());
}

TEST_CASE("a long file name never costs L3 its progress") {
    struct Card final : machine::Volume {
        string name = string(200, 'x') + "\r\n.gco";
        bool list(std::string_view, std::vector<machine::CardEntry>& out) const override {
            out.push_back({name, false, 5});
            return true;
        }
        Kind look(std::string_view, std::uint64_t& bytes) const override {
            bytes = 5;
            return Kind::file;
        }
        std::optional<std::size_t> read(std::string_view, std::uint64_t offset,
                                        std::span<char> out) const override {
            return offset < 5 ? std::string_view("G4 S9").copy(out.data(), out.size(), offset) : 0;
        }
    } card;
    {
        BoardDriver::Setup setup;
        setup.services.sd = &card;
        BoardDriver driver("geeetech-a30t", setup);
        get_ready(driver);
        driver.press_all({"M23 " + string(250, 'y'), "M24"});
        driver.run_for(1);
        REQUIRE(driver.number("job.status") == 1);
        const auto l3 = driver.matching("L3 PS:1");
        REQUIRE(!l3.empty());
        CHECK(l3[0].body.find("yyy PG:0 TM:0 ") != string::npos);
        CHECK(driver.board().counters().lines_cut == 0);
    }
}

TEST_CASE("reload: frames, rules and schedule change at once; state, queues and variables stay") {
    BoardDriver driver;
    get_ready(driver);
    driver.press_all({"G1 X50 F6000", "M2140 S6", "M2140 S5"});
    driver.board().reload(own(R"(, "frames": { "L24.babystep": "L24 P5 new {babystep.z:.1f}" },
                                   "requests": { "M9999": { "send": "L9" } })"));
    const double from = driver.now();
    driver.run_for(0.25);
    CHECK(join(driver.bodies(from)) == "L24 P6 A0.00 B0.00\nL24 P5 new 0.0\n");
    CHECK(driver.number("position.x") == 50);
    CHECK(driver.ask("M9999", 0.15).size() == 1);
    driver.run_for(20);
    CHECK(driver.matching("L3", from).size() >= 4);
}

TEST_CASE("reload: from a board without a schedule to one with, and back") {
    const auto silent = own(R"(, "schedule": null)");
    const auto lively = shipped_profile("geeetech-a30t");
    BoardDriver driver(silent, {});
    driver.run_until(10);
    CHECK(driver.between(1, 10).empty());
    driver.board().reload(lively);
    driver.run_until(30);
    CHECK(driver.matching("L3", 10).size() >= 4);
    driver.host("M190 S60");  // the schedule is frozen when it is taken away
    driver.run_until(40);
    driver.board().reload(silent);
    driver.press("M108");
    driver.run_until(41);
    driver.run_until(60);
    CHECK(driver.between(41, 60).empty());
}
