#pragma once

#include <string>

#include "emulator/link/unique_fd.h"
#include "emulator/machine/services.h"

namespace fauxboard::host {

/// The bytes of a board's EEPROM chip in a file of its size, each written where it stands in the moment
/// that the board writes it: a kill at any moment leaves what the chip would hold.
class EepromCellsFile final : public machine::EepromCells {
  public:
    /// `file` need not exist: a fresh chip, all 0xFF. Throws link::HostError when it is no such file, or
    /// cannot be written.
    EepromCellsFile(std::string file, std::size_t bytes);

    std::optional<std::string> load() override;
    void store(std::size_t address, std::string_view bytes) override;

  private:
    void make() const;

    std::string file_;
    std::size_t bytes_;
    link::UniqueFd fd_;
};

}  // namespace fauxboard::host
