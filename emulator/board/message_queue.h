#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

namespace fauxboard::board {

/// Messages in the order they came, in a fixed piece of memory: allocates with the first message, then never;
/// a line that nobody speaks on costs nothing. Full means refused, as in the small memory of a real board.
class MessageQueue {
  public:
    MessageQueue(std::uint32_t bytes, std::uint32_t messages) : most_bytes_(bytes), most_(messages) {}

    bool empty() const { return count_ == 0; }
    std::size_t size() const { return count_; }
    /// False, and nothing stored, when there is no room for the whole message.
    bool push(std::string_view message);
    /// The oldest message; valid until pop() or clear(). Not to be called when empty.
    std::string_view front() const {
        const Span& span = spans_[head_];
        return {bytes_.get() + span.from, span.size};
    }
    void pop();
    void clear() { head_ = count_ = 0; }

  private:
    struct Span {
        std::uint32_t from;
        std::uint32_t size;
    };
    std::optional<std::uint32_t> place_for(std::size_t size) const;

    std::uint32_t most_bytes_;
    std::uint32_t most_;
    std::unique_ptr<char[]> bytes_{};
    std::unique_ptr<Span[]> spans_{};
    std::uint32_t head_ = 0;
    std::uint32_t count_ = 0;
};

}  // namespace fauxboard::board
