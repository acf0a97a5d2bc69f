// tools/fauxboard.lua: its table, and what Wireshark makes of our captures with it.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "emulator/dlp/panel_line.h"
#include "emulator/dlp/spi_frames.h"
#include "emulator/record/pcapng.h"
#include "emulator/record/recording.h"
#include "protocol/annotate.h"
#include "tests/tools/dissector_table.h"
#include "tests/tools/program.h"

namespace fauxboard::test {
namespace {

using protocol::Direction;

const std::string script = FAUXBOARD_SOURCE_DIR "/tools/fauxboard.lua";

std::string read(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST_CASE("the dissector's table is that of the catalogue") {
    const std::string text = read(script);
    const std::size_t from = text.find("\nlocal codes = {") + 1;
    const std::size_t to = text.find("-- END CODES");
    REQUIRE(from != 0);
    REQUIRE(to != std::string::npos);
    if (text.substr(from, to - from) != dissector_table() && std::getenv("FAUXBOARD_UPDATE") != nullptr) {
        std::ofstream out(script, std::ios::binary);
        out << text.substr(0, from) << dissector_table() << text.substr(to);
        MESSAGE("tools/fauxboard.lua has been brought up to date");
        return;
    }
    CHECK_MESSAGE(text.substr(from, to - from) == dissector_table(),
                  "run FAUXBOARD_UPDATE=1 test_tools to bring tools/fauxboard.lua up to date");
}

/// A capture of these lines, board and screen in turn as the pairs say.
struct Spoken {
    Direction direction;
    std::string bytes;  ///< with the line's end
};

/// What tshark prints, field by field ('|' between them), a line each packet; nothing without tshark.
std::vector<std::string> tshark(const std::vector<Spoken>& talk, const std::string& fields,
                                bool with_script) {
    TemporaryFolder folder;
    const std::string file = folder.file("capture.pcapng");
    {
        record::PcapngWriter capture(file, machine::SimTime{1'700'000'000'000'000}, {});
        machine::SimTime t{0};
        for (const Spoken& spoken : talk) {
            t += machine::SimTime{1'234};
            capture.packet(t, spoken.direction, spoken.bytes);
        }
    }
    const Outcome outcome = run_shell(fmt::format(
        "tshark {} -r {} -T fields -E separator='|' -E occurrence=a {} 2>{}",
        with_script ? "-X lua_script:" + script : std::string(), file, fields, folder.file("err")));
    CHECK(read(folder.file("err")).find("Lua") == std::string::npos);
    REQUIRE(outcome.code == 0);
    return lines_of(outcome.out);
}

bool tshark_is_here() {
    static const bool here = run_shell("tshark --version >/dev/null 2>&1").code == 0;
    if (!here) {
        MESSAGE("skipped: no tshark on this computer");
    }
    return here;
}

TEST_CASE("tshark opens a capture without the dissector: serial line, direction, time, bytes") {
    if (!tshark_is_here()) {
        return;
    }
    const auto rows =
        tshark({{Direction::to_screen, "N-0 L21 P0 S0*63\r\n"}, {Direction::to_board, "M27\r\n"}},
               "-e frame.protocols -e frame.interface_name -e frame.time_epoch "
               "-e frame.packet_flags_direction -e data.data",
               false);
    REQUIRE(rows.size() == 2);
    CHECK(rows[0] ==
          "rtacser:data|board|1700000000.001234000|0x00000002|4e2d30204c3231205030205330"
          "2a36330d0a");
    CHECK(rows[1] == "rtacser:data|other end|1700000000.002468000|0x00000001|4d32370d0a");
}

TEST_CASE("the dissector names code and fields") {
    if (!tshark_is_here()) {
        return;
    }
    const auto rows = tshark(
        {{Direction::to_screen, "N-0 L2 B:22.0 /0.0 /0 T0:200.5 /210.0 /1 SD:1 F0:0 F2:50 R:100 FR:0*64\r\n"},
         {Direction::to_board, "N-0 M104 S200*74\r\n"},
         {Direction::to_screen, "N-0 L24 P5 A0.30*0\r\n"},
         {Direction::to_board, std::string("\0log Geeetech LCD OK\r\n", 22)},
         {Direction::to_screen, "N-0 L99 X1*\r\n"}},
        "-e fauxboard.direction -e fauxboard.code -e fauxboard.title -e fauxboard.checksum.status "
        "-e fauxboard.board.l2.t0 -e fauxboard.screen.m104.s -e fauxboard.words",
        true);
    REQUIRE(rows.size() == 5);
    CHECK(
        rows[0].starts_with("board → screen|L2|temperatures|wrong|200.5||temperatures: bed: 22.0 °C, target: "
                            "0.0 °C, "));
    CHECK(rows[1] == "screen → board|M104|nozzle|right||200|nozzle: target: 200 °C");
    CHECK(rows[2].starts_with("board → screen|L24|"));
    CHECK(rows[2].find("0.30 mm") != std::string::npos);
    CHECK(rows[3].starts_with("screen → board|log|"));
    CHECK(rows[4].starts_with("board → screen|L99||missing|||unknown \"L99 X1\""));
}

TEST_CASE("towards a host it says so, and what boards answer hosts has fields to plot") {
    if (!tshark_is_here()) {
        return;
    }
    const auto said = [](Direction direction, const std::string& line, const std::string& fields) {
        return tshark({{direction, line + "\n"}},
                      "-e _ws.col.Source -e _ws.col.Destination -e fauxboard.direction " + fields, true)
            .at(0);
    };
    // By the keys on the wire, and by the names that they are shown with.
    CHECK(said(Direction::to_screen, "ok T:22.50 /200.00 B:23.00 /60.00 @:127 B@:0",
               "-e fauxboard.board.ok_t.nozzle -e fauxboard.board.ok_t.nozzle_target -e "
               "fauxboard.board.ok_t.b -e fauxboard.board.ok_t.bed -e fauxboard.board.ok_t.bed_target -e "
               "fauxboard.board.ok_t.nozzle_power") == "board|host|board → host|22.5|200|23|23|60|127");
    CHECK(said(Direction::to_screen, " T:150.12 /200.00 B:22.00 /0.00 @:127 B@:0 W:?",
               "-e fauxboard.board.t.nozzle -e fauxboard.board.t.w") == "board|host|board → host|150.12|?");
    CHECK(said(Direction::to_screen, "ok B:20/0 E1:21/0 X:0.000 Y:0.000 Z:14.500 F:0/0 D:3860/241025/0 T:100",
               "-e fauxboard.board.ok_b.bed -e fauxboard.board.ok_b.z -e fauxboard.board.ok_b.d -e "
               "fauxboard.board.ok_b.at -e fauxboard.board.ok_b.of -e fauxboard.board.ok_b.halted -e "
               "fauxboard.board.ok_b.print_time") ==
          "board|host|board → host|20|14.5|3860|3860|241025|0|100");
    CHECK(said(Direction::to_screen, "SD printing byte 120/4500",
               "-e fauxboard.board.sd_printing_byte.at -e fauxboard.board.sd_printing_byte.of") ==
          "board|host|board → host|120|4500");
    CHECK(said(Direction::to_screen, "ok C: X:1.000000 Y:0.000000 Z:14.500000 E:0.000000",
               "-e fauxboard.board.ok_c.z") == "board|host|board → host|14.5");
    CHECK(said(Direction::to_board, "N7 M104 S200*101",
               "-e fauxboard.host.m104.s -e fauxboard.host.m104.target") ==
          "host|board|host → board|200|200");
    // As mariner moves the platform.
    CHECK(said(Direction::to_board, "G0 Z10 F300 I0",
               "-e fauxboard.host.g0.z -e fauxboard.host.g0.i -e fauxboard.unknown") ==
          "host|board|host → board|10|0|");
}

/// The names that the dissector should find: what the program itself finds.
std::string expected_names(const Spoken& spoken) {
    const auto line = protocol::decode_line(spoken.bytes, spoken.direction);
    std::string text = line.code != nullptr ? std::string(line.code->title) : "unknown";
    for (const protocol::DecodedField& field : line.fields) {
        text += ", " + (field.info == nullptr ? "unknown" : std::string(field.info->name));
    }
    return text;
}

/// The names in the dissector's words: "title: name: value, name: value".
bool names_are_in(const std::string& words, const Spoken& spoken) {
    const auto line = protocol::decode_line(spoken.bytes, spoken.direction);
    std::size_t at = 0;
    const auto follows = [&](std::string_view part) {
        at = words.find(part, at);
        return at != std::string::npos;
    };
    if (!follows(line.code != nullptr ? line.code->title : "unknown")) {
        return false;
    }
    for (const protocol::DecodedField& field : line.fields) {
        if (line.code != nullptr && !follows(field.info == nullptr ? "unknown" : field.info->name)) {
            return false;
        }
    }
    return true;
}

TEST_CASE("the dissector finds the fields that decode finds, in a recording of a real line") {
    const std::string capture = FAUXBOARD_SOURCE_DIR "/../shared/captures/a30t-boot-heat-load-home.jsonl";
    if (!std::filesystem::exists(capture)) {
        MESSAGE("skipped: no captures here");
        return;
    }
    if (!tshark_is_here()) {
        return;
    }
    std::vector<Spoken> talk;
    for (const record::RecordedLine& line : record::load_recording(capture)) {
        if (line.from == record::RecordedLine::From::board ||
            line.from == record::RecordedLine::From::screen) {
            talk.push_back(
                {line.from == record::RecordedLine::From::board ? Direction::to_screen : Direction::to_board,
                 line.bytes});
        }
    }
    const auto rows = tshark(talk, "-e fauxboard.checksum.status -e fauxboard.words", true);
    REQUIRE(rows.size() == talk.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        CAPTURE(talk[i].bytes);
        CAPTURE(rows[i]);
        CAPTURE(expected_names(talk[i]));
        CHECK(names_are_in(rows[i], talk[i]));
        CHECK_FALSE(rows[i].starts_with("wrong"));
    }
}

TEST_CASE("the dissector names packets and commands on the wires to a UV panel as decode does") {
    if (!tshark_is_here()) {
        return;
    }
    using dlp::ChipSelect;
    using dlp::SpiKind;
    dlp::PanelLine lit{};
    dlp::light(lit, 700, 800);
    const dlp::Packet packet = dlp::make_packet(lit, 1, 1280);
    const std::string good(packet.begin(), packet.end());
    std::string damaged = good;
    damaged[100] ^= 1;
    std::vector<dlp::SpiRecord> records;
    const auto add = [&](SpiKind kind, ChipSelect chip, bool level, std::string data) {
        records.push_back({kind, chip, level, 7, dlp::ms(300), std::move(data)});
    };
    add(SpiKind::out, ChipSelect::fpga, false, good);
    add(SpiKind::out, ChipSelect::fpga, false, damaged);
    add(SpiKind::pin, ChipSelect::fpga, false, {});
    for (const char byte : {'\xC0', '\x20', '\x80'}) {
        add(SpiKind::out, ChipSelect::fpga, false, {0, 0, byte});
    }
    add(SpiKind::out, ChipSelect::fpga, false, "\x80\xFF\xFF");
    add(SpiKind::in, ChipSelect::fpga, false, {0, 0, '\xD2'});
    add(SpiKind::out, ChipSelect::fpga, false, "what?");
    add(SpiKind::reset, ChipSelect::fpga, false, {});
    add(SpiKind::reset, ChipSelect::fpga, true, {});
    add(SpiKind::out, ChipSelect::left, false, {'\xB7', 0x0B, 3, 0});
    add(SpiKind::out, ChipSelect::right, false, {0x33, 0, 0, 0});
    add(SpiKind::in, ChipSelect::left, false, {0, 0, 0x28, 0x28});
    TemporaryFolder folder;
    {
        record::PcapngWriter capture(folder.file("capture.pcapng"), machine::SimTime{0}, {},
                                     record::pcapng_user_head("spi", "wires"));
        for (const dlp::SpiRecord& record : records) {
            capture.block(record::pcapng_user_packet(record.at, true, dlp::spi_bytes(record)));
        }
    }
    const Outcome outcome = run_shell(
        fmt::format("tshark -X lua_script:{} -r {} -T fields -E separator='|' -e fauxboard_spi.what -e "
                    "fauxboard_spi.words -e fauxboard_spi.wrong 2>{}",
                    script, folder.file("capture.pcapng"), folder.file("err")));
    REQUIRE(outcome.code == 0);
    const auto rows = lines_of(outcome.out);
    REQUIRE(rows.size() == records.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const dlp::SpiWords words = dlp::words_of(records[i]);
        CHECK(rows[i] == fmt::format("{}|{}|{}", words.what, words.words, words.wrong ? 1 : 0));
    }
}

}  // namespace
}  // namespace fauxboard::test
