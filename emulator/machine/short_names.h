#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/machine/storage.h"

namespace fauxboard::machine {

/// Whether `name` can stand on a FAT disk as it is, but for its case: eight characters, a dot and three at
/// most, none of those that are not allowed.
bool is_short_name(std::string_view name);

/// The names of eight and three characters that a FAT disk gives the entries of one folder, in their order:
/// "LONGNA~1.GCO" for "Long name.gcode".
std::vector<std::string> short_names(const std::vector<CardEntry>& entries);

/// Whether a board lists a file: its short ending begins with G and is no backup's.
bool is_printable(std::string_view short_name);

}  // namespace fauxboard::machine
