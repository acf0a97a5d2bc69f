#pragma once

// The control channel's part of the reference, from what control::describe_control() gives.

#include <nlohmann/json.hpp>
#include <string>

namespace fauxboard::tools {

/// For a terminal.
std::string control_text(const nlohmann::ordered_json& control);

/// As a chapter of the Markdown page.
std::string control_markdown(const nlohmann::ordered_json& control);

}  // namespace fauxboard::tools
