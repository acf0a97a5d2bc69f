#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/host/line_log.h"
#include "emulator/host/time_text.h"
#include "emulator/machine/sim_time.h"

namespace fauxboard::tools {

/// Where the board's USB side is to be. At most one of them.
struct HostLine {
    bool pty = false;        ///< a pseudo-terminal of our own
    std::string pty_name;    ///< symlink to it; empty: none
    std::string port;        ///< a device
    std::string tcp;         ///< "HOST:PORT"
    unsigned baud = 115200;  ///< of a device, bit/s

    bool wanted() const { return pty || !port.empty() || !tcp.empty(); }
};

/// What `fauxboard run` was asked for.
struct RunOptions {
    std::string profile = "geeetech-a30t";
    std::string port;         ///< a device or "auto"; empty: none
    std::string tcp;          ///< "HOST:PORT"; empty: none
    std::string udp;          ///< "HOST:PORT"; empty: none
    std::string pty_name;     ///< symlink to our pty; empty: none
    unsigned baud = 0;        ///< bit/s; 0: what the profile says
    bool exact_baud = false;  ///< a peer on a pty at another speed hears garbage
    HostLine host;
    host::Speed speed;
    std::uint64_t seed = 1;
    std::string sd;                   ///< folder; empty: the card that the profile carries
    std::string udisk;                ///< folder; empty: none
    std::string eeprom;               ///< file; empty: in memory
    std::string panel;                ///< folder for what a UV panel shows; empty: none
    std::string spi;                  ///< where the wires to a UV panel lead; empty: nowhere
    std::string record;               ///< file; empty: none
    std::string control;              ///< socket of the control channel; empty: none
    std::optional<std::string> web;   ///< "HOST:PORT" of the panel in the browser; nothing: none
    std::string script;               ///< a scenario; empty: none
    std::string screen;               ///< a virtual screen in this process instead of a line; empty: none
    std::string junit;                ///< file; empty: none
    std::string report;               ///< file; empty: none
    std::vector<std::string> params;  ///< "name=value", of the scenario
    bool profile_given = false;       ///< by the user, not by default
    bool line_given = false;          ///< the same of --port, --tcp, --pty
    std::vector<std::string> faults;  ///< as fault::fault_from_text() reads them
    machine::SimTime duration = machine::never;
    bool pacing = true;
    bool json = false;
    bool reload = true;
    host::Detail detail = host::Detail::normal;
};

/// Declares the options of `run`, which are kept in `options`; its pointer must live as long as `command`.
void declare_run_options(CLI::App& command, RunOptions& options);

}  // namespace fauxboard::tools
