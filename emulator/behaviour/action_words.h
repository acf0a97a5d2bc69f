#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/profile.h"

namespace fauxboard::behaviour {

/// What was done to a machine, as recordings hold it: its phrase or name where that says all ("filament in"),
/// else JSON of one line and of ASCII ({"heater.target":{"heater":"nozzle","c":200}}). Arguments stand with
/// the values they have in `scope`.
std::string action_words(const ActionCall& call, const Scope& scope, std::span<const VariableInfo> variables);

/// Words that mean nothing that this profile's machine can do; what() is the end of a sentence.
struct ActionWordsError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The other way. Throws ActionWordsError.
std::vector<ActionCall> parse_action_words(std::string_view words, const Profile& profile);

}  // namespace fauxboard::behaviour
