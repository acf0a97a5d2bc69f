// The card: lists, folders, choosing a file, card in and out.

#include <doctest/doctest.h>

#include <map>

#include "tests/support/board_driver.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

void get_ready(BoardDriver& driver) {
    driver.run_until(1);
    driver.meet_screen();
    driver.run_until(3.4);
    driver.run_to_quiet();
}

/// A card whose entries a test makes up.
struct FakeCard final : machine::Volume {
    std::vector<machine::CardEntry> entries;
    bool list(std::string_view folder, std::vector<machine::CardEntry>& out) const override {
        if (!folder.empty()) {
            return false;
        }
        out.insert(out.end(), entries.begin(), entries.end());
        return true;
    }
    Kind look(std::string_view path, std::uint64_t& bytes) const override {
        for (const machine::CardEntry& entry : entries) {
            if (entry.name == path) {
                bytes = entry.bytes;
                return entry.folder ? Kind::folder : Kind::file;
            }
        }
        return Kind::missing;
    }
    std::optional<std::size_t> read(std::string_view, std::uint64_t, std::span<char>) const override {
        return std::nullopt;
    }
};

struct WithCard {
    FakeCard card;
    BoardDriver driver;
    explicit WithCard(const std::vector<std::string>& names, const char* profile = "geeetech-a30t")
        : card(make(names)), driver(profile, setup(card)) {
        get_ready(driver);
    }
    static FakeCard make(const std::vector<std::string>& names) {
        FakeCard card;
        for (const std::string& name : names) {
            card.entries.push_back({name, false, 100});
        }
        return card;
    }
    static BoardDriver::Setup setup(FakeCard& card) {
        BoardDriver::Setup setup;
        setup.services.sd = &card;
        return setup;
    }
};

}  // namespace

TEST_CASE("files: root, into a folder, and back by the entry that the list offers") {
    BoardDriver driver;
    get_ready(driver);
    const std::string root =
        "L7 begin file list:0\nL7 P0 testpattern.gcode\nL7 P1 A30T\nL7 end file list:0\n";
    CHECK(join(driver.ask("M20 LCD", 0.15)) == root);
    CHECK(join(driver.ask("M20 file:SD1:/A30T", 0.15)) ==
          "L7 begin file list:0\nL7 P0 Main/A30T\nL7 P1 A30Tcube_colored.gco\nL7 end file list:0\n");
    CHECK(join(driver.ask("M20 file:SD1:/Main/A30T", 0.15)) == root);
}

TEST_CASE("files: the lines of a list leave in one piece") {
    BoardDriver driver;
    get_ready(driver);
    const double pressed = driver.now();
    driver.press_all({"M20 LCD", "M2140 S5"});
    driver.run_for(0.5);
    const auto lines = driver.between(pressed, pressed + 0.5);
    REQUIRE(lines.size() == 5);
    for (int i = 0; i < 4; ++i) {
        CHECK(lines[static_cast<std::size_t>(i)].at == lines[0].at);
    }
    CHECK(lines[4].at == doctest::Approx(lines[0].at + 0.05).epsilon(0.001));
}

TEST_CASE("files: M23 answers with the frame that the real board leaves unfinished, name in small letters") {
    BoardDriver driver;
    get_ready(driver);
    driver.press("M20 file:SD1:/A30T");
    driver.run_for(0.2);
    const std::size_t before = driver.bytes().size();
    driver.press("M23 A30Tcube_colored.gco");
    driver.run_for(0.2);
    CHECK(driver.bytes().substr(before) == "N-0 L14 file select succeed!:a30tcube_colored.gco\r\n");
    CHECK(driver.text("job.path") == "A30T/A30Tcube_colored.gco");
}

TEST_CASE("files: a name that is not there is S3, a folder cannot be opened and is S10") {
    BoardDriver driver;
    get_ready(driver);
    CHECK(join(driver.ask("M23 nothing.gco", 0.15)) == "L18 P26 S3\n");
    CHECK(join(driver.ask("M23 A30Tcube_colored.gco", 0.15)) == "L18 P26 S3\n");  // it is in the folder
    CHECK(join(driver.ask("M23 A30T", 0.15)) == "L18 P26 S10\n");
    CHECK(driver.number("job.selected") == 0);
}

TEST_CASE("files: a checksum that the screen kept in the name is taken off, unless the file is called so") {
    WithCard plain({"x.gco"});
    CHECK(join(plain.driver.ask("M23 x.gco*74", 0.15)) == "raw:N-0 L14 file select succeed!:x.gco\n");
    WithCard starred({"x.gco", "x.gco*74"});
    CHECK(join(starred.driver.ask("M23 x.gco*74", 0.15)) == "raw:N-0 L14 file select succeed!:x.gco*74\n");
    CHECK(starred.driver.text("job.path") == "x.gco*74");
}

TEST_CASE("files: selecting another file, or a wrong one, while one prints does not end the job") {
    BoardDriver driver;
    get_ready(driver);
    driver.press_all({"M23 testpattern.gcode", "M24"});
    driver.run_for(1);
    REQUIRE(driver.number("job.status") == 1);
    driver.press("M23 nothing.gco");
    driver.run_for(1);
    CHECK(driver.number("job.status") == 1);
    CHECK(driver.text("job.path") == "testpattern.gcode");
}

TEST_CASE("files: no name on a card can break the line") {
    const std::string nasty = std::string("a\r\nN-0 L18 P26 S4*1\r\n") + '\0' + "b\x01.gco";
    WithCard card({nasty, "caf\xe9.gco", "*.gco", "{x}", std::string(255, 'n')});
    const std::size_t before = card.driver.bytes().size();
    card.driver.press("M20 LCD");
    card.driver.run_for(0.2);
    const std::string said_bytes = card.driver.bytes().substr(before);
    CHECK(said_bytes.find('\0') == std::string::npos);
    std::size_t lines = 0;
    for (std::size_t at = said_bytes.find("\r\n"); at != std::string::npos;
         at = said_bytes.find("\r\n", at + 2)) {
        ++lines;
    }
    CHECK(lines == 7);
    CHECK(static_cast<std::size_t>(std::count(said_bytes.begin(), said_bytes.end(), '\n')) == lines);
    CHECK(static_cast<std::size_t>(std::count(said_bytes.begin(), said_bytes.end(), '\r')) == lines);
    for (const std::string& body : card.driver.bodies(card.driver.now() - 0.15)) {
        CHECK(body.starts_with("L7 "));
    }
}

TEST_CASE("files: a full card is told up to what the screen's table holds, and the list has its end") {
    std::vector<std::string> names;
    for (int i = 0; i < 300; ++i) {
        names.push_back("a_rather_long_file_name_of_a_print_" + std::to_string(i) + ".gcode");
    }
    WithCard card(names);
    const double asked = card.driver.now();
    const auto said_lines = card.driver.ask("M20 LCD", 0.6);
    REQUIRE(said_lines.size() == 66);
    // In pieces that a screen's ring of 1279 bytes can take: no more than 480 bytes a tick.
    std::map<double, std::size_t> ticks;
    for (const auto& line : card.driver.matching("L7", asked)) {
        ticks[line.at] += line.line.size() + 2;
    }
    CHECK(ticks.size() > 6);
    for (const auto& [at, bytes] : ticks) {
        CHECK(bytes <= 480);
    }
    CHECK(said_lines.front() == "L7 begin file list:0");
    CHECK(said_lines[64] == "L7 P63 a_rather_long_file_name_of_a_print_63.gcode");
    CHECK(said_lines.back() == "L7 end file list:0");
}

TEST_CASE("files: names too long for one message are left out, the list still has its end") {
    std::vector<std::string> names;
    for (int i = 0; i < 60; ++i) {
        names.push_back(std::to_string(i) + std::string(240, 'x'));
    }
    WithCard card(names);
    const double asked = card.driver.now();
    card.driver.press("M20 LCD");
    card.driver.run_for(2);
    std::vector<std::string> said_lines;
    for (const auto& line : card.driver.matching("L7", asked)) {
        said_lines.push_back(line.body);
    }
    REQUIRE(said_lines.size() > 10);
    CHECK(said_lines.front() == "L7 begin file list:0");
    CHECK(said_lines.back() == "L7 end file list:0");
    for (const std::string& body : said_lines) {
        CHECK(body.starts_with("L7 "));
    }
    card.driver.run_to_quiet();
    CHECK(card.driver.ask("M2140 S5", 0.15).size() == 1);
}

TEST_CASE("card: taken out it is told, SD is 1 and there are no files; put in again all is as before") {
    BoardDriver driver;
    get_ready(driver);
    const double out = driver.now();
    driver.world("card out");
    driver.run_for(0.2);
    REQUIRE(driver.bodies(out).size() == 2);
    CHECK(driver.bodies(out)[0] == "L18 P26 S1");
    CHECK(driver.bodies(out)[1].find(" SD:1 ") != std::string::npos);
    CHECK(driver.ask("M105", 0.15)[0].find(" SD:1 ") != std::string::npos);
    CHECK(join(driver.ask("M20 LCD", 0.15)) == "L7 begin file list:0\nL7 end file list:0\n");
    driver.run_to_quiet();
    CHECK(join(driver.ask("M23 testpattern.gcode", 0.15)) == "L18 P26 S3\n");
    driver.world("card out");  // there is none to take out
    driver.world("card in");
    const double in = driver.now();
    driver.run_for(0.3);
    REQUIRE(driver.bodies(in).size() == 5);
    CHECK(driver.bodies(in)[0].find(" SD:0 ") != std::string::npos);
    CHECK(driver.bodies(in)[1] == "L7 begin file list:0");
    driver.run_to_quiet();
    CHECK(driver.ask("M105", 0.15)[0].find(" SD:0 ") != std::string::npos);
    driver.run_to_quiet();
    CHECK(driver.ask("M20 LCD", 0.15).size() == 4);
}

TEST_CASE("card: taken out and put in inside a folder, the root is shown") {
    BoardDriver driver;
    get_ready(driver);
    driver.press("M20 file:SD1:/A30T");
    driver.run_for(0.2);
    driver.world("card out");
    driver.world("card in");
    driver.run_for(0.3);
    CHECK(driver.text("card.folder").empty());
}

TEST_CASE("card: M22 lets it go, M21 takes it back; a slot that is empty stays so") {
    BoardDriver driver;
    get_ready(driver);
    driver.press("M22");
    driver.run_for(0.3);
    CHECK(driver.number("card.code") == 1);
    driver.press("M21");
    driver.run_for(0.3);
    CHECK(driver.number("card.code") == 0);
    driver.world("card out");
    driver.press("M21");
    driver.run_for(0.3);
    CHECK(driver.number("card.code") == 1);
    BoardDriver empty("geeetech-a30t-no-card");
    empty.run_until(1);
    empty.press("M21");
    empty.run_for(0.3);
    CHECK(empty.number("card.code") == 1);
}

TEST_CASE("card: the plain M20 of a host lists names between two marks, at once and without frames") {
    BoardDriver driver;
    get_ready(driver);
    const std::size_t before = driver.bytes().size();
    driver.press("M20");
    driver.run_for(0.06);
    CHECK(driver.bytes().substr(before) ==
          "Begin file list\r\ntestpattern.gcode\r\nA30T\r\nEnd file list\r\n");
}
