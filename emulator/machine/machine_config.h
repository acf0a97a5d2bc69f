#pragma once

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
};

}  // namespace fauxboard::machine
