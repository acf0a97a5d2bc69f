#pragma once

// Options that several commands have, declared once: what they take and what is said of a wrong value.

#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/host/time_text.h"
#include "emulator/machine/sim_time.h"

namespace fauxboard::tools {

/// --duration: 500ms, 10s, 5min, 24h or seconds.
void add_duration(CLI::App& command, machine::SimTime& duration, const std::string& help);

/// --speed: a factor, or "max" where `may_jump`.
void add_speed(CLI::App& command, host::Speed& speed, bool may_jump);

/// --web [HOST:PORT[/TOKEN]].
void add_web(CLI::App& command, std::optional<std::string>& web);

/// --seed: any 64 bits.
void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& help);

/// What is wrong with HOST:PORT, before anybody tries to open it; empty for nothing.
std::string wrong_address(const std::string& text);

/// Whole numbers from `least` to `most`.
CLI::Validator whole_between(std::int64_t least, std::int64_t most);

/// Numbers from `least` to `most`, which are whole themselves.
CLI::Validator number_between(std::int64_t least, std::int64_t most);

/// "500000", "64k", "10M", "1G": bytes, by 1024. Nothing for anything else, and for what needs over 64 bits.
std::optional<std::uint64_t> parse_size(std::string_view text);

/// A value that is one of a few: what is wrong with another, and the nearest.
CLI::Validator one_of(std::vector<std::string> names);

/// --baud: 50 to 4 million bits per second.
CLI::Option* add_baud(CLI::App& command, unsigned& baud, const std::string& help);

}  // namespace fauxboard::tools
