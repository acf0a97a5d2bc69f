#include "emulator/host/drawings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "emulator/control/base64.h"
#include "emulator/dlp/panel_line.h"
#include "emulator/dlp/printer.h"
#include "emulator/filament/printer.h"
#include "emulator/machine/disk_source.h"
#include "emulator/resin/printer.h"
#include "emulator/sliced/scanlines.h"

namespace fauxboard::host {
namespace {

using control::Json;

/// A picture made small: each pixel is the brightest of those it stands for, so that nothing thin gets lost.
struct Small {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> greys;

    std::string packed() const {
        std::string out((greys.size() + 3) / 4, '\0');
        for (std::size_t i = 0; i < greys.size(); ++i) {
            const unsigned four = (greys[i] + 42U) / 85U;
            out[i / 4] = static_cast<char>(static_cast<unsigned char>(out[i / 4]) | four << (i % 4 * 2));
        }
        return out;
    }
};

std::optional<Small> read_picture(const resin::ResinJob::Place& place) {
    const machine::DiskSource source(place.disk, place.path);
    auto lines = sliced::Scanlines::of_layer(place.file, source, place.layer);
    if (!lines || lines->width() == 0 || lines->height() == 0) {
        return std::nullopt;
    }
    const std::uint32_t by = std::max(lines->width(), lines->height()) / Drawings::most_side + 1;
    Small out{(lines->width() + by - 1) / by, (lines->height() + by - 1) / by, {}};
    out.greys.resize(std::size_t{out.width} * out.height);
    std::vector<std::uint32_t> row(lines->width());
    for (std::uint32_t y = 0; lines->next(row); ++y) {
        std::uint8_t* const line = &out.greys[std::size_t{y / by} * out.width];
        for (std::uint32_t x = 0; x < row.size(); ++x) {
            line[x / by] =
                std::max(line[x / by], static_cast<std::uint8_t>(std::min<std::uint32_t>(row[x], 255)));
        }
    }
    return out;
}

/// What can be seen on a UV panel.
Small read_panel(const dlp::UvPanel& panel) {
    constexpr std::uint32_t by = std::max(dlp::panel_columns, dlp::panel_lines) / Drawings::most_side + 1;
    Small out{(dlp::panel_columns + by - 1) / by, (dlp::panel_lines + by - 1) / by, {}};
    out.greys.resize(std::size_t{out.width} * out.height);
    const unsigned bank = dlp::bank_of(panel.fpga().command());
    std::array<unsigned char, dlp::panel_columns / 8> row{};
    for (std::uint32_t y = 0; y < dlp::panel_lines; ++y) {
        panel.white() ? row.fill(0xFF) : dlp::take_pixels(panel.fpga().line(bank, y), row);
        for (std::uint32_t x = 0; x < dlp::panel_columns; ++x) {
            if ((row[x / 8] & 0x80U >> x % 8) != 0) {
                out.greys[std::size_t{y / by} * out.width + x / by] = 255;
            }
        }
    }
    return out;
}

double shown(double mm) {
    return std::round(mm * 100) / 100;
}

}  // namespace

Drawings::Drawings(board::Board& board) : board_(board) {
    if (auto* const printer = machine::as<filament::Printer>(board_.machine())) {
        printer->motion.on_travel([this](const filament::Travel& travel) { path_.add(travel); });
    }
}

Drawings::~Drawings() {
    if (auto* const printer = machine::as<filament::Printer>(board_.machine())) {
        printer->motion.on_travel({});
    }
}

Json Drawings::look(bool whole) {
    for (const auto draw : {&Drawings::way, &Drawings::picture, &Drawings::panel_picture}) {
        if (Json out = (this->*draw)(whole); !out.is_null()) {
            return out;
        }
    }
    return nullptr;
}

Json Drawings::way(bool whole) {
    const auto* const printer = machine::as<filament::Printer>(std::as_const(board_).machine());
    if (printer == nullptr) {
        return nullptr;
    }
    const auto& volume = printer->config().motion.volume_mm;
    const auto& head = printer->motion.executed();
    Json layers = whole ? path_.whole() : path_.news();
    Json place{shown(head[0]), shown(head[1])};
    std::string now = place.dump();
    if (!whole && layers.empty() && now == told_) {
        return nullptr;
    }
    told_ = std::move(now);
    return {{"way",
             {{"more", !whole},
              {"size", {volume[0], volume[1]}},
              {"head", std::move(place)},
              {"layers", std::move(layers)}}}};
}

Json Drawings::picture(bool whole) {
    const auto* const printer = machine::as<resin::Printer>(std::as_const(board_).machine());
    const auto place = printer != nullptr ? printer->print.place() : std::nullopt;
    if (!place) {
        return nullptr;
    }
    const bool lit = printer->print.exposing();
    std::string now = fmt::format("{} {} {}", place->path, place->layer, lit);
    if (!whole && now == told_) {
        return nullptr;
    }
    const std::string layer = fmt::format("{} {} ", place->path, place->layer);
    const auto layers = place->file.header().layers;  // behind the last one the place is one more
    Json out{{"lit", lit},
             {"words", fmt::format("Layer {} of {}, {}", std::min<std::uint64_t>(place->layer + 1, layers),
                                   layers, lit ? "the LED shines" : "dark")}};
    if (whole || !told_.starts_with(layer)) {
        if (const auto small = read_picture(*place)) {
            out["width"] = small->width;
            out["height"] = small->height;
            out["greys"] = control::to_base64(small->packed());
        }
    }
    told_ = std::move(now);
    return {{"picture", std::move(out)}};
}

/// Of a board whose panel lies behind an FPGA: what it has, whatever the file says.
Json Drawings::panel_picture(bool whole) {
    const auto* const printer = machine::as<dlp::Printer>(std::as_const(board_).machine());
    if (printer == nullptr) {
        return nullptr;
    }
    const dlp::MksBoard& mks = printer->board;
    const bool seen = mks.panel.showing();
    const bool lit = mks.lamp.on();
    const std::string what = !seen ? ""
                             : mks.panel.white()
                                 ? "white"
                                 : mks.panel.fpga().md5(dlp::bank_of(mks.panel.fpga().command()));
    std::string words = !seen ? "The panel is dark"
                        : mks.print.active()
                            ? fmt::format("Layer {} of {}", mks.print.layer(), mks.print.layers())
                            : "Not of a print";
    words += lit ? ", the lamp shines" : ", the lamp is out";
    const std::string now = fmt::format("{} {}", what, words);
    if (whole ? !seen && !lit : now == told_) {
        return nullptr;
    }
    Json out{{"lit", lit}, {"words", std::move(words)}};
    if (seen && (whole || !told_.starts_with(what + " "))) {
        const Small small = read_panel(mks.panel);
        out["width"] = small.width;
        out["height"] = small.height;
        out["greys"] = control::to_base64(small.packed());
    }
    told_ = now;
    return {{"picture", std::move(out)}};
}

}  // namespace fauxboard::host
