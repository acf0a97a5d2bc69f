#include "protocol/host_line.h"

#include <algorithm>

#include "protocol/framing.h"

namespace fauxboard::protocol {
namespace {

std::string_view skip_blanks(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(' '), text.size()));
}

std::string_view trim(std::string_view text) {
    return skip_blanks(text).substr(0, skip_blanks(text).find_last_not_of(' ') + 1);
}

bool digit(char c) {
    return c >= '0' && c <= '9';
}

bool all_digits(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), digit);
}

/// The whole number that `text` begins with, as strtol reads it, within 32 bits; 0 for none.
std::int64_t whole(std::string_view text) {
    constexpr std::int64_t most = 2'147'483'647;
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    const bool negative = text.starts_with('-');
    text.remove_prefix(negative || text.starts_with('+') ? 1 : 0);
    std::int64_t value = 0;
    for (const char c : text) {
        if (!digit(c)) {
            break;
        }
        value = std::min(value * 10 + (c - '0'), most);
    }
    return negative ? -value : value;
}

/// What stands behind "N12" or "N-1"; the text itself where the N has no number right behind it.
std::string_view behind_number(std::string_view text) {
    const std::size_t sign = text.size() > 1 && (text[1] == '-' || text[1] == '+') ? 1 : 0;
    std::size_t at = 1 + sign;
    while (at < text.size() && digit(text[at])) {
        ++at;
    }
    return at == 1 ? text : text.substr(at);
}

void read_number(std::string_view text, HostLine& out) {
    constexpr std::size_t shortest = 4;  // the firmware looks for the second N from there on
    out.sets_number = text.find("M110") != std::string_view::npos;
    const std::size_t second =
        out.sets_number && text.size() > shortest ? text.find('N', shortest) : std::string_view::npos;
    out.number = whole(text.substr(second == std::string_view::npos ? 1 : second + 1));
}

}  // namespace

std::string_view without_remark(std::string_view line) {
    return line.substr(0, line.find(';'));
}

std::string_view read_host_line(std::string_view bytes, std::array<char, 512>& room, std::size_t most_chars) {
    bytes = skip_blanks(bytes);
    const std::size_t special = bytes.find_first_of(";\\\b");
    if (special == std::string_view::npos || bytes[special] == ';') {
        return bytes.substr(0, std::min(special, most_chars));
    }
    most_chars = std::min(most_chars, room.size());
    std::size_t size = 0;
    for (std::size_t i = 0; i < bytes.size() && bytes[i] != ';'; ++i) {
        if (bytes[i] == '\b') {
            size -= size > 0 ? 1 : 0;
            continue;
        }
        if (bytes[i] == '\\' && ++i == bytes.size()) {
            break;
        }
        if (size < most_chars && (size > 0 || bytes[i] != ' ')) {
            room[size++] = bytes[i];
        }
    }
    return {room.data(), size};
}

HostLine unframe_host_line(std::string_view line, const HostLineRules& rules) {
    HostLine out;
    line = skip_blanks(line);
    std::string_view body = line;
    out.numbered = line.starts_with('N');
    if (out.numbered) {
        read_number(line, out);
        body = skip_blanks(behind_number(line));
    }
    const std::size_t star = line.rfind('*');
    if (star != std::string_view::npos) {
        const std::string_view behind = line.substr(star + 1);
        out.has_checksum = out.numbered || all_digits(trim(behind));
        out.checksum_right = out.has_checksum && whole(behind) == xor_checksum(line.substr(0, star));
    }
    if (rules.first_star_ends) {
        body = body.substr(0, body.find('*'));
    } else if (out.has_checksum) {
        body = body.substr(0, body.rfind('*'));
    }
    out.body = trim(body);
    return out;
}

HostLineFault judge_host_line(const HostLine& line, std::int64_t last, const HostLineRules& rules) {
    if (!line.numbered) {
        const bool wants_number = line.has_checksum && rules.judges_unnumbered;
        return wants_number ? HostLineFault::no_number : HostLineFault::none;
    }
    if (line.number != last + 1 && !line.sets_number) {
        const bool repeated = line.number == last || line.number == last - 1;
        return repeated && rules.drops_repeated ? HostLineFault::repeated : HostLineFault::wrong_number;
    }
    if (!line.has_checksum) {
        return HostLineFault::no_checksum;
    }
    return line.checksum_right ? HostLineFault::none : HostLineFault::wrong_checksum;
}

}  // namespace fauxboard::protocol
