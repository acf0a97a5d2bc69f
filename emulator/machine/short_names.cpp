#include "emulator/machine/short_names.h"

#include <algorithm>
#include <set>

namespace fauxboard::machine {
namespace {

constexpr std::size_t most_base = 8;
constexpr std::size_t most_ending = 3;
constexpr std::size_t kept_of_long_base = 6;
constexpr std::string_view forbidden = "|<>^+=?/[]:;,*\"\\";

char capital(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool allowed(char c) {
    return static_cast<unsigned char>(c) > ' ' && static_cast<unsigned char>(c) < 0x7F &&
           forbidden.find(c) == std::string_view::npos;
}

struct Parts {
    std::string base;
    std::string ending;
};

/// In capitals, without blanks and dots, all that is not allowed as '_'.
std::string tidy(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c != ' ' && c != '.') {
            out += allowed(c) ? capital(c) : '_';
        }
    }
    return out;
}

Parts part(std::string_view name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string_view::npos || dot == 0) {
        return {tidy(name), {}};
    }
    return {tidy(name.substr(0, dot)), tidy(name.substr(dot + 1))};
}

std::string join(const Parts& parts) {
    return parts.ending.empty() ? parts.base : parts.base + "." + parts.ending;
}

}  // namespace

bool is_short_name(std::string_view name) {
    const std::size_t dot = std::min(name.find('.'), name.size());
    const std::string_view ending = name.substr(std::min(dot + 1, name.size()));
    return dot >= 1 && dot <= most_base && ending.size() <= most_ending &&
           ending.find('.') == std::string_view::npos &&
           std::all_of(name.begin(), name.end(), [](char c) { return allowed(c); });
}

std::vector<std::string> short_names(const std::vector<CardEntry>& entries) {
    std::vector<std::string> names(entries.size());
    std::set<std::string, std::less<>> taken;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (is_short_name(entries[i].name)) {
            std::string name(entries[i].name);
            std::transform(name.begin(), name.end(), name.begin(), capital);
            names[i] = taken.insert(name).second ? name : std::string();
        }
    }
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Parts whole = part(entries[i].name);
        for (unsigned number = 1; names[i].empty(); ++number) {
            const std::string mark = "~" + std::to_string(number);
            Parts cut{whole.base.substr(0, std::min(kept_of_long_base, most_base - mark.size())) + mark,
                      whole.ending.substr(0, most_ending)};
            if (std::string name = join(cut); taken.insert(name).second) {
                names[i] = std::move(name);
            }
        }
    }
    return names;
}

bool is_printable(std::string_view short_name) {
    const std::size_t dot = short_name.rfind('.');
    const std::string_view ending =
        dot == std::string_view::npos ? std::string_view{} : short_name.substr(dot + 1);
    return ending.starts_with('G') && !ending.starts_with("G~");
}

}  // namespace fauxboard::machine
