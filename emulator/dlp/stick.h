#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/sliced/byte_source.h"

namespace fauxboard::dlp {

/// An entry of a folder, as the stick has it.
struct StickEntry {
    std::string name;
    bool folder = false;
    std::uint64_t bytes = 0;
    std::int64_t modified_s = 0;  ///< since 1970, local time; 0 unknown
};

/// The USB stick. Paths are relative to its root and do not begin with '/'.
class Stick {
  public:
    virtual ~Stick() = default;
    /// A stick is in, and can be read.
    virtual bool present() const = 0;
    /// The entries of a folder, in the stick's order. False when there is no such folder.
    virtual bool list(const std::string& folder, std::vector<StickEntry>& out) const = 0;
    /// What stands at `path`; nothing when there is no such file.
    virtual std::optional<StickEntry> look(const std::string& path) const = 0;
    /// Null when there is no such file, or it cannot be read.
    virtual std::unique_ptr<sliced::ByteSource> open(const std::string& path) const = 0;
    virtual bool remove(const std::string& path) = 0;
};

}  // namespace fauxboard::dlp
