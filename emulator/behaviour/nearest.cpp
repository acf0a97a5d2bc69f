#include "emulator/behaviour/nearest.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace fauxboard::behaviour {
namespace {

constexpr std::size_t longest = 64;

std::size_t edit_distance(std::string_view a, std::string_view b) {
    a = a.substr(0, longest);
    b = b.substr(0, longest);
    std::array<std::size_t, longest + 1> row{};
    for (std::size_t j = 0; j <= b.size(); ++j) {
        row[j] = j;
    }
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

}  // namespace

std::string_view nearest(std::string_view word, std::span<const std::string_view> names) {
    std::string_view best;
    std::size_t best_distance = std::max<std::size_t>(2, word.size() / 2) + 1;
    for (const std::string_view name : names) {
        // So far apart in length alone: there may be very many wrong words to be compared with all names.
        const std::size_t apart = std::max(word.size(), name.size()) - std::min(word.size(), name.size());
        if (apart >= best_distance && std::max(word.size(), name.size()) <= longest) {
            continue;
        }
        const std::size_t distance = edit_distance(word, name);
        if (distance < best_distance) {
            best_distance = distance;
            best = name;
        }
    }
    return best;
}

}  // namespace fauxboard::behaviour
