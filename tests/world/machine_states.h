#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/world/live_bench.h"

namespace fauxboard::world {

/// A state of a machine, and how it gets there.
struct State {
    std::string name;
    std::function<void(LiveBench&)> enter;
    /// A command of a host is under way: what hosts ask waits for that, as on a real board.
    bool own_command = false;
    /// It prints then, whatever it is.
    bool prints = false;
};

/// Those of the machine of such a board; all faults that it can have are states as well.
std::vector<State> states_of(LiveBench& one_of_them);

}  // namespace fauxboard::world
