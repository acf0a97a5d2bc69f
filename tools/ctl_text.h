#pragma once

// Answers and events of a control channel, for people.

#include <nlohmann/json.hpp>
#include <string>

namespace fauxboard::tools {

/// The members of an answer that is ok, a line each; fields with their units.
std::string answer_text(const nlohmann::ordered_json& answer);

/// An event: its virtual time in seconds, and what happened.
std::string event_text(const nlohmann::ordered_json& event);

}  // namespace fauxboard::tools
