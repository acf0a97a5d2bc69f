#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

namespace fauxboard::link {

/// Messages that could not be sent yet, in order, as one run of bytes that still knows where messages end.
class PendingBytes {
  public:
    struct Dropped {
        std::uint64_t bytes = 0;
        std::uint64_t messages = 0;
    };

    bool empty() const { return head_ == data_.size(); }
    std::size_t size() const { return data_.size() - head_; }
    std::string_view view() const { return std::string_view(data_).substr(head_); }

    /// Keeps `message` if that makes at most `limit` bytes; false: nothing was kept.
    bool push(std::string_view message, std::size_t limit);
    /// The first `count` bytes (at most size()) are on their way.
    void consume(std::size_t count);
    /// Forgets everything, and says what that was.
    Dropped clear();

  private:
    std::string data_;
    std::size_t head_ = 0;            ///< data_ before this is sent
    std::uint64_t consumed_ = 0;      ///< bytes consumed since the beginning
    std::deque<std::uint64_t> ends_;  ///< where messages end, counted like consumed_
};

}  // namespace fauxboard::link
