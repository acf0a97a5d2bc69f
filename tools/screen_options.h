#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "emulator/host/time_text.h"
#include "emulator/machine/sim_time.h"

namespace fauxboard::tools {

/// What `fauxboard screen` was asked for; each of its subcommands uses a part of it.
struct ScreenOptions {
    std::string port;     ///< a device or "auto"; empty: none
    std::string tcp;      ///< "HOST:PORT"; empty: none
    std::string control;  ///< the channel of a board that has a screen of its own; empty: none
    std::string screen = "geeetech-a30t";
    unsigned baud = 115200;
    host::Speed speed;
    machine::SimTime timeout{10'000'000};  ///< real time until the board's first word
    std::string record;                    ///< file; empty: none
    bool json = false;
    bool verbose = false;
    std::vector<std::string> buttons;  ///< press
    std::string page = "Main";         ///< show
    std::string png;                   ///< show: file; empty: as text
    std::string junit;                 ///< tour: file; empty: none
};

/// Declares what all subcommands of `screen` have in common; `options` must live as long as `command`.
void declare_screen_options(CLI::App& command, ScreenOptions& options);

}  // namespace fauxboard::tools
