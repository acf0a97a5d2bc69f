// The USB side writes a file onto the card (M28 to M29) and deletes one (M30).

#include <doctest/doctest.h>

#include <string>

#include "protocol/framing.h"
#include "tests/support/board_driver.h"
#include "tests/support/host_program.h"
#include "tests/support/sliced_file.h"

using namespace fauxboard;
using namespace fauxboard::testing;

namespace {

/// A board whose card can be written to.
struct Writing {
    MemoryDisk disk;
    BoardDriver driver;

    Writing() : driver("geeetech-a30t", setup()) {
        disk.set_room(1U << 22);
        driver.finish_boot();
    }
    BoardDriver::Setup setup() {
        disk.put("old.gco", "G28\n");
        BoardDriver::Setup made;
        made.services.sd = &disk;
        return made;
    }
    /// What the host is told of a line.
    std::string told(std::string_view line) {
        const std::size_t before = driver.replies().size();
        driver.host(line);
        driver.run_for(0.2);
        std::string out;
        for (std::size_t i = before; i < driver.replies().size(); ++i) {
            out += driver.replies()[i].line + "\n";
        }
        return out;
    }
    std::string content(std::string_view path) const {
        const std::string* const found = disk.content(path);
        return found == nullptr ? "(none)" : *found;
    }
};

std::string numbered(int number, const std::string& command) {
    const std::string line = "N" + std::to_string(number) + " " + command;
    return line + "*" + std::to_string(protocol::xor_checksum(line));
}

}  // namespace

TEST_CASE_FIXTURE(Writing, "host file: lines are written and not carried out, each with its ok") {
    CHECK(told("M28 new.gco") == "Writing to file: new.gco\nok\n");
    CHECK(driver.number("host.writing") == 1);
    CHECK(told("M104 S200") == "ok\n");
    CHECK(told("G28") == "ok\n");
    CHECK(told("M117 a text; and a remark") == "ok\n");
    CHECK(told("M105") == "ok\n");
    CHECK(told("M2999 nobody knows") == "ok\n");
    CHECK(told("M28 another.gco") == "ok\n");
    CHECK(told("M290 Z0.1") == "ok\n");
    CHECK(content("new.gco") == "(none)");
    CHECK(told("M29") == "Done saving file.\nok\n");
    CHECK(driver.number("host.writing") == 0);
    CHECK(
        content("new.gco") ==
        "M104 S200\r\nG28\r\nM117 a text\r\nM105\r\nM2999 nobody knows\r\nM28 another.gco\r\nM290 Z0.1\r\n");
    CHECK(content("another.gco") == "(none)");
    CHECK(content("new.gco.temp") == "(none)");
    CHECK(driver.number("heaters.nozzle.target") == 0);
    CHECK(driver.number("motion.busy") == 0);
    CHECK(told("M104 S180") == "ok\n");
    CHECK(driver.number("heaters.nozzle.target") == 180);
    CHECK(told("M29") == "ok\n");  // with nothing open, as in Marlin
}

TEST_CASE_FIXTURE(Writing, "host file: a move under way holds nothing up, and goes on") {
    driver.host("G1 X100 F600");
    driver.run_for(0.5);
    driver.host("G28");
    driver.run_for(0.5);
    REQUIRE(driver.number("motion.busy") == 1);
    const std::size_t before = driver.replies().size();
    driver.host("M28 new.gco");
    driver.run_for(0.5);
    CHECK(driver.replies().size() == before);  // a homing is over before anything else begins
    driver.run_for(120);
    CHECK(driver.number("motion.homed") == 1);
    CHECK(driver.number("host.writing") == 1);
    driver.press("G1 X50 F60");
    driver.run_for(0.5);
    CHECK(told("G28") == "ok\n");
}

TEST_CASE_FIXTURE(Writing, "host file: numbers and checksums count while writing") {
    CHECK(told("N0 M110 N0*125") == "ok\n");
    CHECK(told(numbered(1, "M28 new.gco")) == "Writing to file: new.gco\nok\n");
    CHECK(told(numbered(2, "G1 X1")) == "ok\n");
    CHECK(told("N3 G1 X2*1") == "Error:checksum mismatch, Last Line: 2\nResend: 3\nok\n");
    CHECK(told(numbered(4, "G1 X3")) ==
          "Error:Line Number is not Last Line Number+1, Last Line: 2\nResend: 3\nok\n");
    CHECK(told(numbered(3, "G1 X2")) == "ok\n");
    CHECK(told(numbered(4, "G1 X3")) == "ok\n");
    CHECK(told(numbered(5, "M29")) == "Done saving file.\nok\n");
    CHECK(content("new.gco") == "G1 X1\r\nG1 X2\r\nG1 X3\r\n");
}

TEST_CASE_FIXTURE(Writing,
                  "host file: a sliced file over a bad line stands on the card as it was, and prints") {
    SlicedFile wishes;
    wishes.moves = 2000;
    wishes.layers = 10;
    std::string expected;
    const std::string file = make_sliced_file(wishes);
    for (std::size_t at = 0; at < file.size();) {
        const std::size_t end = file.find('\n', at);
        std::string line = file.substr(at, end - at);
        line = line.substr(0, line.find(';'));
        line = line.substr(0, line.find_last_not_of(" \r") + 1);
        expected += line.empty() ? "" : line + "\r\n";
        at = end + 1;
    }
    HostProgram host(driver, {3, 20, 10});
    CHECK(host.print("M28 part.gco\n" + file + "M29\n", 1e5, [](const std::string&) {}));
    CHECK(host.damaged() > 10);
    CHECK(host.lost() > 5);
    const bool same = content("part.gco") == expected;
    CHECK(same);
    CHECK(driver.number("host.moves") == 0);
    driver.press_all({"M23 part.gco", "M24"});
    driver.run_for(100'000);
    CHECK(driver.number("job.moves") >= 2000);
    CHECK(driver.number("job.unknown_codes") == 0);
}

TEST_CASE_FIXTURE(Writing, "host file: cut off before M29, no half file stands under the name") {
    told("M28 old.gco");
    for (int i = 0; i < 200; ++i) {
        told("G1 X" + std::to_string(i));
    }
    CHECK(content("old.gco.temp").size() > 1000);  // it is written as it comes
    driver.world("board reset");
    driver.run_for(3);
    CHECK(content("old.gco") == "G28\n");
    CHECK(driver.number("host.writing") == 0);
    CHECK(told("M29") == "ok\n");
    CHECK(content("old.gco") == "G28\n");
    CHECK(told("M28 old.gco") == "Writing to file: old.gco\nok\n");
    CHECK(told("M29") == "Done saving file.\nok\n");
    CHECK(content("old.gco").empty());
}

TEST_CASE_FIXTURE(Writing,
                  "host file: a disk that takes no more is said, and what comes then is not printed") {
    disk.set_room(2000);
    told("M28 old.gco");
    std::string said;
    for (int i = 0; i < 300; ++i) {
        said += told("M104 S" + std::to_string(i % 200));
    }
    CHECK(said.find("Error:error writing to file\n") != std::string::npos);
    CHECK(said.find("Error:") == said.rfind("Error:"));
    CHECK(driver.number("heaters.nozzle.target") == 0);
    CHECK(told("M29") == "Error:error writing to file\nok\n");
    CHECK(content("old.gco") == "G28\n");
    CHECK(content("old.gco.temp") == "(none)");
    CHECK(told("M104 S50") == "ok\n");
    CHECK(driver.number("heaters.nozzle.target") == 50);
}

TEST_CASE_FIXTURE(Writing, "host file: the card pulled out while writing") {
    told("M28 old.gco");
    told("G1 X1");
    driver.world("card out");
    CHECK(told("G1 X2") == "ok\n");
    const std::string end = told("M29");
    CHECK(end.find("Error:error writing to file\n") != std::string::npos);
    CHECK(end.find("Done saving file.") == std::string::npos);
    CHECK(told("M28 new.gco") == "open failed, File: new.gco.\nok\n");
    CHECK(told("M30 old.gco") == "Deletion failed, File: old.gco.\nok\n");
    driver.world("card in");
    CHECK(content("old.gco") == "G28\n");
}

TEST_CASE_FIXTURE(Writing, "host file: M30 deletes files, counted from the root, and only files") {
    disk.put("sub/inner.gco", "G28\n");
    driver.press("M20 file:SD1:/sub");
    driver.run_for(0.5);
    REQUIRE(driver.text("card.folder") == "sub");
    CHECK(told("M30 old.gco") == "File deleted:old.gco\nok\n");
    CHECK(content("old.gco") == "(none)");
    CHECK(told("M30 old.gco") == "Deletion failed, File: old.gco.\nok\n");
    CHECK(told("M30 sub") == "Deletion failed, File: sub.\nok\n");
    CHECK(told("M30") == "Deletion failed, File: .\nok\n");
    CHECK(told("M30 /sub/inner.gco") == "File deleted:/sub/inner.gco\nok\n");
}

TEST_CASE_FIXTURE(Writing, "host file: neither writes nor deletes while the card is printed from") {
    disk.put("long.gco", "G4 S100\nG1 X1\n");
    driver.press_all({"M23 long.gco", "M24"});
    driver.run_for(1);
    const std::string refusal = "echo:A file of the card is being printed; stop it first.\nok\n";
    CHECK(told("M28 long.gco") == refusal);
    CHECK(told("M30 long.gco") == refusal);
    CHECK(content("long.gco") == "G4 S100\nG1 X1\n");
}

TEST_CASE_FIXTURE(Writing, "host file: an emergency stop acts at once and is no line of the file") {
    driver.press("M104 S200");
    driver.run_for(0.3);
    told("M28 new.gco");
    told("M112");
    CHECK(driver.number("heaters.nozzle.target") == 0);
    CHECK(told("G28").empty());
    driver.world("board reset");
    driver.run_for(1);
    CHECK(told("M23 new.gco").starts_with("open failed"));
}

TEST_CASE("host file: the card that a profile brings can be read only, and a person is told what to do") {
    BoardDriver driver;
    driver.finish_boot();
    driver.host("M28 new.gco");
    driver.run_for(0.2);
    const auto& replies = driver.replies();
    REQUIRE(replies.size() == 2);
    CHECK(replies[0].line == "open failed, File: new.gco.");
    CHECK(replies[1].line == "ok");
    CHECK(join(driver.notices()).find("with --sd") != std::string::npos);
    driver.host("M30 testpattern.gcode");
    driver.run_for(0.2);
    CHECK(driver.replies()[2].line == "Deletion failed, File: testpattern.gcode.");
}
