#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/dlp/parameters.h"
#include "emulator/dlp/settings.h"

namespace fauxboard::dlp {

/// What became of a settings file.
enum class AcfgResult : std::uint8_t { ok, unknown_section, unknown_parameter, invalid_value };

/// "unknown_param": for programs.
std::string_view to_string(AcfgResult result);
/// The board's words in its box, in English; empty for ok.
std::string_view box_text(AcfgResult result);

/// A parameter of a settings file, as it was taken.
struct AcfgValue {
    const Parameter* parameter = nullptr;
    unsigned line = 0;
    std::string written;          ///< in the file
    bool kept_in_bounds = false;  ///< what is live is not what was written
};

struct AcfgReport {
    AcfgResult result = AcfgResult::ok;
    unsigned line = 0;                ///< of the error, from 1 as the board counts; 0 without one
    std::vector<AcfgValue> taken;     ///< in the order of the file; at most `most_taken`, the latest dropped
    std::vector<unsigned> cut_lines;  ///< lines too long for the board's buffer, which it took for two
    bool too_large = false;           ///< no settings file is: the error is where reading ended

    static constexpr std::size_t most_taken = 1024;
};

/// How much of a line the board's buffer holds, its end included: a longer one is two lines to it.
constexpr std::size_t acfg_line_bytes = 512;

/// No settings file is larger. The real board would read on for hours.
constexpr std::size_t acfg_most_bytes = 1UL << 20;

/// Fills the buffer with the next bytes of a file, returns how many; 0 at the end.
using AcfgBytes = std::function<std::size_t(char* out, std::size_t room)>;

/// Takes a settings file into `settings`, line by line as the board does: what stands before an error is in
/// force then. Memory is flat however long file and lines are.
AcfgReport read_acfg(const AcfgBytes& bytes, Settings& settings, Firmware firmware);
AcfgReport read_acfg(std::string_view text, Settings& settings, Firmware firmware);

}  // namespace fauxboard::dlp
