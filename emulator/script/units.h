#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "emulator/machine/sim_time.h"

namespace fauxboard::script {

using machine::SimTime;

/// "200C", "1.5min", "30mm/s", "50%": the number in `unit`, as fields and arguments of actions name theirs.
/// Units of the same family are converted ("2min" in s is 120). Nothing when it is no number with a unit of
/// that family; without a `unit` a plain number is wanted.
std::optional<double> quantity_from_text(std::string_view text, std::string_view unit);

/// How a value in that unit may be written: "200C"; for messages.
std::string quantity_example(std::string_view unit);

/// "500ms", "2min": a time, 0 or more. Nothing for anything else.
std::optional<SimTime> time_from_text(std::string_view text);

/// For a person: "12.35 s", "3 min 20 s".
std::string time_words(SimTime time);

}  // namespace fauxboard::script
