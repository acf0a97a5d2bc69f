#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace fauxboard::machine {

struct Identity {
    std::string device_name, model, serial_number, firmware, volume_text, hardware;
};

/// A file or folder of the card that a profile carries within itself.
struct BuiltInEntry {
    std::string name;
    bool folder = false;
    std::string content;
    std::vector<BuiltInEntry> entries;
};

struct CardConfig {
    bool present = true;
    bool way_back = true;      ///< the list of a folder begins with the way back to its parent
    bool ignore_case = false;  ///< names are found whatever their case, as on a FAT disk
    unsigned max_listed = 64;  ///< entries told in one list; the A30 screen's table ends at 64
    std::vector<BuiltInEntry> entries;
};

/// What a profile can say about a machine of any kind; a kind derives from it and adds its own.
struct MachineConfig {
    virtual ~MachineConfig() = default;
    Identity identity;
    CardConfig card;
    bool udisk_port = false;
    std::size_t eeprom_bytes = 0;  ///< of a chip that is known byte by byte; 0: it keeps values
};

}  // namespace fauxboard::machine
