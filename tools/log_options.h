#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "emulator/host/log_file.h"
#include "emulator/host/log_level.h"

namespace fauxboard::behaviour {
class Profile;
}

namespace fauxboard::tools {

struct RunOptions;

/// The program's log of its own doings, as it was asked for.
struct LogOptions {
    std::string file;                     ///< empty: none
    std::optional<host::LogLevel> level;  ///< of the file, or of stderr where there is none
    std::uint64_t most_bytes = host::LogFile::Options{}.most_bytes;
    unsigned files = host::LogFile::Options{}.files;
    bool json = false;

    /// Whether anything would get into the file.
    bool wanted() const { return !file.empty() && level != host::LogLevel::off; }
    host::LogLevel file_level() const { return level.value_or(host::LogLevel::info); }
    /// Of a command that tells warnings where it is not asked.
    host::LogLevel stderr_level() const {
        return file.empty() ? level.value_or(host::LogLevel::warning) : host::LogLevel::warning;
    }
    host::LogFile::Options for_file() const;
};

/// --log-level, --log-file and how it is kept.
void add_log(CLI::App& command, LogOptions& options);

/// What stands at the beginning of a run's log: the program, and each file that the run works with.
std::vector<std::string> first_words(const RunOptions& options, const behaviour::Profile& profile);

}  // namespace fauxboard::tools
