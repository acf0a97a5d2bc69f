#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "emulator/board/message_queue.h"
#include "protocol/framing.h"

namespace fauxboard::board {

/// Commands of one line that wait for their turn, with what was found out as they were read.
class CommandQueue {
  public:
    struct Head {
        std::int64_t number = 0;  ///< of its line
        bool numbered = false;
        bool acted = false;  ///< it was carried out as it came in; what is left is to acknowledge it
    };
    CommandQueue(std::uint32_t bytes, std::uint32_t commands)
        : queue_(bytes, commands), many_(commands / 8) {}

    bool empty() const { return queue_.empty(); }
    std::size_t size() const { return queue_.size(); }
    void clear() { queue_.clear(); }
    /// So many that a sender who can wait had better.
    bool crowded() const { return many_ != 0 && queue_.size() > many_; }
    /// False, and nothing kept, when there is no room.
    bool push(const Head& head, std::string_view command) {
        std::array<char, sizeof(Head) + protocol::max_line_bytes> packed;
        std::memcpy(packed.data(), &head, sizeof head);
        const std::size_t size = command.copy(packed.data() + sizeof head, protocol::max_line_bytes);
        return queue_.push({packed.data(), sizeof head + size});
    }
    /// Of the oldest; not to be called when empty. The text is valid until pop() or clear().
    Head head() const {
        Head head;
        std::memcpy(&head, queue_.front().data(), sizeof head);
        return head;
    }
    std::string_view command() const { return queue_.front().substr(sizeof(Head)); }
    void pop() { queue_.pop(); }

  private:
    MessageQueue queue_;
    std::uint32_t many_;
};

}  // namespace fauxboard::board
