// The wires to the UV panel: as records, in words, and with somebody else at their other end.

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "emulator/dlp/spi_frames.h"
#include "emulator/dlp/uv_panel.h"

namespace fauxboard::dlp::test {
namespace {

/// Keeps what passes, and answers as it is told.
struct Listening final : SpiTap {
    void transfer(SimTime now, ChipSelect chip, std::span<const std::uint8_t> out,
                  std::span<std::uint8_t> in) override {
        if (read_back && in.size() == 3 && out[0] == 0x80) in[2] = *read_back;
        if (right_id && chip == ChipSelect::right && out[0] == id_register) {
            in[2] = *right_id & 0xFF;
            in[3] = static_cast<std::uint8_t>(*right_id >> 8);
        }
        records.push_back({SpiKind::out, chip, false, 0, now, std::string(out.begin(), out.end())});
        if (std::any_of(in.begin(), in.end(), [](std::uint8_t byte) { return byte != 0; })) {
            records.push_back({SpiKind::in, chip, false, 0, now, std::string(in.begin(), in.end())});
        }
    }
    bool pin(SimTime, bool good) override { return says ? says(good) : good; }
    void reset(SimTime now, bool low) override {
        records.push_back({SpiKind::reset, ChipSelect::fpga, !low, 0, now, {}});
    }

    std::vector<std::string> words() const {
        std::vector<std::string> out;
        for (const SpiRecord& record : records) {
            const SpiWords words = words_of(record);
            out.push_back(words.what + ": " + words.words);
        }
        return out;
    }

    std::vector<SpiRecord> records;
    std::function<bool(bool)> says;
    std::optional<std::uint8_t> read_back;
    std::optional<std::uint16_t> right_id;
};

Packet line_of(std::uint8_t byte) {
    Packet packet{};
    std::fill(packet.begin() + 2, packet.end() - 2, byte);
    return packet;
}

bool same(const SpiRecord& a, const SpiRecord& b) {
    return a.kind == b.kind && a.chip == b.chip && a.level == b.level && a.number == b.number &&
           a.at == b.at && a.data == b.data;
}

TEST_CASE("SPI records: byte for byte as they are described, and back, in any pieces") {
    const SpiRecord command{SpiKind::out, ChipSelect::fpga, false, 7, SimTime{300'000}, {"\0\0\x20", 3}};
    CHECK(spi_bytes(command) == std::string("\xA5O\0\0\0\3\0\0\0\7\0\0\0\4\x93\xE0\0\0\x20", 19));
    const std::vector<SpiRecord> records{command,
                                         {SpiKind::in, ChipSelect::right, false, 0xFFFFFFFF,
                                          SimTime{0xFFFF'FFFF'FFFF}, std::string(1024, '\xA5')},
                                         {SpiKind::pin, ChipSelect::fpga, true, 1, SimTime{0}, {}},
                                         {SpiKind::reset, ChipSelect::left, false, 0, SimTime{1}, {}}};
    std::string stream;
    for (const SpiRecord& record : records)
        stream += spi_bytes(record);
    CHECK(looks_like_spi(stream));
    for (const std::size_t piece : {1U, 3U, 17U, 4096U}) {
        SpiSplitter splitter;
        std::size_t found = 0;
        for (std::size_t at = 0; at < stream.size(); at += piece) {
            splitter.feed(std::string_view(stream).substr(at, piece));
            while (const auto record = splitter.next()) {
                REQUIRE(found < records.size());
                CHECK(same(*record, records[found++]));
            }
        }
        CHECK(found == records.size());
        CHECK(splitter.skipped() == 0);
        CHECK(splitter.waiting() == 0);
    }
}

TEST_CASE("SPI records: what is none is left out, and the next one is found") {
    const std::string good = spi_bytes({SpiKind::pin, ChipSelect::fpga, true, 3, SimTime{0}, {}});
    for (const std::string& junk :
         {std::string("hello"), std::string("\xA5"), std::string("\xA5O\3"), good.substr(0, 9),
          std::string("\xA5O\0\0\xFF\xFF", 6), std::string("\xA5\xA5\xA5")}) {
        SpiSplitter splitter;
        splitter.feed(junk + good + good + good);
        std::size_t found = 0;
        while (const auto record = splitter.next()) {
            found += record->kind == SpiKind::pin && record->number == 3 ? 1U : 0U;
        }
        CHECK(found >= 2);  // half a record takes the beginning of the next for its rest
        CHECK(splitter.waiting() < spi_head_bytes + spi_most_data);
    }
    CHECK_FALSE(looks_like_spi("{\"t\": 16.451778, \"from\""));
}

TEST_CASE("SPI: the panel is set up in the board's order") {
    UvPanel panel(1, 2);
    Listening wires;
    panel.tap = &wires;
    REQUIRE(panel.set_up(true, ms(300)));
    const std::vector<std::string> wanted{"command: 20: bank 2, scan off, SDRAM off",
                                          "read back: which command?",
                                          "read back: 22: bank 2, scan off, SDRAM off, version 2",
                                          "reset: pulled low",
                                          "reset: released",
                                          "register: B0 = 0000: read the id",
                                          "register: id 2828",
                                          "register: B0 = 0000: read the id",
                                          "register: id 2828",
                                          "command: 80: bank 0, scan on, SDRAM off",
                                          "read back: which command?",
                                          "read back: 82: bank 0, scan on, SDRAM off, version 2",
                                          "register: 28 = 0000: display off",
                                          "register: 28 = 0000: display off",
                                          "register: 10 = 0000: sleep in",
                                          "register: 10 = 0000: sleep in",
                                          "register: B7 = 0004: configuration",
                                          "register: B7 = 0004: configuration",
                                          "command: 00: bank 0, scan off, SDRAM off",
                                          "read back: which command?",
                                          "read back: 02: bank 0, scan off, SDRAM off, version 2"};
    CHECK(wires.words() == wanted);
}

TEST_CASE("SPI: the ids of the controllers are what the wires bring") {
    UvPanel panel(1, 2);
    Listening wires;
    panel.tap = &wires;
    wires.right_id = 0x2829;
    CHECK_FALSE(panel.set_up(true, ms(300)));
    CHECK_FALSE(panel.powered());
    const auto words = wires.words();
    CHECK(std::count(words.begin(), words.end(), "register: id 2828") == 1);
    CHECK(std::count(words.begin(), words.end(), "register: id 2829") == 1);
    panel.id_missing = true;  // of the one made up here: whoever is at the other end has his own
    wires.right_id = 0x2828;
    CHECK_FALSE(panel.set_up(true, ms(300)));
    panel.id_missing = false;
    CHECK(panel.set_up(true, ms(300)));
    CHECK(panel.powered());
    panel.tap = nullptr;
    CHECK(panel.set_up(true, ms(300)));
    panel.id_missing = true;
    CHECK_FALSE(panel.set_up(true, ms(300)));
}

TEST_CASE("SPI: lines, retries and commands in words") {
    Packet good = line_of(0xFF);
    seal(good, 1, 1280);
    SpiRecord record{
        SpiKind::out, ChipSelect::fpga, false, 1, SimTime{0}, std::string(good.begin(), good.end())};
    CHECK(words_of(record).what == "line");
    CHECK(words_of(record).words.starts_with("bank 1, line 1280: 1440 lit, checksum "));
    CHECK(words_of(record).words.ends_with(" good"));
    CHECK_FALSE(words_of(record).wrong);
    Packet beyond = line_of(0xFF);
    seal(beyond, 1, panel_lines);
    record.data.assign(beyond.begin(), beyond.end());
    CHECK(words_of(record).words.ends_with(" good; there is no such line"));
    CHECK(words_of(record).wrong);
    record.data[100] = 0;
    CHECK(words_of(record).wrong);
    CHECK(words_of(record).words.find("would be right") != std::string::npos);
    for (const std::string& nonsense :
         {std::string(), std::string(195, '\x40'), std::string("\x81\xFF\xFF"), std::string("\1\0\0", 3)}) {
        record.data = nonsense;
        CHECK(words_of(record).what == "unknown");
        CHECK(words_of(record).wrong);
    }
}

TEST_CASE("SPI: somebody else's pin and command byte are what the board goes by") {
    UvPanel panel(1, 2);
    Listening wires;
    panel.tap = &wires;
    // Bad twice, then good: two more tries of the first line, and no more.
    int looks = 0;
    wires.says = [&](bool) { return ++looks > 2; };
    panel.begin_picture(0);
    for (unsigned line = 0; line < 3; ++line) {
        Packet packet = line_of(0x55);
        panel.send_line(packet, line, ms(1));
    }
    CHECK(panel.end_picture(ms(1)) == 0);
    CHECK(panel.counters().resends == 2);
    CHECK(wires.records.size() == 5);
    CHECK(wires.records[0].data == wires.records[1].data);

    // Bad for ever: five more tries, then the line is given up.
    wires.says = [](bool) { return false; };
    wires.records.clear();
    panel.begin_picture(0);
    Packet packet = line_of(0);
    panel.send_line(packet, 9, ms(2));
    CHECK(panel.end_picture(ms(2)) == 1);
    CHECK(wires.records.size() == 6);
    CHECK(panel.counters().fill_retries == 5);

    // A command that never reads back is written five times.
    wires.read_back = 0x02;
    wires.records.clear();
    panel.command(1, true, true, ms(3));
    CHECK(std::count_if(wires.records.begin(), wires.records.end(),
                        [](const SpiRecord& each) { return each.data == std::string("\0\0\xD0", 3); }) == 5);
    CHECK(panel.counters().failed_commands == 1);
    wires.read_back = 0xD7;
    panel.command(1, true, true, ms(4));
    CHECK(panel.counters().failed_commands == 1);
}

}  // namespace
}  // namespace fauxboard::dlp::test
