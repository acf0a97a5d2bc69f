#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "emulator/behaviour/notice.h"

namespace fauxboard::host {

/// How much of its own doings the program tells, the most first.
enum class LogLevel : std::uint8_t {
    trace,    ///< every event of the machine
    debug,    ///< what faults did to each line, what was refused, clients and their requests
    info,     ///< what was done by hand, by scenarios and by edits; faults' begin and end; peers; files
    warning,  ///< what was taken otherwise than said
    error,
    off,
};

/// "trace", ...; nothing for anything else.
std::optional<LogLevel> log_level(std::string_view name);
std::string_view level_name(LogLevel level);
LogLevel log_level(behaviour::Level level);

}  // namespace fauxboard::host
