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
    bool way_back = true;       ///< the list of a folder begins with the way back to its parent
    bool ignore_case = false;   ///< names are found whatever their case, as on a FAT disk
    unsigned max_listed = 64;   ///< entries told in one list; the A30 screen's table ends at 64
    bool newest_first = false;  ///< in order of date, so that a list that is cut keeps the newest
    bool folders = true;        ///< folders are shown
    /// Only entries in whose 8.3 name one of these stands are shown; empty: all are.
    std::vector<std::string> only;
    unsigned name_bytes = 0;  ///< a longer name is shown as its 8.3 name; 0: none is
    /// A file is found by what its list shows, in any case of letters, and not by a path.
    bool by_list = false;
    /// What a file's name ends with in a request: what stands behind the first of them is no part of it;
    /// empty: all is.
    std::vector<std::string> name_ends;
    double rescan_s = 0;  ///< so long after power-on the card's detector has it read in once more; 0: never
    std::vector<BuiltInEntry> entries;
};

/// What a profile can say about a machine of any kind; a kind derives from it and adds its own.
struct MachineConfig {
    virtual ~MachineConfig() = default;
    Identity identity;
    CardConfig card;
    bool udisk_port = false;
    /// A finished job is shown as an idle board, with its progress, until the profile closes it, and its file
    /// has to be selected anew.
    bool ends_idle = false;
};

}  // namespace fauxboard::machine
