#pragma once

#include <vector>

#include "emulator/board/board.h"
#include "emulator/control/names.h"

namespace fauxboard::host {

using board::SimTime;

/// The fields of this board that make a curve, told by what the tables say of them: temperatures and their
/// targets, heights, progress.
std::vector<control::Place> curve_places(const board::Board& board);

/// The curves of a run from its first moment on: temperatures and their targets, heights, progress, all of
/// curve_places(). Bounded: when it is full the older half keeps every other point, so that the latest
/// are the finest.
class CurveKeeper {
  public:
    static constexpr std::size_t most_points = 2048;
    static constexpr std::size_t most_series = 16;
    static constexpr SimTime every{1'000'000};

    /// Takes one point, if it is time for one; the board is refreshed to `now`. Returns when the next one is
    /// due.
    SimTime take(const board::Board& board, SimTime now);
    std::size_t points() const { return times_.size(); }
    /// {"series": [{"path", "unit", "help"}], "t": [...], "values": [[...], ...]}
    control::Json to_json() const;

  private:
    void thin();

    std::vector<control::Place> series_;
    std::vector<float> times_;   ///< s
    std::vector<float> values_;  ///< of all series, point after point
    SimTime due_{0};
    bool chosen_ = false;
};

}  // namespace fauxboard::host
