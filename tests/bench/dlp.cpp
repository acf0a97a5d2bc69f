// The MKS DLP board: what a layer costs, from its packed bytes to the panel's bank.

#include <array>
#include <chrono>
#include <cstring>
#include <vector>

#include "emulator/dlp/line_reader.h"
#include "emulator/dlp/uv_panel.h"
#include "tests/bench/figure.h"
#include "tests/support/dlp_bench.h"
#include "tests/support/resin_file.h"

namespace fauxboard::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double limit = 3;

/// The checksum of the packets with one table, as the board's program makes it.
std::uint16_t table_crc(const std::uint8_t* bytes, std::size_t size) {
    static const auto table = [] {
        std::array<std::uint16_t, 256> rows{};
        for (unsigned byte = 0; byte < rows.size(); ++byte) {
            unsigned crc = byte << 8;
            for (int bit = 0; bit < 8; ++bit) {
                crc = (crc & 0x8000) != 0 ? crc << 1 ^ 0x1021 : crc << 1;
            }
            rows[byte] = static_cast<std::uint16_t>(crc);
        }
        return rows;
    }();
    unsigned crc = 0;
    for (std::size_t i = 0; i < size; ++i) {
        crc = (crc << 8 & 0xFFFF) ^ table[(crc >> 8 ^ bytes[i]) & 0xFF];
    }
    return static_cast<std::uint16_t>(crc);
}

/// Milliseconds of one call, the median of some.
template <class F>
double time_ms(int rounds, F work) {
    std::vector<double> all;
    for (int round = 0; round < rounds; ++round) {
        const auto begin = Clock::now();
        work();
        all.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    }
    return median(all);
}

/// Copying the bytes of a whole picture, a line at a time, and the checksum of each.
double floor_ms(int rounds) {
    const std::vector<std::uint8_t> from(dlp::bank_bytes, 0x5A);
    std::vector<std::uint8_t> to(dlp::bank_bytes);
    volatile std::uint16_t sum = 0;
    return time_ms(rounds, [&] {
        for (std::size_t at = 0; at < from.size(); at += dlp::line_bytes) {
            std::memcpy(&to[at], &from[at], dlp::line_bytes);
            sum = table_crc(&to[at], dlp::line_bytes);
        }
    });
}

std::vector<Figure> layer(const Settings& settings) {
    const int rounds = settings.smoke ? 1 : 200;
    testing::PanelPws wishes;
    wishes.layers = 1;
    const std::string bytes = testing::make_panel_pws(wishes);
    const testing::MemorySource source(bytes);
    const auto file = sliced::SlicedFile::open(source);
    const auto record = file->layer(source, 0);
    dlp::UvPanel panel(1, 2);
    const double measured = time_ms(rounds, [&] {
        dlp::LineReader lines(sliced::PictureRuns::of_layer(*file, source, 0, *record));
        panel.begin_picture(0);
        dlp::PanelLine line{};
        dlp::Packet packet{};
        for (unsigned n = 0; n < dlp::panel_lines; ++n) {
            lines.next(line);
            std::copy(line.begin(), line.end(), packet.begin() + 2);
            panel.send_line(packet, n, dlp::SimTime{0});
        }
        panel.end_picture(dlp::SimTime{0});
    });
    return {{"MKS DLP board, a layer decoded and sent", "ms", measured, floor_ms(rounds), limit}};
}

}  // namespace

std::vector<Benchmark> dlp_benchmarks() {
    return {{"dlp-layer", "a layer of the MKS DLP board against copying and checksumming its bytes", layer}};
}

}  // namespace fauxboard::bench
