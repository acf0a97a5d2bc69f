// What the board says again and again by itself.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "emulator/record/compare_talk.h"

namespace fauxboard::record::detail {
namespace {

constexpr double regular_share = 0.05;
/// Longer gaps are pauses, not periods.
constexpr double longest_s = 30;
constexpr double longest_repeat_s = 2;
/// Of fewer, one that waited for its turn behind another line moves the mean too far.
constexpr std::size_t least_regular = 5;

PeriodStats stats(std::size_t frames, std::vector<double> gaps) {
    PeriodStats out;
    out.frames = frames;
    if (gaps.empty()) {
        return out;
    }
    std::sort(gaps.begin(), gaps.end());
    const double median = gaps[gaps.size() / 2];
    double sum = 0;
    double squares = 0;
    for (const double gap : gaps) {
        if (std::abs(gap - median) <= regular_share * median) {
            ++out.regular;
            sum += gap;
            squares += gap * gap;
        }
    }
    const auto n = static_cast<double>(out.regular);
    out.mean_s = sum / n;
    out.sd_s = std::sqrt(std::max(0.0, squares / n - out.mean_s * out.mean_s));
    return out;
}

/// Gaps between neighbours of one code.
PeriodStats of_code(const std::vector<Said>& talk, std::string_view code) {
    std::size_t frames = 0;
    std::vector<double> gaps;
    double before = -std::numeric_limits<double>::infinity();
    for (const Said& said : talk) {
        if (said.code != code) {
            continue;
        }
        ++frames;
        if (said.t - before < longest_s) {
            gaps.push_back(said.t - before);
        }
        before = said.t;
    }
    return stats(frames, std::move(gaps));
}

/// L1 that tells the same place again: what a board does while it feeds filament.
PeriodStats of_repeats(const std::vector<Said>& talk) {
    std::size_t frames = 0;
    std::vector<double> gaps;
    const Said* before = nullptr;
    for (const Said& said : talk) {
        if (said.code == "L12") {
            before = nullptr;  // a run begins or ends here
        }
        if (said.code != "L1") {
            continue;
        }
        if (before != nullptr && before->line == said.line && said.t - before->t < longest_repeat_s) {
            ++frames;
            gaps.push_back(said.t - before->t);
        }
        before = &said;
    }
    return stats(frames, std::move(gaps));
}

PeriodRow judge(PeriodRow row, double allowed) {
    row.judged = row.recorded.regular >= least_regular;
    if (row.judged) {
        row.ok =
            row.ours.regular >= least_regular && std::abs(row.ours.mean_s - row.recorded.mean_s) <= allowed;
    }
    return row;
}

}  // namespace

std::vector<PeriodRow> compare_periods(const std::vector<RecordedLine>& recording,
                                       const std::vector<Said>& theirs, const std::vector<Said>& ours,
                                       const Tolerances& tolerances) {
    const bool screen_told = std::any_of(recording.begin(), recording.end(), [](const RecordedLine& line) {
        return line.from == RecordedLine::From::screen && line.bytes.find("M2134") != std::string::npos;
    });
    std::vector<PeriodRow> rows;
    rows.push_back(judge({"L3", "always", of_code(theirs, "L3"), of_code(ours, "L3"), false, true},
                         tolerances.status_period_s));
    rows.push_back(judge({"L21", screen_told ? "until M2134" : "always", of_code(theirs, "L21"),
                          of_code(ours, "L21"), false, true},
                         tolerances.status_period_s));
    rows.push_back(judge({"L1", "while loading", of_repeats(theirs), of_repeats(ours), false, true},
                         tolerances.loading_period_s));
    // When a temperature has moved enough hangs on noise: shown, not judged.
    rows.push_back({"L2", "temperatures moved", of_code(theirs, "L2"), of_code(ours, "L2"), false, true});
    return rows;
}

}  // namespace fauxboard::record::detail
