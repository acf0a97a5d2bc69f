// Every code of a ChiTu board's serial line: the bytes that come back, within the time that real clients
// give.

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "emulator/host/folder_card.h"
#include "tests/link/helpers.h"
#include "tests/support/board_driver.h"
#include "tests/support/chitu.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using link::test::TemporaryFolder;

namespace {

/// mariner reads one line within 0.1 s, and throws the rest away that comes within as much again.
constexpr double first_line_s = 0.1;
/// The first line must come within this.
constexpr double bench_s = 0.02;

std::string read_file(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void check_state(const BoardDriver& driver, const ChituVector& vector) {
    for (const auto& [path, value] : vector.state) {
        const std::string& shown = path;
        CAPTURE(shown);
        CHECK(driver.number(path) == doctest::Approx(value).epsilon(1e-9));
    }
    for (const auto& [path, value] : vector.texts) {
        const std::string& shown = path;
        CAPTURE(shown);
        CHECK(driver.text(path) == value);
    }
}

void run_vector(const std::string& profile, const ChituVector& vector) {
    TemporaryFolder folder;
    make_seed_stick(folder.file(""));
    host::FolderCard stick(folder.file(""));
    BoardDriver::Setup setup;
    setup.services.sd = vector.stick ? &stick : nullptr;
    BoardDriver driver(profile, setup);
    if (!vector.stick) {
        driver.machine().remove_card(0);  // what the profile brings itself
    }
    driver.run_until(2);
    for (const ChituVector::Preparation& step : vector.prepare) {
        driver.feed(step.send);
        driver.run_for(step.wait_s);
    }
    const double asked = driver.now();
    const std::size_t before = driver.bytes().size();
    const std::size_t lines = driver.lines().size();
    driver.feed(vector.send);
    driver.run_for(first_line_s);
    CHECK(driver.bytes().substr(before) == vector.reply);
    REQUIRE(driver.lines().size() > lines);
    CHECK(driver.lines()[lines].at - asked <= bench_s);
    if (vector.after_s > first_line_s) {
        driver.run_until(asked + vector.after_s);
    }
    driver.board().refresh(machine::from_seconds(driver.now()));
    check_state(driver, vector);
    for (const auto& [name, content] : vector.files) {
        CHECK(read_file(folder.file(name)) == content);
    }
    CHECK(driver.board().counters().bad_frames == 0);
    CHECK(driver.board().counters().unknown_codes == 0);
    CHECK(driver.board().counters().unmatched == 0);
}

void run_file(const char* name) {
    const ChituVectors file = load_chitu_vectors(name);
    REQUIRE(!file.vectors.empty());
    for (const ChituVector& vector : file.vectors) {
        CAPTURE(vector.name);
        run_vector(file.profile, vector);
    }
}

}  // namespace

TEST_CASE("chitu: every code gets the bytes it is to get, in time, and does what it says") {
    run_file("chitu");
}

TEST_CASE("chitu: the replies of a Photon") {
    run_file("chitu-photon");
}

TEST_CASE("chitu: the replies of firmware 4.4.3") {
    run_file("chitu-4.4.3");
}

TEST_CASE("chitu: the replies of a Saturn") {
    run_file("chitu-saturn");
}

TEST_CASE("chitu: the vectors hold every code of the list of codes, and all that clients send beside") {
    const ChituVectors file = load_chitu_vectors("chitu");
    std::set<std::string> seen;
    for (const ChituVector& vector : file.vectors) {
        seen.insert(vector.send.substr(0, vector.send.find_first_of(" \r\n")));
    }
    // The list of codes, section by section in its order.
    for (const char* code :
         {"M27",   "M110",  "M114",  "M115",  "M4000", "M4001", "M4002", "M4006",  // information
          "G0",    "G28",   "G29",   "G90",   "G91",                               // motion
          "M24",   "M25",   "M33",   "M106",  "M112",  "M6030",                    // print
          "M20",   "M28",   "M29",   "M30",                                        // files
          "M8004", "M8005", "M8006", "M8007", "M8008", "M8010", "M8013", "M8015",  "M8016",
          "M8026", "M8029", "M8030", "M8034", "M8070", "M8083", "M8084", "M8085",  "M8087",
          "M8093", "M8489", "M8500", "M8512", "M8513", "M9003", "M9005", "M99999",  // settings
          "M23",   "M4004", "M5000", "M5002",                                       // of unknown use
          "M8020", "M8021", "M8028", "M8071"}) {                                    // in its backup file
        CAPTURE(code);
        CHECK(seen.count(code) == 1);
    }
    for (const char* code : {"G1", "M18", "M21", "M22", "M84", "M104", "M105", "M107", "M140", "M300",
                             "M3000", "M3001", "M4003", "M4012", "M6032", "M8510", "M8511", "syn"}) {
        CAPTURE(code);
        CHECK(seen.count(code) == 1);
    }
}

TEST_CASE("chitu: what the console says at power-on, with a stick and without") {
    const std::string boot = "UART1 init OK\r\nstart\r\nstart\r\nstart_task\r\n";
    MemoryDisk stick;
    BoardDriver::Setup setup;
    setup.services.sd = &stick;
    BoardDriver with("elegoo-mars-pro", setup);
    with.run_until(2);
    CHECK(with.bytes() ==
          boot + "USB disk_OK\r\n//#####Error!cann't open file\r\nchitu_initial_file_autorun!\r\n");
    with.world("card out");
    with.run_for(1);
    const std::size_t before = with.bytes().size();
    with.world("board reset");
    with.run_for(1);
    CHECK(with.bytes().substr(before) == boot);
}

TEST_CASE("chitu: a stick that was put in is there only after a while, and said to be there then") {
    MemoryDisk stick;
    put_seed_stick(stick);
    BoardDriver::Setup setup;
    setup.services.sd = &stick;
    BoardDriver driver("elegoo-mars-pro", setup);
    driver.run_until(2);
    driver.world("card out");
    const auto ask = [&](const std::string& line) {
        const std::size_t before = driver.bytes().size();
        driver.feed(line + "\r\n");
        driver.run_for(0.1);
        return driver.bytes().substr(before);
    };
    CHECK(ask("M23 TEST.TXT") == "//Disk init fail!\r\nok N:0\r\n");
    driver.world("card in");
    driver.run_for(2);
    CHECK(ask("M6030 'TEST.TXT'") == "Error:File is not existed or empty, file /TEST.TXT\r\nok N:0\r\n");
    const std::size_t before = driver.bytes().size();
    driver.run_for(1);
    CHECK(driver.bytes().substr(before) == "USB disk_ok\r\nok\r\n");
    CHECK(ask("M23 TEST.TXT").starts_with("File opened:TEST.TXT Size:7\r\n"));
    driver.world("card broken");
    CHECK(ask("M23 TEST.TXT") == "//Disk init fail!\r\nok N:0\r\n");
}

TEST_CASE("chitu: M6040 restarts the board after its time, and answers nothing") {
    BoardDriver driver("elegoo-mars-pro");
    driver.run_until(2);
    driver.feed("M106 S256\r\n");
    driver.run_for(0.1);
    const std::size_t before = driver.bytes().size();
    driver.feed("M6040 I500\r\n");
    driver.run_for(0.45);
    CHECK(driver.bytes().size() == before);
    CHECK(driver.number("resin.led_fan") == 256);
    driver.run_for(0.1);
    CHECK(driver.bytes().substr(before).starts_with("UART1 init OK\r\nstart\r\n"));
    CHECK(driver.number("resin.led_fan") == 0);
}

TEST_CASE("chitu: settings saved by M8500 outlive a restart, others do not") {
    BoardDriver driver("elegoo-mars-pro");
    driver.run_until(2);
    driver.feed("M8026 I140\r\nM8500\r\nM8006 I20\r\n");
    driver.run_for(0.1);
    driver.world("board reset");
    driver.run_for(0.1);
    CHECK(driver.number("config.max_height") == 140);
    CHECK(driver.number("config.start_speed") == 30);
}

TEST_CASE("chitu: any split of the bytes is answered alike") {
    const std::string talk = "M4002\r\nN0 M110 N0*125\rM4000\nM20\r\n\0\0M6030 'x.ctb'\r\nM27\r\n";
    const auto answered = [&](std::size_t piece) {
        BoardDriver driver("elegoo-mars-pro");
        driver.run_until(2);
        for (std::size_t at = 0; at < talk.size(); at += piece) {
            driver.feed(std::string_view(talk).substr(at, piece));
        }
        driver.run_for(0.2);
        return driver.bytes();
    };
    const std::string whole = answered(talk.size());
    for (std::size_t piece = 1; piece < 9; ++piece) {
        CHECK(answered(piece) == whole);
    }
}

TEST_CASE("chitu 4.4.3: requests that come too fast hang it, a reset helps") {
    BoardDriver driver("chitu-4.4.3");
    driver.run_until(2);
    driver.feed("M4000\r\n");
    driver.run_for(0.1);
    driver.feed("M4000\r\n");
    driver.run_for(0.1);
    CHECK(driver.bytes().ends_with("ok N:0\r\nok N:1\r\n"));
    driver.feed("M4000\r\nM27\r\nM20\r\n");
    driver.run_for(1);
    const std::size_t hung = driver.bytes().size();
    CHECK_FALSE(driver.notices().empty());
    driver.feed("M4000\r\n");
    driver.run_for(10);
    CHECK(driver.bytes().size() == hung);
    driver.world("board reset");
    driver.run_for(1);
    driver.feed("M4000\r\n");
    driver.run_for(0.1);
    CHECK(driver.bytes().ends_with("\r\nok N:0\r\n"));
}
