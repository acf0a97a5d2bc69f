#include "emulator/machine/card_names.h"

#include <algorithm>

namespace fauxboard::machine {
namespace {

char small(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

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
