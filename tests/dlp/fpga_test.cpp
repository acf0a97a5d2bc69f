#include "emulator/dlp/fpga.h"

#include <doctest/doctest.h>

#include <string_view>

#include "emulator/dlp/crc16.h"

using namespace fauxboard::dlp;

namespace {

std::uint16_t crc_of(const Packet& packet) {
    return static_cast<std::uint16_t>(packet[packet_bytes - 2] << 8 | packet[packet_bytes - 1]);
}

Packet filled(unsigned bank, unsigned line, std::uint8_t byte) {
    PanelLine data;
    data.fill(byte);
    return make_packet(data, bank, line);
}

std::uint8_t read_back(Fpga& fpga) {
    const std::array<std::uint8_t, 3> out{0x80, 0xFF, 0xFF};
    std::array<std::uint8_t, 3> in{};
    fpga.transfer(out, in);
    return in[2];
}

void command(Fpga& fpga, std::uint8_t byte) {
    const std::array<std::uint8_t, 3> out{0, 0, byte};
    std::array<std::uint8_t, 3> in{};
    fpga.transfer(out, in);
}

/// As the standard has it, a bit at a time.
std::uint16_t slow_crc(std::span<const std::uint8_t> bytes) {
    unsigned crc = 0;
    for (const std::uint8_t byte : bytes) {
        crc ^= static_cast<unsigned>(byte) << 8;
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc & 0x8000) != 0 ? (crc << 1 ^ 0x1021) & 0xFFFF : crc << 1;
        }
    }
    return static_cast<std::uint16_t>(crc);
}

}  // namespace

TEST_CASE("panel: the checksum, whatever the length") {
    constexpr std::string_view digits = "123456789";
    std::vector<std::uint8_t> bytes(digits.begin(), digits.end());
    CHECK(crc16(bytes) == 0x31C3);
    bytes.clear();
    for (unsigned i = 0; i < 300; ++i) {
        CHECK(crc16(bytes) == slow_crc(bytes));
        bytes.push_back(static_cast<std::uint8_t>(i * 77 + i / 3));
    }
}

TEST_CASE("panel: packets of whole lines") {
    struct Row {
        unsigned bank, line;
        std::uint8_t byte;
        std::uint16_t crc;
    };
    for (const Row& row :
         {Row{0, 0, 0x00, 0x0872}, Row{0, 0, 0xFF, 0x9943}, Row{1, 0, 0x00, 0x827E}, Row{2, 0, 0x00, 0x0C4B},
          Row{0, 1, 0x00, 0xBB21}, Row{0, 255, 0x00, 0x252B}, Row{0, 256, 0x00, 0xCCCA},
          Row{0, 2559, 0x00, 0xA495}, Row{0, 2559, 0xFF, 0x35A4}, Row{3, 2559, 0x00, 0x2AA0}}) {
        CAPTURE(row.bank);
        CAPTURE(row.line);
        CHECK(crc_of(filled(row.bank, row.line, row.byte)) == row.crc);
    }
    CHECK(filled(0, 256, 0)[0] == 0x41);
    CHECK(filled(0, 256, 0)[1] == 0x00);
    CHECK(filled(0, 2559, 0)[0] == 0x49);
    CHECK(filled(0, 2559, 0)[1] == 0xFF);
    PanelLine all{};
    light(all, 0, panel_columns);
    CHECK(crc_of(make_packet(all, 0, 0)) == 0x88A8);
    CHECK(count_lit(all) == panel_columns);
}

TEST_CASE("panel: any stretch of a line lights these pixels and no dead one") {
    for (const auto& [begin, end] : {std::pair{0U, 1U},
                                     {7U, 8U},
                                     {7U, 9U},
                                     {0U, 8U},
                                     {3U, 5U},
                                     {719U, 721U},
                                     {700U, 740U},
                                     {720U, 721U},
                                     {719U, 720U},
                                     {1439U, 1440U},
                                     {1U, 1439U},
                                     {712U, 720U},
                                     {0U, 720U},
                                     {720U, 1440U},
                                     {5U, 5U}}) {
        PanelLine line{};
        light(line, begin, end);
        std::uint32_t bits = 0;
        for (const std::uint8_t byte : line) {
            bits += static_cast<std::uint32_t>(__builtin_popcount(byte));
        }
        CHECK(bits == end - begin);
        for (std::uint32_t column = 0; column < panel_columns; ++column) {
            CHECK(lit(line, column) == (column >= begin && column < end));
        }
    }
}

TEST_CASE("FPGA: commands are read back with the version, packets go to their bank") {
    Fpga fpga(1);
    command(fpga, command_of(1, true, true));
    CHECK(fpga.command() == 0xD0);
    CHECK(read_back(fpga) == 0xD2);
    command(fpga, command_of(2, false, false));
    CHECK(read_back(fpga) == 0x22);
    CHECK(fpga.crc_pin());
    fpga.packet(filled(1, 5, 0xFF));
    CHECK(fpga.line(1, 5)[0] == 0xFF);
    CHECK(fpga.line(0, 5)[0] == 0x00);
    CHECK(fpga.lit_pixels(1) == panel_columns);
    CHECK(fpga.lit_pixels(0) == 0);
    Packet damaged = filled(1, 5, 0x00);
    damaged[100] ^= 1;
    fpga.packet(damaged);
    CHECK_FALSE(fpga.crc_pin());
    CHECK(fpga.line(1, 5)[0] == 0xFF);
    CHECK(fpga.counters().crc_errors == 1);
    fpga.packet(filled(0, 2560, 0xFF));
    CHECK_FALSE(fpga.crc_pin());
    fpga.packet(filled(0, 0, 0xFF));
    CHECK(fpga.crc_pin());
    std::array<std::uint8_t, 4> nothing{};
    fpga.transfer(nothing, nothing);
    CHECK(fpga.counters().strange == 1);
}

TEST_CASE("FPGA: what a bank holds, as a sum over its packets") {
    Fpga fpga(1);
    const std::string dark = fpga.md5(0);
    CHECK(dark.size() == 32);
    fpga.packet(filled(3, 7, 0x00));
    CHECK(fpga.md5(3) == dark);
    fpga.packet(filled(3, 7, 0x01));
    CHECK(fpga.md5(3) != dark);
    fpga.packet(filled(3, 7, 0x00));
    CHECK(fpga.md5(3) == dark);
}

TEST_CASE("FPGA: a reset while a picture is read may leave the panel white, and a clean one mends it") {
    int white = 0;
    constexpr int tries = 7000;
    for (int seed = 1; seed <= tries; ++seed) {
        Fpga fpga(static_cast<std::uint64_t>(seed) * 7919);
        command(fpga, command_of(0, true, true));
        fpga.reset();
        white += fpga.white() ? 1 : 0;
    }
    CHECK(white > tries / 7 - 150);
    CHECK(white < tries / 7 + 150);
    Fpga fpga(1);
    fpga.trouble.unclean_reset = true;
    fpga.packet(filled(0, 0, 0xFF));
    command(fpga, command_of(0, true, true));
    fpga.reset();
    CHECK(fpga.white());
    fpga.packet(filled(0, 0, 0x00));
    CHECK(fpga.crc_pin());
    CHECK(fpga.line(0, 0)[0] == 0xFF);  // taken, and not stored
    command(fpga, command_of(2, false, false));
    fpga.reset();
    CHECK_FALSE(fpga.white());
}

TEST_CASE("FPGA: its troubles") {
    Fpga fpga(1);
    fpga.trouble.bad_line = 9;
    fpga.packet(filled(0, 9, 0xFF));
    CHECK_FALSE(fpga.crc_pin());
    fpga.packet(filled(0, 8, 0xFF));
    CHECK(fpga.crc_pin());
    fpga.trouble.stuck_pin = false;
    CHECK_FALSE(fpga.crc_pin());
    fpga.trouble.wrong_read_back = true;
    command(fpga, 0xC0);
    CHECK((read_back(fpga) & 0xF0) != 0xC0);
}
