#include "emulator/resin/resin_commands.h"

#include <algorithm>
#include <array>
#include <utility>

namespace fauxboard::resin {
namespace {

/// A line takes this; so a file of any size is no more than so much work a time.
constexpr SimTime line_time{1000};
/// What is read at a time; longer lines are cut into pieces, as no request has so many.
constexpr std::size_t piece_bytes = 512;
constexpr std::string_view suffix = ".gcode";

bool same_letter(char a, char b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return lower(a) == lower(b);
}

}  // namespace

bool ResinCommands::fits(std::string_view path) {
    return path.size() > suffix.size() &&
           std::equal(suffix.rbegin(), suffix.rend(), path.rbegin(), same_letter);
}

void ResinCommands::begin(const Volume& volume, std::string path, SimTime now) {
    volume_ = &volume;
    path_ = std::move(path);
    offset_ = 0;
    line_.reset();
    due_ = now + line_time;
}

/// Nothing at the end of the file, or when it is gone.
std::optional<std::string> ResinCommands::read_line() {
    std::array<char, piece_bytes> piece{};
    const std::size_t size = volume_->read(path_, offset_, piece).value_or(0);
    if (size == 0) {
        return std::nullopt;
    }
    const std::string_view text(piece.data(), size);
    const std::size_t end = std::min(text.find_first_of("\r\n"), size);
    offset_ += std::min(end + 1, size);
    return std::string(text.substr(0, std::min(text.find(';'), end)));
}

void ResinCommands::advance(SimTime now) {
    if (next_event() > now) {
        return;
    }
    line_ = read_line();
    if (!line_) {
        stop();
    }
}

std::optional<std::string> ResinCommands::take(SimTime now) {
    if (line_) {
        due_ = now + line_time;
    }
    return std::exchange(line_, std::nullopt);
}

}  // namespace fauxboard::resin
