#include "tools/panel_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "emulator/dlp/event_rows.h"
#include "emulator/link/host_error.h"
#include "tools/png_file.h"

namespace fauxboard::tools {
namespace {

/// Files hold 32-bit floats; a person wants 0.05, not 0.0500000007.
double rounded(double value) {
    return std::round(value * 1e6) / 1e6;
}

/// From 1.
std::string picture_name(std::uint64_t number) {
    return fmt::format("{:06}.png", number);
}

/// A list that begins as ours do may be written anew, and with it its pictures; without one they are somebody
/// else's. Throws link::HostError.
void refuse_others_files(const std::string& folder) {
    constexpr std::string_view begin = "{\"t\":";
    const std::string lines = PanelFolder::list_in(folder);
    const std::string first = (std::filesystem::path(folder) / picture_name(1)).string();
    std::error_code error;
    std::string text(begin.size(), '\0');
    const bool is_list = std::filesystem::is_regular_file(lines, error);
    const auto got =
        is_list ? std::ifstream(lines, std::ios::binary).read(text.data(), begin.size()).gcount() : 0;
    const bool ours = got == 0 || text == begin;
    if (!ours || (got == 0 && std::filesystem::exists(std::filesystem::symlink_status(first, error)))) {
        throw link::HostError(fmt::format(
            "{} is not of --panel, and would be written over. Name another folder.", ours ? first : lines));
    }
}

}  // namespace

PanelFolder::PanelFolder(std::string folder, OnTrouble on_trouble)
    : folder_(std::move(folder)), on_trouble_(std::move(on_trouble)) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    refuse_others_files(folder_);
    const std::string lines = list_in(folder_);
    lines_.emplace(lines, lines);
}

std::string PanelFolder::list_in(const std::string& folder) {
    return (std::filesystem::path(folder) / "panel.jsonl").string();
}

void PanelFolder::write_picture(const std::string& name) const {
    const dlp::UvPanel& panel = machine_->board.panel;
    const unsigned bank = dlp::bank_of(panel.fpga().command());
    unsigned line = 0;
    write_png((std::filesystem::path(folder_) / name).string(),
              {dlp::panel_columns, dlp::panel_lines, false, true, [&](std::span<unsigned char> row) {
                   panel.white() ? static_cast<void>(std::fill(row.begin(), row.end(), 0xFF))
                                 : dlp::take_pixels(panel.fpga().line(bank, line), row);
                   ++line;
                   return true;
               }});
}

void PanelFolder::finish() {
    if (const std::string why = lines_->finish(); !why.empty()) {
        on_trouble_(fmt::format("{} is not whole: {}", list_in(folder_), why));
    }
}

void PanelFolder::on_event(machine::SimTime now, machine::EventId event) {
    if (event != dlp::event("print.displayed") || lines_->over() || machine_ == nullptr) {
        return;
    }
    const dlp::MksBoard& board = machine_->board;
    const unsigned bank = dlp::bank_of(board.panel.fpga().command());
    const std::string name = picture_name(++count_);
    nlohmann::ordered_json line{{"t", machine::to_seconds(now)}};
    if (board.print.active()) {
        line["layer"] = board.print.layer();
        line["z_mm"] = rounded(board.print.plan().z_mm);
        line["exposure_s"] = machine::to_seconds(board.print.exposure());
    } else {
        line["layer"] = nullptr;
        line["image"] = board.uv_test.image();
    }
    line["bank"] = bank;
    line["lit"] = board.panel.lit();
    line["md5"] = board.panel.fpga().md5(bank);
    line["file"] = name;
    try {
        write_picture(name);
        if (const std::string why = lines_->append(line.dump() + "\n"); !why.empty()) {
            on_trouble_(fmt::format("panel.jsonl cannot be written to ({}); no more pictures are.", why));
        }
    } catch (const link::HostError& error) {
        on_trouble_(error.what());
        lines_->finish();
    }
}

}  // namespace fauxboard::tools
