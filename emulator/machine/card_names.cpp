#include "emulator/machine/card_names.h"

#include <algorithm>

namespace fauxboard::machine {
namespace {

constexpr std::size_t base_bytes = 8;
constexpr std::size_t ending_bytes = 3;
constexpr std::string_view count = "~1";

char small(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// In capitals, without what such a name cannot hold.
std::string capitals(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c != ' ' && c != '.') {
            out += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        }
    }
    return out;
}

}  // namespace

std::string short_name(std::string_view name) {
    const std::size_t dot = name.rfind('.');
    const bool has_ending = dot != std::string_view::npos && dot != 0;
    const std::string_view base = has_ending ? name.substr(0, dot) : name;
    const std::string_view ending = has_ending ? name.substr(dot + 1) : std::string_view{};
    std::string out = capitals(base);
    if (out.size() != base.size() || base.size() > base_bytes || ending.size() > ending_bytes) {
        out = out.substr(0, base_bytes - count.size()).append(count);
    }
    return has_ending ? out + '.' + capitals(ending).substr(0, ending_bytes) : out;
}

std::string_view cut_name(std::string_view name, const std::vector<std::string>& ends) {
    for (const std::string& end : ends) {
        const std::size_t at = name.find(end);
        if (at != std::string_view::npos) {
            return name.substr(0, at + end.size());
        }
    }
    const std::size_t star = name.find('*');
    return star == std::string_view::npos ? std::string_view{} : name.substr(0, star);
}

bool same_letters(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return small(x) == small(y); });
}

}  // namespace fauxboard::machine
