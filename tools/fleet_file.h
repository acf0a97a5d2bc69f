#pragma once

#include <string>
#include <vector>

#include "emulator/behaviour/source.h"
#include "tools/run_options.h"

namespace fauxboard::tools {

/// One board of a fleet.
struct FleetBoard {
    std::string name;
    RunOptions options;
};

/// A fleet as its file has it, every group of boards spread out.
struct Fleet {
    static constexpr unsigned most_boards = 4096;
    std::vector<FleetBoard> boards;
};

/// Reads {"boards": [{"profile", "count", "name", ...}, ...]}; see the guide in tools/guides. `{n}` in a text
/// is the number of the board within its group, from 1. Throws behaviour::ProfileError with all that is
/// wrong.
Fleet read_fleet(const behaviour::SourceText& source);
/// The same of a file by its path.
Fleet read_fleet(const std::string& file);

}  // namespace fauxboard::tools
