#pragma once

#include <string>

#include "emulator/machine/storage.h"
#include "emulator/sliced/byte_source.h"

namespace fauxboard::machine {

/// A file of a disk, for the readers of its format. Keeps a reference to the disk and nothing open.
class DiskSource final : public sliced::ByteSource {
  public:
    DiskSource(const Volume& volume, std::string path) : volume_(volume), path_(std::move(path)) {}
    std::uint64_t size() const override {
        std::uint64_t bytes = 0;
        return volume_.look(path_, bytes) == Volume::Kind::file ? bytes : 0;
    }
    std::size_t read(std::uint64_t offset, std::span<char> out) const override {
        return volume_.read(path_, offset, out).value_or(0);
    }

  private:
    const Volume& volume_;
    std::string path_;
};

}  // namespace fauxboard::machine
