#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "emulator/sliced/byte_source.h"
#include "emulator/sliced/cipher.h"

namespace fauxboard::sliced {

/// Part of a file, byte by byte, through a small buffer.
class ByteWindow {
  public:
    static constexpr std::size_t buffer_bytes = 4096;

    ByteWindow(const ByteSource& source, std::uint64_t offset, std::uint64_t bytes, Cipher cipher)
        : source_(&source), offset_(offset), left_(bytes), cipher_(cipher) {}

    /// The next byte, 0 to 255; -1 at the end, and when the file gives no more.
    int next() {
        if (at_ == filled_ && !fill()) {
            return -1;
        }
        return static_cast<unsigned char>(buffer_[at_++]);
    }
    bool at_end() { return at_ == filled_ && !fill(); }
    /// Bytes taken so far.
    std::uint64_t taken() const { return fetched_ - (filled_ - at_); }

  private:
    bool fill() {
        const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(left_, buffer_.size()));
        at_ = 0;
        filled_ = wanted == 0 ? 0 : source_->read(offset_ + fetched_, std::span(buffer_).first(wanted));
        left_ = filled_ == wanted ? left_ - filled_ : 0;  // a file that gave less than it has is over
        fetched_ += filled_;
        cipher_.apply(std::span(buffer_).first(filled_));
        return filled_ != 0;
    }

    const ByteSource* source_;
    std::uint64_t offset_;
    std::uint64_t left_;
    std::uint64_t fetched_ = 0;
    Cipher cipher_;
    std::array<char, buffer_bytes> buffer_{};
    std::size_t at_ = 0;
    std::size_t filled_ = 0;
};

}  // namespace fauxboard::sliced
