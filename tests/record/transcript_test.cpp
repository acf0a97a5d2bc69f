#include "emulator/record/transcript.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace fauxboard::record {
namespace {

using machine::SimTime;
using protocol::Direction;
using Form = TranscriptEntry::Form;
using From = RecordedLine::From;

std::vector<TranscriptEntry> read(const std::string& text) {
    std::istringstream in(text);
    TranscriptReader reader(in, "x");
    std::vector<TranscriptEntry> entries;
    while (auto entry = reader.next()) {
        entries.push_back(std::move(*entry));
    }
    return entries;
}

std::vector<TranscriptEntry> merge(const std::vector<std::string>& texts) {
    std::vector<std::istringstream> streams;
    std::vector<TranscriptReader> readers;
    streams.reserve(texts.size());
    for (const std::string& text : texts) {
        readers.emplace_back(streams.emplace_back(text), "file" + std::to_string(readers.size() + 1));
    }
    Transcripts transcripts(std::move(readers));
    std::vector<TranscriptEntry> entries;
    while (auto entry = transcripts.next()) {
        entries.push_back(std::move(*entry));
    }
    return entries;
}

std::string all_bytes(const std::vector<TranscriptEntry>& entries) {
    std::string text;
    for (const TranscriptEntry& entry : entries) {
        text += (entry.form == Form::bad ? "BAD" : entry.bytes) + "|";
    }
    return text;
}

TEST_CASE("JSON lines: time, who and bytes as they stand there") {
    const auto entries = read(R"({"t": 16.451778, "from": "screen", "line": "N-0 M2134 FW:V\u00ff*84"}
 {"t": 17, "from": "world", "do": "filament in", "more": 1}
)");
    REQUIRE(entries.size() == 2);
    CHECK(entries[0].form == Form::json);
    CHECK(entries[0].t == SimTime{16'451'778});
    CHECK(entries[0].from == From::screen);
    CHECK_FALSE(entries[0].guessed);
    CHECK(entries[0].bytes == "N-0 M2134 FW:V\xFF*84");
    CHECK(entries[0].number == 1);
    CHECK(entries[1].from == From::world);
    CHECK(entries[1].bytes == "filament in");
}

TEST_CASE("a broken JSON line is one bad entry, with what was found and expected") {
    const auto entries = read(
        "{\"t\": 1, \"from\": \"board\", \"line\": \"a\"}\n{\"t\": 1\n{\"t\": 1, \"from\": \"x\", \"line\": "
        "\"\"}\n"
        "not JSON\n{\"t\": 2, \"from\": \"board\", \"line\": \"b\"}");
    CHECK(all_bytes(entries) == "a|BAD|BAD|BAD|b|");
    CHECK(entries[1].problem == "not JSON; expected one JSON object a line");
    CHECK(entries[2].problem ==
          "from: found \"x\"; expected board, screen, host, world, usb, network, "
          "module or fault");
    CHECK(entries[3].problem == "no JSON object, in a recording of JSON lines");
    CHECK(entries[3].number == 4);
    CHECK(entries[3].bytes == "not JSON");
}

TEST_CASE("time of day and line, as a shell loop records it") {
    const auto entries = read(
        "15:15:12.123456789 - N-0 M27*59\r\n15:15:13 - N-0 M105*10\n15:15:14.5 - N-0 x y*0\n15:15:15.1 -\n");
    REQUIRE(entries.size() == 3);
    CHECK(entries[0].form == Form::clock);
    CHECK(entries[0].t == SimTime{((15 * 60 + 15) * 60 + 12) * 1'000'000LL + 123'456});
    CHECK(entries[0].clock == "15:15:12.123456");
    CHECK(entries[0].bytes == "N-0 M27*59");
    CHECK(entries[0].from == From::screen);
    CHECK(entries[0].guessed);
    CHECK(entries[1].clock == "15:15:13");
    CHECK(entries[2].clock == "15:15:14.5");
    CHECK(*entries[2].t - *entries[1].t == SimTime{1'500'000});
    // A file holds one direction: what nobody knows goes with the rest.
    CHECK(entries[2].from == From::screen);
}

TEST_CASE("what is nearly a time of day is none") {
    for (const char* line :
         {"24:00:00 - M27", "12:60:00 - M27", "12:00:61 - M27", "1:00:00 - M27", "12:00:00. - M27",
          "12:00:00.1234567890 - M27", "12:00:00.1- M27", "12:00:00 -M27", "12:00:00"}) {
        CAPTURE(line);
        CHECK(read(line).at(0).form == Form::bad);
    }
    CHECK(read("+1:00:00 - M27").at(0).form == Form::raw);
    CHECK(read("12:00").at(0).form == Form::raw);
}

TEST_CASE("OctoPrint's serial.log: who, when and what; its own words are notes") {
    const auto entries = read(
        "2024-01-02 23:59:59,900 - Changing monitor state from \"Offline\" to \"Connecting\"\n"
        "2024-01-02 23:59:59,950 - Send: N0 M110 N0*125\n"
        "2024-01-03 00:00:00,100 - Recv: ok T:92.1 /0.0\n"
        "2024-01-03 00:00:00,050 - Recv: \n"
        "Traceback (most recent call last):\n"
        "2024-01-03 00:00:00,050 - Recv: wait\n");
    REQUIRE(entries.size() == 5);
    CHECK(entries[0].note);
    CHECK(entries[0].bytes == "Changing monitor state from \"Offline\" to \"Connecting\"");
    CHECK(entries[1].from == From::host);
    CHECK(entries[1].bytes == "N0 M110 N0*125");
    CHECK(entries[1].clock == "2024-01-02 23:59:59,950");
    CHECK_FALSE(entries[1].guessed);
    CHECK(entries[2].from == From::usb);
    CHECK(*entries[2].t - *entries[1].t == SimTime{150'000});
    CHECK(entries[3].note);
    CHECK(entries[3].form == Form::raw);
    CHECK(entries[4].t == entries[2].t);  // the computer's clock was set back
}

TEST_CASE("logs without times: OctoPrint's terminal, Printrun's printcore") {
    const auto terminal = read("Send: M105\nRecv: ok T:20.0 /0.0\nRecv:\nConnected\n");
    REQUIRE(terminal.size() == 3);
    CHECK(terminal[0].from == From::host);
    CHECK(terminal[0].bytes == "M105");
    CHECK_FALSE(terminal[0].t.has_value());
    CHECK(terminal[1].from == From::usb);
    CHECK(terminal[2].note);
    const auto printcore = read("INFO:root:SENT: N-1 M110*15\n[INFO] RECV: ok\nSENT: M27\n");
    CHECK(all_bytes(printcore) == "N-1 M110*15|ok|M27|");
    CHECK(printcore[1].from == From::usb);
}

TEST_CASE("logs of two days come in their order; a date that is none is no log") {
    const auto entries = merge({"2024-01-03 08:00:00,000 - Send: M27\n2024-01-03 09:00:00,000 - Send: M105\n",
                                "2024-01-02 23:00:00,000 - Send: M20\n"});
    CHECK(all_bytes(entries) == "M20|M27|M105|");
    CHECK(entries[1].t == SimTime{9 * 3'600'000'000LL});
    for (const char* line :
         {"2024-02-30 10:00:00,100 - Send: M27", "2024-01-02 24:00:00,100 - Send: M27",
          "2024-01-02 10:00:00,100 Send: M27", "2024-01-02T10:00:00.1Z M27", "[10:00:00] >> M27",
          "Jan  2 10:00:00 host M27", "02.01.2024 10:00 M27", "1704189600.100 M27"}) {
        CAPTURE(line);
        const auto bad = read(line);
        CHECK(bad.at(0).form == Form::bad);
        CHECK(bad.at(0).problem.find("in a form that decode does not know") != std::string::npos);
    }
}

TEST_CASE("time goes on past midnight") {
    const auto entries = read("23:59:59.9 - M27\n00:00:00.1 - M27\n23:59:59.9 - M27\n00:00:00.1 - M27\n");
    REQUIRE(entries.size() == 4);
    CHECK(*entries[1].t - *entries[0].t == SimTime{200'000});
    CHECK(*entries[3].t - *entries[0].t == SimTime{86'400'200'000});
}

TEST_CASE("plain lines: whose they are is told by what they say") {
    const auto entries = read("N-0 L3 PS:0 VL:0*5\nM27\rlog A30 LCD OK\r\n\n  \nSD printing byte 0/0\n?");
    REQUIRE(entries.size() == 5);
    CHECK(entries[0].from == From::board);
    CHECK(entries[1].from == From::screen);
    CHECK(entries[2].from == From::screen);
    CHECK(entries[2].number == 3);
    CHECK(entries[3].from == From::board);
    CHECK(entries[4].number == 7);
    CHECK(entries[4].from == From::board);
}

TEST_CASE("who must have said a line, and when that is open") {
    CHECK(telling_direction("N-0 L21 P0 S0*63") == Direction::to_screen);
    CHECK(telling_direction("M27") == Direction::to_board);
    CHECK(telling_direction("N-0 L1 S0*1") == std::nullopt);  // the checksum is wrong
    CHECK(telling_direction("L1 S0") == Direction::to_board);
    CHECK(telling_direction("L1 X1.000 Y0.000") == Direction::to_screen);
    CHECK(telling_direction("L99") == std::nullopt);
    CHECK(telling_direction("") == std::nullopt);
    CHECK(likely_direction("N-0 M105 Q*1") == Direction::to_board);
    CHECK(likely_direction("?", Direction::to_board) == Direction::to_board);
    CHECK(likely_direction("?") == Direction::to_screen);
}

TEST_CASE("two files with times of day are one talk") {
    const auto entries = merge({"15:00:00.1 - N-0 M27*59\n15:00:00.3 - N-0 M105*10\ntorn\n",
                                "15:00:00.2 - N-0 L21 P0 S0*63\n15:00:00.4 - N-0 L21 P0 S0*63\n"});
    CHECK(all_bytes(entries) == "N-0 M27*59|N-0 L21 P0 S0*63|N-0 M105*10|BAD|N-0 L21 P0 S0*63|");
    CHECK(entries[0].t == SimTime{0});
    CHECK(entries[1].t == SimTime{100'000});
    CHECK(entries[1].file == "file2");
    CHECK(entries[4].t == SimTime{300'000});
}

TEST_CASE("... also when the second begins after midnight, and when a first line is torn") {
    const auto entries =
        merge({"/0 *12\n00:00:01 - N-0 L21 P0 S0*63\n", "23:59:59 - N-0 M27*59\n00:00:02 - N-0 M27*59\n"});
    CHECK(all_bytes(entries) == "/0 *12|N-0 M27*59|N-0 L21 P0 S0*63|N-0 M27*59|");
    CHECK(entries[1].t == SimTime{0});
    CHECK(entries[2].t == SimTime{2'000'000});
    CHECK(entries[3].t == SimTime{3'000'000});
}

TEST_CASE("files of other forms come one after the other") {
    const auto entries = merge({"M27\n", "15:00:00 - M105\n15:00:01 - M105\n",
                                "{\"t\": 0.5, \"from\": \"board\", \"line\": \"L3\"}"});
    CHECK(all_bytes(entries) == "M27|M105|M105|L3|");
    CHECK(entries[1].t == SimTime{0});
    CHECK(entries[2].t == SimTime{1'000'000});
    CHECK(entries[3].t == SimTime{500'000});
    CHECK(merge({}).empty());
    CHECK(merge({"", "\n"}).empty());
}

TEST_CASE("junk: NULs, bytes of all kinds, a line without end, deep JSON") {
    std::string junk;
    for (int i = 0; i < 1024; ++i) {
        junk += static_cast<char>(i * 7);
    }
    CHECK_FALSE(read(junk).empty());
    const auto nuls = read(std::string("\0\0M27\0\n", 7));
    REQUIRE(nuls.size() == 1);
    CHECK(nuls[0].bytes == std::string("\0\0M27\0", 6));
    const auto lines = read("M27\n" + std::string(10'000'000, 'x') + "\nM105\n");
    CHECK(all_bytes(lines) == "M27|BAD|M105|");
    CHECK(lines[1].problem == "a line of more than 64 KiB");
    CHECK(lines[1].bytes.size() < 200);
    CHECK(read("{\"t\":" + std::string(60'000, '[')).at(0).form == Form::bad);
    CHECK(read("{\"t\":" + std::string(30'000, '[') + std::string(30'000, ']') + "}").at(0).form ==
          Form::bad);
}

TEST_CASE("transcript: what has no line end in 16 MiB is no text, and is not read on") {
    std::istringstream in("M105\n" + std::string(40UL * 1024 * 1024, '\0'));
    TranscriptReader reader(in, "x");
    CHECK(reader.next()->bytes == "M105");
    const auto endless = reader.next();
    CHECK(endless->form == Form::bad);
    CHECK(endless->problem == "a line of more than 16 MiB; it and what is behind it is not read");
    CHECK_FALSE(reader.next());
    CHECK(in.bad());
    CHECK(in.rdbuf()->in_avail() > 20L * 1024 * 1024);
}

TEST_CASE("a recording of a real line, as JSON lines and as two files with times of day") {
    const std::string capture = FAUXBOARD_SOURCE_DIR "/../shared/captures/a30t-boot-heat-load-home.jsonl";
    if (!std::filesystem::exists(capture)) {
        MESSAGE("skipped: no captures here");
        return;
    }
    const std::vector<RecordedLine> recorded = load_recording(capture);
    std::string board;
    std::string screen;
    std::size_t lines = 0;
    for (const RecordedLine& line : recorded) {
        if (line.from == From::board || line.from == From::screen) {
            const auto us = line.t.count() + 86'300'000'000;  // past midnight on the way
            char stamp[32];
            std::snprintf(stamp, sizeof stamp, "%02d:%02d:%02d.%06d000 - ",
                          static_cast<int>(us / 3'600'000'000 % 24), static_cast<int>(us / 60'000'000 % 60),
                          static_cast<int>(us / 1'000'000 % 60), static_cast<int>(us % 1'000'000));
            (line.from == From::board ? board : screen) += stamp + line.bytes + "\n";
            ++lines;
        }
    }
    const auto entries = merge({screen, board});
    REQUIRE(entries.size() == lines);
    auto wanted = recorded.begin();
    for (const TranscriptEntry& entry : entries) {
        while (wanted->from != From::board && wanted->from != From::screen) {
            ++wanted;
        }
        CAPTURE(wanted->bytes);
        CHECK(entry.bytes == wanted->bytes);
        CHECK(entry.from == wanted->from);
        CHECK(entry.t == wanted->t - recorded.front().t);
        ++wanted;
    }
}

}  // namespace
}  // namespace fauxboard::record
