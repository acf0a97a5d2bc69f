#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/board_driver.h"

namespace fauxboard::testing {

/// A program on a PC that prints over the USB side as OctoPrint does, in virtual time: numbers its lines from
/// M110 on, adds checksums, waits for each `ok`, sends again what is asked for, and after a silence the last
/// line once more. Its line may be bad: bytes are changed and whole lines get lost, by seed.
class HostProgram {
  public:
    struct Noise {
        std::uint64_t seed = 1;
        int damaged_per_mille = 0;
        int lost_per_mille = 0;
    };

    HostProgram(BoardDriver& driver, Noise noise) : driver_(driver), noise_(noise), random_(noise.seed) {}

    /// Prints the commands, one a line; comments and empty lines are left out, as hosts do. False when the
    /// board stays silent for a minute, or `limit_s` of virtual time are over. `acknowledged` hears of each
    /// command when its ok is there.
    bool print(std::string_view gcode, double limit_s,
               const std::function<void(const std::string& command)>& acknowledged);

    int damaged() const { return damaged_; }
    int lost() const { return lost_; }
    int resends() const { return resends_; }
    int commands() const { return static_cast<int>(lines_.size()) - 1; }

  private:
    void send(std::size_t number);
    bool roll(int per_mille);
    std::uint64_t next_random();
    void look(const std::string& reply);

    BoardDriver& driver_;
    Noise noise_;
    std::uint64_t random_;
    std::vector<std::string> lines_;  ///< by number
    std::size_t at_ = 0;              ///< number of the line that waits for its ok
    std::size_t wanted_ = 0;          ///< number that a Resend named; 0: none
    bool ok_ = false;
    int damaged_ = 0, lost_ = 0, resends_ = 0;
};

}  // namespace fauxboard::testing
