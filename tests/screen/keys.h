#pragma once

#include "emulator/screen/console.h"

namespace fauxboard::testing {

inline screen::Key key(screen::Key::Kind kind, char character = '\0') {
    screen::Key out;
    out.kind = kind;
    out.character = character;
    return out;
}
inline screen::Key letter(char c) {
    return key(screen::Key::Kind::character, c);
}

}  // namespace fauxboard::testing
