#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "emulator/control/names.h"
#include "emulator/host/live_target.h"

namespace fauxboard::panel {

/// Between two looks at all boards.
inline constexpr std::chrono::seconds shelf_pause{1};

/// One board on the shelf, as a page has last been told of it.
class ShelfCard {
  public:
    /// Of {"t", "link", "faults", "words", "progress"} what is another than at the last call; time alone is
    /// no news. Brings the board's machine up to now only as far as the board itself has.
    control::Json changes(const host::LiveTarget& target);

  private:
    void choose(const board::Board& board);

    std::optional<control::Json> last_;
    std::vector<control::Place> curves_;  ///< what a glance shows: temperatures, heights
    std::optional<control::Place> progress_;
    bool chosen_ = false;
};

}  // namespace fauxboard::panel
