#pragma once

// Fields and variables by name, and their values as JSON.

#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/rules.h"
#include "emulator/board/board.h"
#include "emulator/control/error.h"

namespace fauxboard::control {

/// A field of the machine, or (when `field` is null) one of the profile's variables.
struct Place {
    const behaviour::Field* field = nullptr;
    std::size_t variable = 0;
    std::string name;  ///< "heaters.nozzle.target", "var.greeted"
};

/// The place of that name. Throws ControlError with the nearest name.
Place find_place(const board::Board& board, const std::string& name);

/// What one entry of a list of fields stands for: a field, a variable, or a group of them ("heaters",
/// "heaters.nozzle", "var"). Throws ControlError.
void find_places(const board::Board& board, const std::string& name, std::vector<Place>& out);

/// Every field and variable.
std::vector<Place> all_places(const board::Board& board);

/// Its value now. Texts of the line are Latin-1; what is no finite number is null.
Json value_of(const board::Board& board, const Place& place);

/// {"name": value, ...}
Json values_of(const board::Board& board, const std::vector<Place>& places);

/// The assignment of a value to a place. Throws ControlError: read only, wrong type, out of bounds (which it
/// names).
behaviour::ActionCall assignment(const board::Board& board, const Place& place, const Json& value);

/// Throws ControlError when a compiled assignment would put a literal beyond its bounds. Whatever else it is
/// passes.
void check_bounds(const board::Board& board, const behaviour::ActionCall& call);

}  // namespace fauxboard::control
