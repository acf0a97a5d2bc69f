#include "emulator/board/message_queue.h"

#include <optional>

namespace fauxboard::board {

bool MessageQueue::push(std::string_view message) {
    if (count_ == most_messages_) {
        return false;
    }
    if (spans_.empty()) {
        bytes_.resize(most_bytes_);
        spans_.resize(most_messages_);
    }
    // A message lies in one piece, so that front() is a view: behind the newest one, or, when that leaves no
    // room before the end, at the start.
    std::optional<std::size_t> place;
    if (count_ == 0) {
        place = 0;
    } else {
        const Span& oldest = spans_[head_];
        const Span& newest = spans_[(head_ + count_ - 1) % spans_.size()];
        const std::size_t after = newest.from + newest.size;
        if (newest.from >= oldest.from) {
            place = after + message.size() <= bytes_.size() ? after : 0;
            if (*place == 0 && message.size() > oldest.from) {
                return false;
            }
        } else if (after + message.size() <= oldest.from) {
            place = after;
        }
    }
    if (!place || *place + message.size() > bytes_.size()) {
        return false;
    }
    message.copy(bytes_.data() + *place, message.size());
    spans_[(head_ + count_) % spans_.size()] = {*place, message.size()};
    ++count_;
    return true;
}

void MessageQueue::pop() {
    head_ = (head_ + 1) % spans_.size();
    --count_;
}

}  // namespace fauxboard::board
