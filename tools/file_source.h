#pragma once

#include <string>

#include "emulator/link/unique_fd.h"
#include "emulator/sliced/byte_source.h"

namespace fauxboard::tools {

/// A file of this computer.
class FileSource final : public sliced::ByteSource {
  public:
    /// Throws link::HostError when it is no regular file, or cannot be read.
    explicit FileSource(const std::string& path);
    std::uint64_t size() const override;
    std::size_t read(std::uint64_t offset, std::span<char> out) const override;

  private:
    link::UniqueFd fd_;
};

}  // namespace fauxboard::tools
