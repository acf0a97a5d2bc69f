#pragma once

// The chapter of faults, of lines and of the printer, for people.

#include <nlohmann/json.hpp>
#include <string>

namespace fauxboard::tools {

/// `faults` is fault::describe_kinds().
std::string faults_text(const nlohmann::ordered_json& faults);
std::string faults_markdown(const nlohmann::ordered_json& faults);

}  // namespace fauxboard::tools
