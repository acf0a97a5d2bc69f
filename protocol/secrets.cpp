#include "protocol/secrets.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace fauxboard::protocol {
namespace {

constexpr std::array<std::string_view, 2> numbers{"9003", "9005"};

bool is_letter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// Where the code of a line that sets a password stands, also within other words; npos for any other line.
/// Boards take zeros before a code's number, and a line number right before it.
std::size_t find_code(std::string_view line) {
    for (std::size_t at = line.find('M'); at != std::string_view::npos; at = line.find('M', at + 1)) {
        const std::size_t number = std::min(line.find_first_not_of('0', at + 1), line.size());
        const std::size_t end = std::min(line.find_first_not_of("0123456789", number), line.size());
        const bool sets =
            std::find(numbers.begin(), numbers.end(), line.substr(number, end - number)) != numbers.end();
        if (sets && (at == 0 || !is_letter(line[at - 1]))) {
            return at;
        }
    }
    return std::string_view::npos;
}

unsigned checksum(std::string_view text) {
    unsigned sum = 0;
    for (const char c : text) {
        sum ^= static_cast<unsigned char>(c);
    }
    return sum;
}

}  // namespace

std::string mask_secrets(std::string_view line) {
    const std::size_t code = find_code(line);
    const std::size_t comma = code == std::string_view::npos ? code : line.find(',', code);
    if (comma == std::string_view::npos) {
        return std::string(line);
    }
    const std::size_t end = line.find_last_not_of("\r\n") + 1;
    const std::string_view body = line.substr(0, end);
    // A star within the password is no checksum: that one ends the line, with digits only.
    std::size_t star = body.rfind('*');
    unsigned said = 0;
    if (star != std::string_view::npos && star > comma) {
        const auto [stop, error] = std::from_chars(body.data() + star + 1, body.data() + body.size(), said);
        star = error == std::errc{} && stop == body.data() + body.size() ? star : std::string_view::npos;
    } else {
        star = std::string_view::npos;
    }
    std::string out(line.substr(0, comma));
    out += ",\"***\"";
    if (star != std::string_view::npos) {
        const bool right = checksum(body.substr(0, star)) == said;
        const unsigned sum = right ? checksum(out) : said;
        out += '*' + std::to_string(sum);
    }
    out += line.substr(end);
    return out;
}

}  // namespace fauxboard::protocol
