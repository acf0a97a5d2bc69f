#pragma once

#include <string>

namespace fauxboard::test {

/// The table of tools/fauxboard.lua, made from the catalogue: "local codes = {...}".
std::string dissector_table();

}  // namespace fauxboard::test
