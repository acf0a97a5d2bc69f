// The MKS DLP board: what a layer costs, from its packed bytes to the panel's bank; what a print does; its
// weight.

#include <stdlib.h>

#include <array>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/dlp/line_reader.h"
#include "emulator/dlp/printer.h"
#include "emulator/host/profile_files.h"
#include "emulator/host/screen_files.h"
#include "emulator/touch/touch_screen.h"
#include "tests/bench/allocations.h"
#include "tests/bench/child.h"
#include "tests/bench/figure.h"
#include "tests/support/dlp_bench.h"
#include "tests/support/resin_file.h"

namespace fauxboard::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double layer_limit = 3;
constexpr double weight_limit = dlp::bank_count * dlp::bank_bytes + 64.0 * 1024;
constexpr double folder_limit_s = 10;
constexpr double print_limit_s = 2;

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
    return {{"MKS DLP board, a layer decoded and sent", "ms", measured, floor_ms(rounds), layer_limit}};
}

/// What a board holds with its screen, all four banks of its panel filled, its profile aside.
std::vector<Figure> weight(const Settings&) {
    const auto profile = host::load_profile_by_name("mks-dlp");
    const auto own = host::load_own_screen(profile->screen);
    const std::int64_t before = allocations().live_bytes;
    touch::TouchScreen screen(own);
    board::Options options;
    options.front = &screen;
    board::Board board(profile, {}, options);
    board.power_on(dlp::SimTime{0});
    for (dlp::SimTime now{0}; now < dlp::ms(5000);) {
        now = std::max(now, std::min(board.advance(now), dlp::ms(5000)));
    }
    dlp::UvPanel& panel = machine::as<dlp::Printer>(board.machine())->board.panel;
    for (unsigned bank = 0; bank < dlp::bank_count; ++bank) {
        dlp::Packet packet{};
        panel.begin_picture(bank);
        panel.send_line(packet, 0, dlp::ms(5000));
        panel.end_picture(dlp::ms(5000));
    }
    return {{"MKS DLP board with its four banks", "bytes",
             static_cast<double>(allocations().live_bytes - before) + sizeof board + sizeof screen,
             std::nullopt, weight_limit}};
}

/// A stick with a print on it, and a scenario, in a folder that is gone with this.
class Workplace {
  public:
    Workplace(std::uint32_t layers, const std::string& steps) {
        std::string name = (std::filesystem::temp_directory_path() / "fauxboard-bench-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) {
            throw std::runtime_error("no folder for the stick");
        }
        folder_ = name;
        std::filesystem::create_directory(folder_ / "stick");
        testing::PanelPws wishes;
        wishes.layers = layers;
        std::ofstream(folder_ / "stick/model.pws", std::ios::binary) << testing::make_panel_pws(wishes);
        std::ofstream(folder_ / "print.json")
            << R"({"name": "print", "profile": "mks-dlp", "steps": [{"wait": {"page": "Main"}}, )" << steps
            << "]}";
    }
    ~Workplace() {
        std::error_code error;
        std::filesystem::remove_all(folder_, error);
    }
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;
    double run(const Settings& settings, std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments{"run", "--script", (folder_ / "print.json").string(), "--speed",
                                           "max", "--udisk",  (folder_ / "stick").string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return time_program(settings.program, arguments);
    }
    std::string path(const char* name) const { return (folder_ / name).string(); }

  private:
    std::filesystem::path folder_;
};

std::vector<Figure> panel_folder(const Settings& settings) {
    const Workplace place(settings.smoke ? 2 : 400, R"({"do": {"print.start": {"path": "model.pws"}}},
        {"wait": {"event": "print.finished"}, "within": "10h", "real": "5min"})");
    return {{"400 layers printed into --panel DIR", "s",
             place.run(settings, {"--panel", place.path("shown")}), std::nullopt, folder_limit_s}};
}

/// Files, view, print, a pause, the lock, the end.
std::vector<Figure> by_touches(const Settings& settings) {
    const Workplace place(settings.smoke ? 2 : 100, R"(
        {"touch": "Files"}, {"wait": {"page": "Files"}}, {"touch": "Tile 1"}, {"wait": {"page": "File view"}},
        {"touch": "Print"}, {"wait": {"shows": "printed model"}}, {"touch": "OK"}, {"wait": {"page": "Printing"}},
        {"wait": {"event": "print.exposing"}, "within": "5min"}, {"touch": "Pause"},
        {"wait": {"event": "print.pause_reached"}, "within": "5min"}, {"touch": "Header", "for": "2600ms"},
        {"wait": "3s"}, {"touch": "Header", "for": "2600ms"}, {"wait": "3s"}, {"touch": "Pause"},
        {"wait": {"event": "print.finished"}, "within": "2h", "real": "5min"},
        {"check": {"watch.broken": 0}}, {"touch": "OK"}, {"wait": {"page": "Files"}})");
    return {{"100 layers printed by touches, --speed max", "s", place.run(settings), std::nullopt,
             print_limit_s}};
}

}  // namespace

std::vector<Benchmark> dlp_benchmarks() {
    return {{"dlp-layer", "a layer of the MKS DLP board against copying and checksumming its bytes", layer},
            {"dlp-weight", "what the MKS DLP board holds in memory", weight},
            {"dlp-panel", "a print of the MKS DLP board with each picture kept", panel_folder},
            {"dlp-touches", "a print of the MKS DLP board by touches", by_touches}};
}

}  // namespace fauxboard::bench
