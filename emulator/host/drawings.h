#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "emulator/board/board.h"
#include "emulator/control/error.h"
#include "emulator/host/path_keeper.h"

namespace fauxboard::host {

/// What a machine draws while it prints, for people: the way of a head in the plane of its bed, or the
/// picture of a layer. Reads the machine and changes nothing of it.
class Drawings {
  public:
    static constexpr std::uint32_t most_side = 432;  ///< pixels of a picture; a bigger one is made smaller

    /// `board` outlives this.
    explicit Drawings(board::Board& board);
    ~Drawings();
    Drawings(const Drawings&) = delete;
    Drawings& operator=(const Drawings&) = delete;

    /// {"way": {"more": false, "size": [x, y], "head": [x, y], "layers": [...]}}, see PathKeeper; or
    /// {"picture":
    /// {"width", "height", "lit", "words", "greys": base64 of four pixels a byte}}; null for a machine that
    /// does neither.
    control::Json whole() { return look(true); }
    /// The same of what is new since the last call, {"way": {"more": true, ...}}; null when nothing is.
    control::Json news() { return look(false); }

  private:
    control::Json look(bool whole);
    control::Json way(bool whole);
    control::Json picture(bool whole);
    control::Json panel_picture(bool whole);

    board::Board& board_;
    PathKeeper path_;
    std::string told_;  ///< of the picture, and of the head: as it was told last
};

}  // namespace fauxboard::host
