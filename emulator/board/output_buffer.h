#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

namespace fauxboard::board {

/// Bytes on their way out. Messages are composed at its end, where they stay, instead of being copied there.
class OutputBuffer {
  public:
    explicit OutputBuffer(std::size_t capacity)
        : bytes_(std::make_unique_for_overwrite<char[]>(capacity)), capacity_(capacity) {}

    bool empty() const { return size_ == 0; }
    std::size_t size() const { return size_; }
    std::string_view view() const { return {bytes_.get(), size_}; }
    void clear() { size_ = 0; }

    /// Room for `bytes` more, behind what is there: valid until the next call. It counts once grow() is told.
    std::span<char> room(std::size_t bytes) {
        if (capacity_ - size_ < bytes) {
            enlarge(size_ + bytes);
        }
        return {bytes_.get() + size_, bytes};
    }
    /// `bytes` of the room have been filled.
    void grow(std::size_t bytes) { size_ += bytes; }
    void append(std::string_view bytes) {
        std::copy(bytes.begin(), bytes.end(), room(bytes.size()).begin());
        grow(bytes.size());
    }

  private:
    void enlarge(std::size_t least) {
        const std::size_t capacity = std::max(least, 2 * capacity_);
        auto larger = std::make_unique_for_overwrite<char[]>(capacity);
        std::copy_n(bytes_.get(), size_, larger.get());
        bytes_ = std::move(larger);
        capacity_ = capacity;
    }

    std::unique_ptr<char[]> bytes_;
    std::size_t capacity_;
    std::size_t size_ = 0;
};

}  // namespace fauxboard::board
