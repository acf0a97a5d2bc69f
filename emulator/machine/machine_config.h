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
    bool way_back = true;       ///< the list of a folder begins with the way back to its parent
    bool ignore_case = false;   ///< names are found whatever their case, as on a FAT disk
    bool short_names = false;   ///< files are listed, and named, with eight and three characters
    bool long_names = true;     ///< where they are, the long names are taken as well
    double found_s = 0;         ///< after power-on the board tells then that a card is there; 0: it does not
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

/// The lines that are spoken as a host speaks.
struct HostConfig {
    /// A command that takes longer than this raises `host.busy`, and again each time; 0: never.
    double busy_s = 2;
    unsigned queue_lines = 4;  ///< commands that a host believes to have room for (advanced acknowledgements)
    unsigned line_chars = 511;  ///< of a line that count; the rest is dropped
    /// A line with the last good number, or the one before, is passed over without a word (Marlin 2.1: it was
    /// on its way when it was asked for again); without this it is asked for again.
    bool drops_repeated = false;
    bool judges_unnumbered = false;  ///< a line with a checksum must have a number
    bool first_star_ends = false;    ///< a command ends at its first star, not at that of its checksum
    bool numbers_uploads = false;    ///< what is written to a file (M28) must be numbered
    /// Commands that are carried out at once are looked for in every byte that comes in, numbered or not.
    bool emergency_parser = false;
};

/// What a profile can say about a machine of any kind; a kind derives from it and adds its own.
struct MachineConfig {
    virtual ~MachineConfig() = default;
    Identity identity;
    CardConfig card;
    HostConfig host;
    bool udisk_port = false;
    /// A finished job is shown as an idle board, with its progress, until the profile closes it, and its file
    /// has to be selected anew.
    bool ends_idle = false;
    std::size_t eeprom_bytes = 0;  ///< of a chip that is known byte by byte; 0: it keeps values
};

}  // namespace fauxboard::machine
