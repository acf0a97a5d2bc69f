#pragma once

#include <string>
#include <string_view>

#include "emulator/behaviour/variables.h"
#include "emulator/machine/machine.h"

namespace fauxboard::behaviour {

/// The EEPROM image: one `path value` a line for every field marked stored. Lines it does not know are kept,
/// so that an older program does not lose what a newer one wrote. The profile's variables that are marked
/// stored are among them, as `var.NAME`, where `kept` gives them.

/// Writes the stored fields whose path starts with `prefix` into the image, the rest of it stays, and hands
/// it to the store. False when the store failed; the image in memory has the new values all the same.
bool save_fields(machine::Machine& machine, std::string_view prefix, const Variables* kept = nullptr);

/// Takes the fields whose path starts with `prefix` from the image; fields it does not hold stay as they are,
/// unreadable values are passed over.
void load_fields(machine::Machine& machine, std::string_view prefix, const Variables* kept = nullptr);

/// The image of the machine as it stands: what `factory defaults` means right after the profile's defaults
/// were applied.
std::string make_image(const machine::Machine& machine, const Variables* kept = nullptr);

/// Applies an image as if it were loaded, without touching the EEPROM (M502).
void apply_image(machine::Machine& machine, std::string_view image, std::string_view prefix,
                 const Variables* kept = nullptr);

}  // namespace fauxboard::behaviour
