#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "emulator/machine/machine.h"

namespace fauxboard::testing {

/// An EEPROM that outlives its board, and can be made to fail.
struct MemoryEeprom final : machine::EepromStore {
    std::optional<std::string> image;
    int saves = 0;
    bool works = true;
    std::optional<std::string> load() override { return image; }
    bool save(std::string_view text) override {
        ++saves;
        if (works) {
            image = std::string(text);
        }
        return works;
    }
};

}  // namespace fauxboard::testing
