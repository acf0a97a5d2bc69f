#pragma once

#include <string>

#include "emulator/screen/display.h"

namespace fauxboard::touch {

/// What a key makes of the text in the display of a number being typed.
struct NumberEntry {
    std::string text = "0";
    bool fresh = true;      ///< the first digit replaces what stands there
    bool fractions = true;  ///< a dot may be typed
    std::size_t most = 10;  ///< characters

    void start(double value, int decimals, std::size_t most_characters);
    void press(screen::EntryKey key, char digit);
    double number() const;
};

}  // namespace fauxboard::touch
