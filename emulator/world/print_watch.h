#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "emulator/machine/events.h"

namespace fauxboard::machine {
class Machine;
}

namespace fauxboard::world {

/// What a print came to when it reached its end, as far as the machine counts it: moves, and layers.
using Tally = std::array<double, 2>;

/// Follows the prints of a board, of whatever kind, by its events.
class PrintWatch {
  public:
    void see(machine::EventId event, const machine::Machine& machine);
    /// One has begun since forget().
    bool begun() const { return begun_; }
    /// Of the last one that reached its end since forget().
    const std::optional<Tally>& ended() const { return ended_; }
    void forget() { *this = {}; }

  private:
    bool begun_ = false;
    double layers_ = 0;
    std::optional<Tally> ended_;
};

/// What is done to a board so that it prints a file, as behaviour::parse_action_words() takes it; a kind of
/// machine understands some of it.
std::vector<std::string> words_to_print(const std::string& file);

}  // namespace fauxboard::world
