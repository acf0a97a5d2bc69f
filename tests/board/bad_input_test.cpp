// Bytes that no good screen sends. Whatever comes, the board answers the next good request.

#include <doctest/doctest.h>

#include <utility>

#include "emulator/host/profile_files.h"
#include "protocol/framing.h"
#include "tests/support/board_driver.h"

using namespace fauxboard;
using namespace fauxboard::testing;
using std::string;
using namespace std::string_literals;

namespace {

/// A board ready to be fed, in a stretch in which it says nothing by itself.
struct Ready {
    BoardDriver driver;
    explicit Ready(std::shared_ptr<const behaviour::Profile> profile = shipped_profile("geeetech-a30t"))
        : driver(std::move(profile), {}) {
        driver.finish_boot();
    }

    /// Feeds, and gives what the board says to it.
    string answer(const string& bytes) {
        driver.run_to_quiet();
        const double from = driver.now();
        driver.feed(bytes);
        driver.run_for(0.4);
        return join(driver.bodies(from, from + 0.4));
    }
    /// The next good request is answered, at once and rightly.
    void check_alive() {
        CHECK(answer(protocol::frame("M2140 S5")) == "L24 P5 A0.00\n");
        CHECK(answer(protocol::frame("M2140 S6")) == "L24 P6 A0.00 B0.00\n");
    }
    const board::Counters& counters() { return driver.board().counters(); }
};

constexpr const char* good = "L24 P5 A0.00\n";

}  // namespace

TEST_CASE("bad checksums: wrong, missing, not a number, too long: dropped, counted, unanswered") {
    Ready ready;
    std::uint64_t bad = 0;
    for (const string line :
         {"N-0 M2140 S5*126", "N-0 M2140 S5", "N-0 M2140 S5*", "N-0 M2140 S5*x", "N-0 M2140 S5*12x",
          "N-0 M2140 S5*0x7f", "N-0 M2140 S5*-127", "N-0 M2140 S5*127127",
          "N-0 M2140 S5*99999999999999999999", "N-0 M2140 S5*383", "N-0 M2140 S5**127", "N-0 M2140 S5*127*",
          "N-0 M2140 S5*127 x", "*", "N-0 *115", "**", "N-0"}) {
        CAPTURE(line);
        CHECK(ready.answer(line + "\r\n").empty());
        ++bad;
        if (line == "N-0 *115") {
            --bad;  // a right frame around nothing
        }
        CHECK(ready.counters().bad_frames == bad);
    }
    ready.check_alive();
    CHECK(ready.counters().requests_lost == 0);
}

TEST_CASE("bad checksums: every single flipped bit of a frame is noticed or changes the request") {
    Ready ready;
    const string frame = protocol::frame("M2139 P0 S1");
    for (std::size_t i = 0; i + 2 < frame.size(); ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            string flipped = frame;
            flipped[i] = static_cast<char>(flipped[i] ^ (1 << bit));
            ready.driver.feed(flipped);
            ready.driver.feed("\r\n");
            ready.driver.run_for(0.2);
            CHECK(ready.driver.number("addons.sound") == 0);
        }
    }
    ready.check_alive();
}

TEST_CASE("line numbers: other than -0, several of them, or none") {
    Ready ready;
    const auto with_checksum = [](const string& line) {
        return line + "*" + std::to_string(protocol::xor_checksum(line)) + "\r\n";
    };
    for (const string line : {"N-1 M2140 S5", "N0 M2140 S5", "N17 M2140 S5", "N-0 N-0 M2140 S5",
                              "N-0  M2140 S5", "N99999999999999999999 M2140 S5", "N-0M2140 S5", "M2140 S5",
                              "  N-0 M2140 S5", "N-0 N-1 N5 M2140 S5"}) {
        CAPTURE(line);
        const string bytes =
            line.starts_with(' ') ? "  " + with_checksum(line.substr(2)) : with_checksum(line);
        CHECK(ready.answer(bytes) == good);
    }
    CHECK(ready.counters().bad_frames == 0);
    ready.check_alive();
}

TEST_CASE("a screen of bare lines: the checksum may be missing, and must be right where there is one") {
    Ready ready(behaviour::load_profile({"own.json", R"({ "name": "own", "extends": "geeetech-a30t",
                                                          "line": { "checksum": "if_present" } })"},
                                        host::profile_finder()));
    CHECK(ready.answer("M2140 S5\r\n") == good);
    CHECK(ready.answer("N-0 M2140 S5\r\n") == good);
    CHECK(ready.answer("N-0 M2140 S5*127\r\n") == good);
    CHECK(ready.answer("M2140 S5*\r\n") == good);
    CHECK(ready.answer("M2140 S5*1\r\n").empty());
    CHECK(ready.answer("N-0 M2140 S5*126\r\n").empty());
    CHECK(ready.counters().bad_frames == 2);
    ready.check_alive();
}

TEST_CASE("NULs anywhere are passed over and counted") {
    Ready ready;
    CHECK(ready.answer("log A30 LCD OK\r\n\0"s).empty());
    CHECK(ready.answer("\0\0N-0 M2140 S5*127\0\r\0\n\0"s) == good);
    CHECK(ready.answer("N-0 M21\0"s + "40 S5*127\r\n") == good);
    CHECK(ready.driver.board().nul_bytes() == 7);
    ready.check_alive();
}

TEST_CASE("line ends: CR, LF, CR LF and LF CR each end one line; empty lines are nothing") {
    Ready ready;
    for (const string end : {"\r", "\n", "\r\n", "\n\r", "\r\r\n\n\n"}) {
        CAPTURE(end.size());
        const std::uint64_t before = ready.counters().lines_received;
        CHECK(ready.answer("N-0 M2140 S5*127" + end) == good);
        CHECK(ready.counters().lines_received == before + 1);
    }
    CHECK(ready.answer("\r\n\r\n\n\n\r\r   \r\n").empty());
    ready.check_alive();
}

TEST_CASE("10 MB without a line end: one line too long, no more memory than before") {
    Ready ready;
    const string megabyte(1 << 20, 'x');
    for (int i = 0; i < 10; ++i) {
        ready.driver.feed(megabyte);
    }
    CHECK(ready.driver.board().lines_too_long() == 1);
    ready.driver.feed("\r\n");
    CHECK(ready.driver.board().lines_too_long() == 1);
    ready.check_alive();
}

TEST_CASE("a line of exactly the longest length is taken, one byte more is not") {
    Ready ready;
    const string head = "N-0 M2140 S5";
    const string tail = "*127";
    for (const std::size_t length : {protocol::max_line_bytes, protocol::max_line_bytes + 1}) {
        // An even number of blanks leaves the XOR as it is.
        string line = head + string(length - head.size() - tail.size(), ' ');
        line += "*" + std::to_string(protocol::xor_checksum(line));
        line = line.substr(0, length);
        const bool fits = line.size() <= protocol::max_line_bytes;
        line.resize(length, ' ');
        CHECK(ready.answer(line + "\r\n") == (fits && length == protocol::max_line_bytes ? good : ""));
    }
    CHECK(ready.driver.board().lines_too_long() == 1);
    ready.check_alive();
}

TEST_CASE("three requests in one write, one request in thirty writes") {
    Ready ready;
    CHECK(ready.answer(protocol::frame("M2140 S5") + protocol::frame("M2140 S6") +
                       protocol::frame("M2120 P5")) == "L24 P5 A0.00\nL24 P6 A0.00 B0.00\nL11 P0 S-2.67\n");
    const string frame = protocol::frame("M2139 P2 W1234 E0000000016");
    ready.driver.run_to_quiet();
    const double from = ready.driver.now();
    REQUIRE(frame.size() >= 30);
    for (const char byte : frame) {
        ready.driver.feed(string(1, byte));
        ready.driver.run_for(0.004);
    }
    ready.driver.run_for(0.2);
    CHECK(join(ready.driver.bodies(from)) == "L23 SE:0 BE:1 BP:50 CE:0 HE:0 SP:1234 ST:16 HC:0 HO:0\n");
    ready.check_alive();
}

TEST_CASE("bytes beyond ASCII are bytes like others") {
    Ready ready;
    CHECK(ready.answer("\xff\xfe\x80 \xc3\xa4\r\n").empty());
    CHECK(ready.answer(protocol::frame("M117 \xc3\xa4")).empty());  // the screen does not send M117
    CHECK(ready.answer(protocol::frame("M23 \xff\xff.gco")) == "L18 P26 S3\n");
    CHECK(ready.answer(protocol::frame("M2134 FW:\xff\x01\x7f")).starts_with("L9 "));
    ready.check_alive();
}

TEST_CASE("unknown codes and words: unanswered, counted, each told once") {
    Ready ready;
    for (int i = 0; i < 3; ++i) {
        for (const char* body :
             {"M9999", "G1234", "T7", "T99", "L3 PS:1", "X", "strXPT2046_TouchPara:1!", "x:3,y:4;", "M", "G",
              "M-5", "M 5", "m105", "M65535", "M65536", "M4294967297 S1"}) {
            CAPTURE(body);
            CHECK(ready.answer(protocol::frame(body)).empty());
        }
    }
    CHECK(ready.counters().bad_frames == 0);
    CHECK(ready.counters().unknown_codes >= 3 * 14);
    const auto& notices = ready.driver.notices();
    CHECK(std::count_if(notices.begin(), notices.end(),
                        [](const string& text) { return text.starts_with("M9999 "); }) == 1);
    ready.check_alive();
}

TEST_CASE("a thousand different unknown codes do not grow what the board remembers of them") {
    Ready ready;
    for (int i = 0; i < 1000; ++i) {
        ready.driver.feed(protocol::frame("M" + std::to_string(3000 + i)));
        ready.driver.run_for(0.06);
    }
    CHECK(ready.counters().unknown_codes == 1000);
    CHECK(ready.driver.notices().size() <= 300);
    ready.check_alive();
}

TEST_CASE("10 000 requests at once: the queue is bounded, what is lost is counted, order is kept") {
    Ready ready;
    string flood;
    for (int i = 0; i < 10000; ++i) {
        flood += protocol::frame("M2139 P2 W" + std::to_string(i));
    }
    const double from = ready.driver.now();
    ready.driver.feed(flood);
    const unsigned room = ready.driver.board().profile().line.queue_lines;
    CHECK(ready.counters().requests_lost == 10000 - room);
    const auto& received = ready.driver.received();
    CHECK(std::count_if(received.begin(), received.end(), [](const BoardDriver::Received& r) {
              return r.verdict == board::Verdict::queue_full;
          }) == 10000 - static_cast<long>(room));
    ready.driver.run_for(10);
    const auto replies = ready.driver.matching("L23", from);
    REQUIRE(replies.size() == room);
    for (std::size_t i = 0; i < replies.size(); ++i) {
        CHECK(replies[i].body.find(" SP:" + std::to_string(i) + " ") != string::npos);
    }
    ready.check_alive();
}

TEST_CASE("a flood of requests with long answers loses answers, not the board") {
    Ready ready;
    for (int i = 0; i < 100; ++i) {
        ready.driver.feed(protocol::frame("M2107 S1") + protocol::frame("M20 LCD") + protocol::frame("M115"));
        ready.driver.run_for(0.01);
    }
    ready.driver.run_for(20);
    CHECK(ready.driver.board().output().empty());
    CHECK(ready.driver.ask("M115").size() >= 1);
}

TEST_CASE("without pacing a flood that nobody reads stops at a bound, and goes on when it is read") {
    BoardDriver::Setup setup;
    setup.pacing = false;
    BoardDriver driver("geeetech-a30t", setup);
    board::Board& board = driver.board();
    board.clear_output();
    string flood;
    for (int i = 0; i < 1000; ++i) {
        flood += protocol::frame("M115");
    }
    for (int i = 0; i < 100; ++i) {
        board.receive(machine::from_seconds(1), flood);
    }
    CHECK(board.output().size() < 64 * 1024);
    CHECK(board.counters().requests_lost > 90000);
    driver.run_until(5);
    CHECK(driver.ask("M2140 S5", 0.01).size() >= 1);
}

TEST_CASE("a board that nobody advanced for a day works off what is overdue, without end or growth") {
    BoardDriver driver;
    board::Board& board = driver.board();
    board.receive(machine::from_seconds(86400), protocol::frame("M2140 S5"));
    CHECK(board.output().size() < 64 * 1024);
    driver.run_until(86410);
    CHECK(driver.lines().size() < 1000);
    CHECK(driver.ask("M2140 S6", 0.2).back() == "L24 P6 A0.00 B0.00");
}
