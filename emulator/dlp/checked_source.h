#pragma once

#include "emulator/sliced/byte_source.h"

namespace fauxboard::dlp {

/// A file of the stick that notices when a read brings less than there is to be had.
class CheckedSource final : public sliced::ByteSource {
  public:
    explicit CheckedSource(const sliced::ByteSource& source) : source_(source), bytes_(source.size()) {}
    std::uint64_t size() const override { return source_.size(); }
    std::size_t read(std::uint64_t offset, std::span<char> out) const override {
        const std::size_t got = source_.read(offset, out);
        failed_ = failed_ || (got < out.size() && offset + got < bytes_);
        return got;
    }
    bool failed() const { return failed_; }

  private:
    const sliced::ByteSource& source_;
    std::uint64_t bytes_;  ///< when it was opened: a stick that goes has none
    mutable bool failed_ = false;
};

}  // namespace fauxboard::dlp
