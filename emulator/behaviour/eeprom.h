#pragma once

#include <string>
#include <string_view>

#include "emulator/machine/machine.h"

namespace fauxboard::behaviour {

/// The EEPROM image: one `path value` a line for every field marked stored. Lines it does not know are kept,
/// so that an older program does not lose what a newer one wrote.

/// Writes the stored fields whose path starts with `prefix` into the image, the rest of it stays, and hands
/// it to the store. False when the store failed; the image in memory has the new values all the same.
bool save_fields(machine::Machine& machine, std::string_view prefix);

/// Takes the fields whose path starts with `prefix` from the image; fields it does not hold stay as they are,
/// unreadable values are passed over.
void load_fields(machine::Machine& machine, std::string_view prefix);

/// The image of the machine as it stands: what `factory defaults` means right after the profile's defaults
/// were applied.
std::string make_image(const machine::Machine& machine);

/// Applies an image as if it were loaded, without touching the EEPROM (M502).
void apply_image(machine::Machine& machine, std::string_view image, std::string_view prefix);

}  // namespace fauxboard::behaviour
