#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/link/unique_fd.h"
#include "emulator/machine/services.h"

namespace fauxboard::host {

/// Keeps the place of a job in a small file of two slots, written in turn: whenever the program is killed,
/// the slot not being written is whole. A keep() is one write() of some 300 bytes into the page cache, so a
/// kill of the program loses nothing; what a power cut of this computer leaves is up to its file system.
class JobPlaceFile final : public machine::JobPlaceStore {
  public:
    using OnTrouble = std::function<void(std::string_view sentence)>;

    /// `file` need not exist. Throws link::HostError when it cannot be opened for writing, is no plain file,
    /// holds what is not ours (which stays as it is), or belongs to a board that runs: two would write over
    /// each other, here and in the EEPROM beside.
    JobPlaceFile(std::string file, OnTrouble on_trouble);

    std::optional<std::string> load() override;
    void keep(std::string_view place) override;
    void drop() override;

    const std::string& file() const { return file_; }
    /// The file that goes with an EEPROM's: FILE.job, beside where that really is.
    static std::string beside(const std::string& eeprom);

    static constexpr std::size_t slot_bytes = 1024;

  private:
    void claim() const;
    bool is_ours() const;
    void write(std::string_view payload);

    std::string file_;
    OnTrouble on_trouble_;
    link::UniqueFd fd_;
    std::uint64_t sequence_ = 0;  ///< of the slot written last
    bool complained_ = false;
};

}  // namespace fauxboard::host
