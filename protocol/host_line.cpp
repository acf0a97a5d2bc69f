#include "protocol/host_line.h"

#include <algorithm>
#include <charconv>

#include "protocol/framing.h"

namespace fauxboard::protocol {
namespace {

std::string_view trim(std::string_view text) {
    const auto from = text.find_first_not_of(" \t");
    return from == std::string_view::npos ? std::string_view{}
                                          : text.substr(from, text.find_last_not_of(" \t") - from + 1);
}

bool all_digits(std::string_view text) {
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::int64_t clamped_number(std::string_view digits, bool negative) {
    constexpr std::int64_t most = 2'147'483'647;
    std::int64_t value = 0;
    for (const char c : digits) {
        value = std::min(value * 10 + (c - '0'), most);
    }
    return negative ? -value : value;
}

/// Takes "N12" or "N-1" off the start; false when there is none.
bool take_number(std::string_view& text, HostLine& out) {
    if (text.size() < 2 || (text[0] != 'N' && text[0] != 'n')) {
        return false;
    }
    std::string_view rest = text.substr(1);
    const bool negative = rest[0] == '-';
    rest.remove_prefix(negative ? 1 : 0);
    const std::size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
    if (digits == 0) {
        return false;
    }
    out.number = clamped_number(rest.substr(0, digits), negative);
    text = rest.substr(digits);
    return true;
}

}  // namespace

HostLine unframe_host_line(std::string_view line) {
    HostLine out;
    line = line.substr(0, line.find(';'));
    std::string_view body = trim(line);
    out.numbered = take_number(body, out);
    const std::size_t star = body.rfind('*');
    if (star != std::string_view::npos) {
        const std::string_view behind = trim(body.substr(star + 1));
        if (out.numbered || all_digits(behind)) {
            out.has_checksum = true;
            unsigned sum = 256;
            if (all_digits(behind)) {
                std::from_chars(behind.data(), behind.data() + behind.size(), sum);
            }
            const std::string_view summed = line.substr(0, line.rfind('*'));
            out.checksum_right = sum == xor_checksum(summed);
            body = body.substr(0, star);
        }
    }
    out.body = trim(body);
    return out;
}

bool sets_line_number(const HostLine& line) {
    return line.body.starts_with("M110") && (line.body.size() == 4 || line.body[4] == ' ');
}

std::optional<std::int64_t> number_set(const HostLine& line) {
    if (!sets_line_number(line)) {
        return std::nullopt;
    }
    std::string_view text = trim(line.body.substr(4));
    HostLine parsed;
    return take_number(text, parsed) ? std::optional(parsed.number) : std::nullopt;
}

HostLineFault judge_host_line(const HostLine& line, std::int64_t last) {
    if (line.numbered) {
        if (line.number != last + 1 && !sets_line_number(line)) {
            return HostLineFault::wrong_number;
        }
        if (!line.has_checksum) {
            return HostLineFault::no_checksum;
        }
        return line.checksum_right ? HostLineFault::none : HostLineFault::wrong_checksum;
    }
    return line.has_checksum ? HostLineFault::no_number : HostLineFault::none;
}

}  // namespace fauxboard::protocol
