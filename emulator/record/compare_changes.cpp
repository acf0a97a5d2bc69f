// When fields that tell of something done change their value.

#include <algorithm>
#include <array>
#include <cmath>

#include "emulator/record/compare_talk.h"

namespace fauxboard::record::detail {
namespace {

struct Watched {
    std::string_view label;
    std::string_view key;
    bool slow;  ///< told by L3, every second round
};
constexpr std::array watched{
    Watched{"L3", "MT:", true},    Watched{"L3", "FT:", true},   Watched{"L3", "MR:", true},
    Watched{"L3", "PS:", true},    Watched{"L22", "MS:", false}, Watched{"L22", "MR:", false},
    Watched{"L24 P5", "A", false}, Watched{"L2", "SD:", false},  Watched{"L2", "F0:", false},
    Watched{"L2", "R:", false},
};

struct Change {
    double t = 0;
    std::string value;
};

std::vector<Change> changes_of(const std::vector<Said>& talk, const Watched& what) {
    std::vector<Change> out;
    std::optional<std::string> before;
    for (const Said& said : talk) {
        if (said.label != what.label) {
            continue;
        }
        auto value = said.value(what.key);
        if (before && value && *value != *before) {
            out.push_back({said.t, *value});
        }
        before = std::move(value);
    }
    return out;
}

/// Longest common sequence of values: which change is which, when one side lacks some. The sides are short;
/// beyond the limit only the start is looked at.
std::vector<std::pair<const Change*, const Change*>> pair_up(const std::vector<Change>& a,
                                                             const std::vector<Change>& b) {
    constexpr std::size_t limit = 2000;
    const std::size_t n = std::min(a.size(), limit);
    const std::size_t m = std::min(b.size(), limit);
    std::vector<std::vector<std::uint16_t>> best(n + 1, std::vector<std::uint16_t>(m + 1, 0));
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t j = m; j-- > 0;) {
            best[i][j] = a[i].value == b[j].value ? static_cast<std::uint16_t>(best[i + 1][j + 1] + 1)
                                                  : std::max(best[i + 1][j], best[i][j + 1]);
        }
    }
    std::vector<std::pair<const Change*, const Change*>> out;
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < n || j < m) {
        if (i < n && j < m && a[i].value == b[j].value) {
            out.emplace_back(&a[i++], &b[j++]);
        } else if (j == m || (i < n && best[i + 1][j] >= best[i][j + 1])) {
            out.emplace_back(&a[i++], nullptr);
        } else {
            out.emplace_back(nullptr, &b[j++]);
        }
    }
    return out;
}

}  // namespace

std::vector<ChangeRow> compare_changes(const std::vector<Said>& theirs, const std::vector<Said>& ours,
                                       const Tolerances& tolerances) {
    std::vector<ChangeRow> rows;
    const double end = theirs.empty() ? 0 : theirs.back().t;
    for (const Watched& what : watched) {
        const std::vector<Change> recorded = changes_of(theirs, what);
        const std::vector<Change> given = changes_of(ours, what);
        for (const auto& [a, b] : pair_up(recorded, given)) {
            ChangeRow row;
            row.field = std::string(what.label) + ' ' + std::string(what.key.substr(0, what.key.find(':')));
            row.value = (a != nullptr ? a : b)->value;
            row.allowed_s = what.slow ? tolerances.slow_round_s : tolerances.slot_round_s;
            if (a != nullptr) {
                row.recorded_t = a->t;
            }
            if (b != nullptr) {
                row.our_t = b->t;
            }
            if (a != nullptr && b != nullptr) {
                row.ok = std::abs(a->t - b->t) <= row.allowed_s;
            } else {
                row.ok = (a != nullptr ? a : b)->t > end - tolerances.missing_tail_s;
            }
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

}  // namespace fauxboard::record::detail
