#include "emulator/host/tap_talk.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "emulator/host/recorder.h"
#include "emulator/host/tap_log.h"
#include "emulator/record/recording.h"
#include "tests/host/tap_files.h"

namespace fauxboard::host {
namespace {

using test::TemporaryFolder;

/// "1.234567 > L3 ..." from the board, "<" from the screen.
struct Talk final : LiveObserver {
    std::vector<std::string> told;

    void on_received(SimTime now, board::Channel, std::string_view line, board::Verdict) override {
        told.push_back(fmt::format("{} < {}", now.count(), line));
    }
    void on_sent(SimTime now, board::Channel, std::string_view line) override {
        told.push_back(fmt::format("{} > {}", now.count(), line));
    }
    void on_notice(SimTime, board::Level, std::string_view text) override { told.emplace_back(text); }
    void on_link(SimTime now, link::LinkState, std::string_view why) override {
        told.push_back(fmt::format("{} {}", now.count(), why));
    }
};

using Told = std::vector<std::string>;

std::vector<std::string> cut(std::string_view bytes, std::size_t step, TapCutter::LoneCr lone_cr) {
    std::vector<std::string> pieces;
    TapCutter cutter(lone_cr);
    const auto take = [&](std::string_view piece) { pieces.emplace_back(piece); };
    for (; !bytes.empty(); bytes.remove_prefix(std::min(step, bytes.size()))) {
        cutter.feed(bytes.substr(0, step), take);
    }
    cutter.flush(take);
    return pieces;
}

TEST_CASE("a stream is cut at its line ends, however it comes, and no byte is lost") {
    const std::string bytes = "a\r\nbb\rccc\n\n\r\r\n" + std::string(1, '\0') + "d";
    const Told expected{"a\r\n", "bb\r", "ccc\n", "\n", "\r", "\r\n", std::string(1, '\0') + "d"};
    for (std::size_t step = 1; step <= bytes.size(); ++step) {
        CHECK(cut(bytes, step, TapCutter::LoneCr::waits) == expected);
        std::string all;
        for (const std::string& piece : cut(bytes, step, TapCutter::LoneCr::ends)) {
            all += piece;
        }
        CHECK(all == bytes);
    }
}

TEST_CASE("a line without end comes in pieces, and the cutter does not grow") {
    const auto pieces = cut(std::string(3 * TapCutter::max_piece + 5, 'x'), 1000, TapCutter::LoneCr::ends);
    REQUIRE(pieces.size() == 4);
    CHECK(pieces[0].size() == TapCutter::max_piece);
    CHECK(pieces[3] == "xxxxx");
}

TEST_CASE("lines are told with the time of their end, by whom the board is") {
    Talk talk;
    TapTalk tap(talk, nullptr, TapSide::a);
    tap.on_passed(SimTime{1}, TapSide::a, "N-0 L21 P0");
    tap.on_passed(SimTime{2}, TapSide::b, "M27\r");
    tap.on_passed(SimTime{3}, TapSide::b, "\nM105\r\n");
    tap.on_passed(SimTime{4}, TapSide::a, " S0*63\r\n\r\nN-0");
    tap.on_link(SimTime{5}, TapSide::b, link::LinkState::waiting, "it is gone");
    CHECK(talk.told == Told{"2 < M27", "3 < M105", "4 > N-0 L21 P0 S0*63", "5 B: it is gone"});
    tap.finish();
    CHECK(talk.told.back() == "4 > N-0");
    CHECK(tap.lines(TapSide::a) == 2);
    CHECK(tap.lines(TapSide::b) == 2);
}

TEST_CASE("who the board is shows in the first line that tells it; what came before waits for that") {
    Talk talk;
    TapTalk tap(talk, nullptr, std::nullopt);
    SUBCASE("the board is A") {
        tap.on_passed(SimTime{1}, TapSide::a, "0 /0 *12\r\nT0:0.0\r\n");
        CHECK(talk.told.empty());
        tap.on_passed(SimTime{2}, TapSide::a, "N-0 L21 P0 S0*63\r\n");
        CHECK(talk.told == Told{"1 > 0 /0 *12", "1 > T0:0.0", "2 > N-0 L21 P0 S0*63"});
        CHECK(tap.board() == TapSide::a);
    }
    SUBCASE("a wrong checksum tells nothing") {
        tap.on_passed(SimTime{1}, TapSide::a, "N-0 L21 P0 S0*64\r\n");
        CHECK_FALSE(tap.board());
    }
    SUBCASE("a request of A's") {
        tap.on_passed(SimTime{1}, TapSide::a, "N-0 M105*10\r\n");
        CHECK(tap.board() == TapSide::b);
        CHECK(talk.told.size() == 1);
    }
    SUBCASE("nothing tells it for long: B is") {
        for (std::size_t i = 0; i <= TapTalk::undecided_limit; ++i) {
            tap.on_passed(SimTime{1}, TapSide::b, "?\r\n");
        }
        CHECK(talk.told.size() == TapTalk::undecided_limit + 1);
        CHECK(talk.told.back() == "1 > ?");
    }
    SUBCASE("nothing tells it to the end: B is") {
        tap.on_passed(SimTime{1}, TapSide::a, "?\r\n!");
        tap.finish();
        CHECK(talk.told == Told{"1 < ?", "1 < !"});
    }
}

TEST_CASE("the recording of a tap holds every line, NULs and all, and reads back") {
    const TemporaryFolder folder;
    const std::string file = folder.file("tap.jsonl");
    {
        Recorder recorder(file, {});
        Observers lines;
        lines.add(recorder);
        TapTalk tap(lines, nullptr, std::nullopt);
        tap.on_passed(SimTime{1'000'001}, TapSide::a, std::string_view("log A30 LCD OK\r\n\0", 17));
        tap.on_passed(SimTime{1'500'000}, TapSide::b, "N-0 L14 \xC4\xFF\"\\*1\r\n");
        tap.on_passed(SimTime{1'500'002}, TapSide::a, "M27\n");
        tap.finish();
    }
    const auto recorded = record::load_recording(file);
    REQUIRE(recorded.size() == 3);
    CHECK(recorded[0].t == SimTime{1'000'001});
    CHECK(recorded[0].from == record::RecordedLine::From::screen);
    CHECK(recorded[0].bytes == "log A30 LCD OK");
    CHECK(recorded[1].from == record::RecordedLine::From::board);
    CHECK(recorded[1].bytes == "N-0 L14 \xC4\xFF\"\\*1");
    CHECK(recorded[2].bytes == std::string("\0M27", 4));
    CHECK(recorded[2].t == SimTime{1'500'002});
}

TEST_CASE("a packet is a line with its end, or what came before a pause") {
    const TemporaryFolder folder;
    const std::string file = folder.file("tap.pcapng");
    Talk talk;
    record::PcapngWriter capture(file, SimTime{0}, {});
    TapTalk tap(talk, &capture, TapSide::b);
    CHECK(tap.due() == machine::never);
    tap.on_passed(SimTime{10}, TapSide::a, "M27\r");
    CHECK(tap.due() == SimTime{10} + TapTalk::packet_pause);
    tap.on_passed(SimTime{20}, TapSide::a, "\nM1");
    CHECK(capture.packets() == 1);
    tap.tick(SimTime{100'019});
    CHECK(capture.packets() == 1);
    tap.tick(SimTime{100'020});
    CHECK(capture.packets() == 2);
    CHECK(tap.due() == machine::never);
    tap.on_passed(SimTime{200'000}, TapSide::a, "05\r\nM2");
    CHECK(capture.packets() == 3);
    tap.finish();
    CHECK(capture.packets() == 4);
    const std::string bytes = test::read_file(file);
    const std::string expected =
        record::pcapng_head() + record::pcapng_packet(SimTime{20}, protocol::Direction::to_board, "M27\r\n") +
        record::pcapng_packet(SimTime{20}, protocol::Direction::to_board, "M1") +
        record::pcapng_packet(SimTime{200'000}, protocol::Direction::to_board, "05\r\n") +
        record::pcapng_packet(SimTime{200'000}, protocol::Direction::to_board, "M2");
    CHECK((bytes == expected));
    // The lines know nothing of pauses.
    CHECK(talk.told == Told{"10 < M27", "200000 < M105", "200000 < M2"});
}

TEST_CASE("the log of a tap: time, direction, bytes, and words where they are asked for") {
    const TemporaryFolder folder;
    const auto logged = [&](TapLog::Options options) {
        const std::string file = folder.file("log");
        const link::UniqueFd fd = test::open_new(file);
        TextOutput out(fd.get());
        TapLog log(out, options);
        log.on_sent(SimTime{1'000'001}, board::Channel::main, "N-0 L21 P0 S0*63");
        log.on_received(SimTime{12'345'678}, board::Channel::main, "M27\xFF", board::Verdict::accepted);
        log.on_link(SimTime{0}, link::LinkState::up, "A: here");
        log.on_notice(SimTime{0}, board::Level::warning, "disk full");
        return test::read_file(file);
    };
    CHECK(logged({true, false}) ==
          "     1.000001  board → screen  N-0 L21 P0 S0*63\n"
          "    12.345678  screen → board  M27\\xFF\n"
          "     0.000000  link            A: here\n"
          "     0.000000  warning         disk full\n");
    CHECK(logged({true, true}).find("N-0 L21 P0 S0*63                      ") != std::string::npos);
    CHECK(logged({false, false}) == "     0.000000  warning         disk full\n");
}

TEST_CASE("the log of a tap calls the other end a host until it is known for a screen") {
    const TemporaryFolder folder;
    const std::string file = folder.file("log");
    const link::UniqueFd fd = test::open_new(file);
    TextOutput out(fd.get());
    TapLog log(out, {true, false});
    log.on_received(SimTime{0}, board::Channel::main, "N1 M105*38", board::Verdict::accepted);
    log.on_sent(SimTime{0}, board::Channel::main, "ok T:22.00 /0.00 @:0");
    log.on_sent(SimTime{0}, board::Channel::main, "N-0 L21 P0 S0*63");
    log.on_received(SimTime{0}, board::Channel::main, "M27", board::Verdict::accepted);
    CHECK(test::read_file(file) ==
          "     0.000000  host → board    N1 M105*38\n"
          "     0.000000  board → host    ok T:22.00 /0.00 @:0\n"
          "     0.000000  board → screen  N-0 L21 P0 S0*63\n"
          "     0.000000  screen → board  M27\n");
}

}  // namespace
}  // namespace fauxboard::host
