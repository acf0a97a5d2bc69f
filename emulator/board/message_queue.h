#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace fauxboard::board {

/// Messages in the order they came, in a fixed piece of memory: allocates once, with the first of them, then
/// never; a line that nobody speaks on weighs nothing. Full means refused, as in the small memory of a real
/// board.
class MessageQueue {
  public:
    MessageQueue(std::size_t bytes, std::size_t messages) : most_bytes_(bytes), most_messages_(messages) {}

    bool empty() const { return count_ == 0; }
    std::size_t size() const { return count_; }
    /// False, and nothing stored, when there is no room for the whole message.
    bool push(std::string_view message);
    /// The oldest message; valid until pop() or clear(). Not to be called when empty.
    std::string_view front() const {
        const Span& span = spans_[head_];
        return {bytes_.data() + span.from, span.size};
    }
    void pop();
    void clear() { head_ = count_ = 0; }

  private:
    struct Span {
        std::size_t from = 0;
        std::size_t size = 0;
    };
    std::size_t most_bytes_;
    std::size_t most_messages_;
    std::vector<char> bytes_;
    std::vector<Span> spans_;
    std::size_t head_ = 0;
    std::size_t count_ = 0;
};

}  // namespace fauxboard::board
