#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace fauxboard::sliced {

/// A file, wherever it stands: on a card, on the disk, in memory.
class ByteSource {
  public:
    virtual ~ByteSource() = default;
    /// Bytes in it now; 0 when it is gone.
    virtual std::uint64_t size() const = 0;
    /// Reads from `offset` on, as many bytes as `out` holds or there are. Fewer at the end, and when the file
    /// changed or went meanwhile.
    virtual std::size_t read(std::uint64_t offset, std::span<char> out) const = 0;
};

}  // namespace fauxboard::sliced
