#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace fauxboard::machine {

class Volume;

/// Where the board's EEPROM lives. The image is bytes: of most kinds text, one `path value` a line. Who
/// stores it need not read it.
class EepromStore {
  public:
    virtual ~EepromStore() = default;
    /// The stored image; nothing when none was ever stored or it is broken.
    virtual std::optional<std::string> load() = 0;
    /// Stores the whole image so that a kill at any moment leaves the old one or the new one. False when it
    /// could not.
    virtual bool save(std::string_view image) = 0;
};

/// The EEPROM of a board that is known byte by byte, as the chip has it.
class EepromCells {
  public:
    virtual ~EepromCells() = default;
    /// All its bytes; nothing when it is fresh.
    virtual std::optional<std::string> load() = 0;
    /// Some bytes have other values from now on. Whatever happens meanwhile, each has its old or its new one,
    /// and none has its new one before those ahead of it have.
    virtual void store(std::size_t address, std::string_view bytes) = 0;
};

/// Where the place of a job outlives the board. What the bytes say is the machine's business; more
/// than 900 of them may count as none. keep() is called for every move: it must be quick, and a kill at any
/// moment must leave the place kept before or the new one.
class JobPlaceStore {
  public:
    virtual ~JobPlaceStore() = default;
    /// What was kept last; nothing when it was dropped, or never kept, or is broken.
    virtual std::optional<std::string> load() = 0;
    virtual void keep(std::string_view place) = 0;
    virtual void drop() = 0;
};

/// What the world lends to a machine. Everything may be null: no such disk, EEPROM in memory only.
struct Services {
    Volume* sd = nullptr;
    Volume* udisk = nullptr;
    EepromStore* eeprom = nullptr;
    EepromCells* eeprom_cells = nullptr;  ///< instead, where MachineConfig::eeprom_bytes says so
    JobPlaceStore* job_place = nullptr;
};

}  // namespace fauxboard::machine
