#pragma once

// What `fauxboard check` tells of a settings file of the MKS DLP board.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "emulator/dlp/acfg.h"

namespace fauxboard::tools {

/// Whether the file's name says that it is one.
bool is_acfg(const std::string& file);

struct CheckedAcfg {
    std::string file;
    dlp::AcfgReport report;
    dlp::Settings live;  ///< of a board that had its defaults and has loaded it
};

/// Reads it as the board does. Nothing when it cannot be read, and why not in `trouble`.
std::optional<CheckedAcfg> check_acfg(const std::string& file, std::string& trouble);

/// {"result", "line", "saved", "values", ...}: every parameter as it would be live, times in ms.
nlohmann::ordered_json acfg_json(const CheckedAcfg& checked);
/// The same for people: what the board's box says, what is live and what is saved.
std::string acfg_text(const CheckedAcfg& checked);

}  // namespace fauxboard::tools
