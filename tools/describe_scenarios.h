#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace fauxboard::tools {

/// What script::describe_scenarios() gives, for a terminal and as a chapter in Markdown.
std::string scenarios_text(const nlohmann::ordered_json& scenarios);
std::string scenarios_markdown(const nlohmann::ordered_json& scenarios);

}  // namespace fauxboard::tools
