// What the board's screen lists and shows: the folder's files, previews, what the panel holds.

#include <algorithm>
#include <array>

#include "emulator/dlp/printer.h"
#include "emulator/dlp/profile/tables.h"

namespace fauxboard::dlp {
namespace {

using behaviour::List;
using behaviour::Picture;
using behaviour::Value;
using machine::Machine;

constexpr std::uint32_t lit_pixel = 0xFF'FF'FF;

const MksBoard* board_of(const Machine& machine) {
    const auto* const printer = machine::as<Printer>(machine);
    return printer == nullptr ? nullptr : &printer->board;
}

constexpr std::array<std::string_view, 4> file_columns{"name", "kind", "bytes", "date"};

Value file_value(const Machine& machine, std::size_t row, std::size_t column) {
    const MksBoard* const board = board_of(machine);
    if (board == nullptr || row >= board->files.files().size()) {
        return {};
    }
    const ListedFile& file = board->files.files()[row];
    switch (column) {
        case 0:
            return Value::of(std::string_view(file.entry.name));
        case 1:
            return Value::of(to_string(file.kind));
        case 2:
            return Value::of(static_cast<double>(file.entry.bytes));
        default:
            return Value::of(std::string_view(file.date));
    }
}

constexpr List list_table[] = {
    {"files", "folders and files of the folder that the board shows", file_columns,
     [](const Machine& machine) {
         const MksBoard* const board = board_of(machine);
         return board == nullptr ? std::size_t{0} : board->files.files().size();
     },
     file_value},
};

/// The path of the picture `index`: of a listed file, or the file viewed.
std::string listed_path(const MksBoard& board, std::size_t index) {
    const auto& files = board.files.files();
    return index < files.size() && files[index].kind == FileKind::print
               ? board.files.path_of(files[index].entry.name)
               : std::string();
}
std::string viewed_path(const MksBoard& board, std::size_t index) {
    return index == 0 ? board.viewed().path : std::string();
}

template <std::string (*Path)(const MksBoard&, std::size_t)>
const Previews::Pixels* preview(const Machine& machine, std::size_t index) {
    const MksBoard* const board = board_of(machine);
    const std::string path = board == nullptr ? std::string() : Path(*board, index);
    return path.empty() ? nullptr : board->previews.pixels(board->stick(), path);
}

template <std::string (*Path)(const MksBoard&, std::size_t)>
bool preview_size(const Machine& machine, std::size_t index, std::uint32_t& width, std::uint32_t& height) {
    const Previews::Pixels* const pixels = preview<Path>(machine, index);
    if (pixels == nullptr) {
        return false;
    }
    width = pixels->width;
    height = pixels->height;
    return true;
}

template <std::string (*Path)(const MksBoard&, std::size_t)>
bool preview_row(const Machine& machine, std::size_t index, std::uint32_t y, std::span<std::uint32_t> rgb) {
    const Previews::Pixels* const pixels = preview<Path>(machine, index);
    if (pixels == nullptr || y >= pixels->height || rgb.size() < pixels->width) {
        return false;
    }
    std::copy_n(pixels->rgb.begin() + std::ptrdiff_t{y} * pixels->width, pixels->width, rgb.begin());
    return true;
}

bool panel_size(const Machine& machine, std::size_t index, std::uint32_t& width, std::uint32_t& height) {
    width = panel_columns;
    height = panel_lines;
    return board_of(machine) != nullptr && index == 0;
}

bool bank_row(const MksBoard* board, unsigned bank, std::size_t index, std::uint32_t y,
              std::span<std::uint32_t> rgb) {
    if (board == nullptr || index != 0 || y >= panel_lines || rgb.size() < panel_columns) {
        return false;
    }
    const auto line = board->panel.fpga().line(bank, y);
    for (std::uint32_t column = 0; column < panel_columns; ++column) {
        rgb[column] = lit(line, column) ? lit_pixel : 0;
    }
    return true;
}

template <unsigned Bank>
constexpr Picture bank_picture(std::string_view path) {
    return {path, "what a bank of the panel's memory holds, in the file's orientation, without dead pixels",
            panel_size,
            [](const Machine& machine, std::size_t index, std::uint32_t y, std::span<std::uint32_t> rgb) {
                return bank_row(board_of(machine), Bank, index, y, rgb);
            }};
}

bool displayed_row(const Machine& machine, std::size_t index, std::uint32_t y, std::span<std::uint32_t> rgb) {
    const MksBoard* const board = board_of(machine);
    if (board == nullptr || !bank_row(board, bank_of(board->panel.fpga().command()), index, y, rgb)) {
        return false;
    }
    if (board->panel.white() || !board->panel.showing()) {
        std::fill(rgb.begin(), rgb.end(), board->panel.white() ? lit_pixel : 0U);
    }
    return true;
}

constexpr Picture picture_table[] = {
    {"files.preview", "preview of the listed file at this index", preview_size<listed_path>,
     preview_row<listed_path>},
    {"view.preview", "preview of the file viewed", preview_size<viewed_path>, preview_row<viewed_path>},
    bank_picture<0>("panel.bank0"),
    bank_picture<1>("panel.bank1"),
    bank_picture<2>("panel.bank2"),
    bank_picture<3>("panel.bank3"),
    {"panel.displayed", "what the panel shows: black when it shows nothing", panel_size, displayed_row},
};

}  // namespace

std::span<const List> lists() {
    return list_table;
}

std::span<const Picture> pictures() {
    return picture_table;
}

}  // namespace fauxboard::dlp
