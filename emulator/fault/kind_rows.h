#pragma once

// The rows of the table of kinds, each in the file of its name. Private to this folder.

#include "emulator/fault/kind.h"

namespace fauxboard::fault::rows {

inline constexpr double one_ms = 1e3;
inline constexpr double one_s = 1e6;
inline constexpr double one_hour = 3600e6;

extern const Kind drop;
extern const Kind garble;
extern const Kind duplicate;
extern const Kind delay;
extern const Kind slow;
extern const Kind cut;
extern const Kind merge;
extern const Kind nul_burst;
extern const Kind stray_ok;
extern const Kind wrong_checksum;
extern const Kind silence;
extern const Kind disconnect;

}  // namespace fauxboard::fault::rows
