#pragma once

#include <functional>
#include <string>

#include "emulator/machine/machine.h"

namespace fauxboard::host {

/// The board's EEPROM in a text file: a line with the version, the image, a line with its checksum. A kill or
/// a power cut at any moment leaves the old file or the new one whole.
class EepromFile final : public machine::EepromStore {
  public:
    static constexpr std::size_t max_bytes = 1024UL * 1024;

    /// Told what a person must know: the file was broken and is now called so; it could not be written.
    using OnTrouble = std::function<void(std::string_view sentence)>;

    /// `file` need not exist: a fresh EEPROM. Throws link::HostError when it could not be written or read.
    EepromFile(const std::string& file, OnTrouble on_trouble);

    /// A file that is torn or was edited is renamed to FILE.broken (.broken.2, ...), so that nothing is lost,
    /// and the EEPROM is fresh.
    std::optional<std::string> load() override;
    bool save(std::string_view image) override;

    const std::string& file() const { return file_; }
    /// Where the file really is: a symlink stays one, and what it points to is replaced.
    static std::string real_path(const std::string& file);

  private:
    void put_aside(std::string_view why);
    void sweep() const;
    int write_new(std::string& name, std::string_view text) const;

    std::string file_;
    std::string folder_;
    OnTrouble on_trouble_;
};

/// The file's text for an image, and back; nothing when the text is not whole.
std::string eeprom_text(std::string_view image);
std::optional<std::string> eeprom_image(std::string_view text);

}  // namespace fauxboard::host
