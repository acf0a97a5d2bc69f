#include "emulator/host/plain_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace fauxboard::host {
namespace {

constexpr char32_t none = 0xFFFF'FFFF;

/// The character at the start of `text` and how many bytes it takes; `none` and 1 where there is no UTF-8.
char32_t take_character(std::string_view text, std::size_t& size) {
    const auto first = static_cast<unsigned char>(text[0]);
    size = first < 0x80 ? 1 : first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
    if (size == 0 || size > text.size()) {
        size = 1;
        return none;
    }
    char32_t character = size == 1 ? first : first & (0x7FU >> size);
    for (std::size_t i = 1; i < size; ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if ((byte & 0xC0U) != 0x80) {
            size = 1;
            return none;
        }
        character = character << 6U | (byte & 0x3FU);
    }
    static constexpr std::array<char32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
    const bool proper =
        character >= least[size] && character <= 0x10FFFF && !(character >= 0xD800 && character <= 0xDFFF);
    size = proper ? size : 1;
    return proper ? character : none;
}

/// Whether a terminal shows it, and as what it is.
bool is_shown(char32_t c) {
    const bool control = c < 0x20 || (c >= 0x7F && c < 0xA0);
    const bool turns = c == 0x061C || (c >= 0x200E && c <= 0x200F) || (c >= 0x2028 && c <= 0x202E) ||
                       (c >= 0x2066 && c <= 0x2069);
    return c != none && !control && !turns;
}

std::string spelled_out(std::string_view text, std::string_view kept) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        std::size_t size = 1;
        const char32_t character = take_character(text, size);
        if (is_shown(character) || kept.find(text[0]) != std::string_view::npos) {
            out += text.substr(0, size);
        } else {
            for (const char byte : text.substr(0, size)) {
                fmt::format_to(std::back_inserter(out), "\\x{:02X}", static_cast<unsigned char>(byte));
            }
        }
        text.remove_prefix(size);
    }
    return out;
}

std::string_view sequence(Ink ink) {
    static constexpr std::array<std::string_view, 6> sequences{"",         "\x1b[36m", "\x1b[32m",
                                                               "\x1b[33m", "\x1b[31m", "\x1b[90m"};
    return sequences[static_cast<std::size_t>(ink)];
}

}  // namespace

std::string plain_text(std::string_view text) {
    return spelled_out(text, "\n\t");
}

std::string plain_line(std::string_view text) {
    return spelled_out(text, "\t");
}

StyledLine& StyledLine::add(std::string_view part, Ink ink, std::size_t width) {
    const std::string text = plain_line(part);
    const bool inked = colours_ && ink != Ink::plain && !text.empty();
    const auto characters = static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80; }));
    bytes_ += inked ? sequence(ink) : std::string_view{};
    bytes_ += text;
    bytes_.append(width > characters ? width - characters : 0, ' ');
    bytes_ += inked ? "\x1b[0m" : "";
    return *this;
}

}  // namespace fauxboard::host
