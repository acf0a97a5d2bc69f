#pragma once

#include <functional>
#include <string>

#include "emulator/link/unique_fd.h"
#include "emulator/machine/services.h"

namespace fauxboard::host {

/// The bytes of a board's EEPROM chip in a file of its size, each written where it stands in the moment
/// that the board writes it: a kill at any moment leaves what the chip would hold.
class EepromCellsFile final : public machine::EepromCells {
  public:
    /// Told when a cell could not be written, once until one could again.
    using OnTrouble = std::function<void(std::string_view sentence)>;

    /// `file` need not exist: a fresh chip, all 0xFF. Throws link::HostError when it is no such file, cannot
    /// be written, or is the chip of another board that runs.
    EepromCellsFile(std::string file, std::size_t bytes, OnTrouble on_trouble);

    std::optional<std::string> load() override;
    void store(std::size_t address, std::string_view bytes) override;

  private:
    void make() const;

    std::string file_;
    std::size_t bytes_;
    OnTrouble on_trouble_;
    bool complained_ = false;
    link::UniqueFd fd_;
};

}  // namespace fauxboard::host
