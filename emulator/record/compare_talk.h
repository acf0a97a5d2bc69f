#pragma once

// Private to compare*.cpp: a recording taken apart for comparing.

#include <string>
#include <string_view>
#include <vector>

#include "emulator/record/compare.h"
#include "protocol/annotate.h"

namespace fauxboard::record::detail {

/// One line of the board.
struct Said {
    double t = 0;
    std::string line;
    std::string code;   ///< "L24", "SD printing byte"
    std::string label;  ///< the code with its page where it has one: "L24 P5"
    protocol::DecodedLine decoded;
    bool taken = false;  ///< as the reply to a request

    /// The text of the first field with this key, or nothing.
    std::optional<std::string> value(std::string_view key) const;
};

std::vector<Said> board_talk(const std::vector<RecordedLine>& lines);

std::vector<RequestRow> compare_requests(const std::vector<RecordedLine>& recording, std::vector<Said> theirs,
                                         std::vector<Said> ours, const Tolerances& tolerances);
std::vector<BurstRow> compare_bursts(const std::vector<Said>& theirs, const std::vector<Said>& ours,
                                     const Tolerances& tolerances);
std::vector<PeriodRow> compare_periods(const std::vector<RecordedLine>& recording,
                                       const std::vector<Said>& theirs, const std::vector<Said>& ours,
                                       const Tolerances& tolerances);
std::vector<ChangeRow> compare_changes(const std::vector<Said>& theirs, const std::vector<Said>& ours,
                                       const Tolerances& tolerances);
std::vector<CurveRow> compare_curves(const std::vector<Said>& theirs, const std::vector<Said>& ours,
                                     bool folded, const Tolerances& tolerances);

}  // namespace fauxboard::record::detail
