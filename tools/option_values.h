#pragma once

// Options that several commands have, declared once: what they take and what is said of a wrong value.

#include <CLI/App.hpp>
#include <string>

#include "emulator/machine/sim_time.h"

namespace fauxboard::tools {

/// --duration: 500ms, 10s, 5min, 24h or seconds.
void add_duration(CLI::App& command, machine::SimTime& duration, const std::string& help);

/// --baud: 50 to 4 million bits per second.
CLI::Option* add_baud(CLI::App& command, unsigned& baud, const std::string& help);

}  // namespace fauxboard::tools
