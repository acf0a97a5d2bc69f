#include "emulator/board/message_queue.h"

namespace fauxboard::board {

/// A message lies in one piece, so that front() is a view: behind the newest one, or, when that leaves no
/// room before the end, at the start.
std::optional<std::uint32_t> MessageQueue::place_for(std::size_t size) const {
    if (count_ == most_ || size > most_bytes_) {
        return std::nullopt;
    }
    if (count_ == 0) {
        return 0;
    }
    const Span& oldest = spans_[head_];
    const Span& newest = spans_[(head_ + count_ - 1) % most_];
    const std::uint32_t after = newest.from + newest.size;
    const bool around = newest.from < oldest.from;
    if (after + size <= (around ? oldest.from : most_bytes_)) {
        return after;
    }
    return !around && size <= oldest.from ? std::optional<std::uint32_t>(0) : std::nullopt;
}

bool MessageQueue::push(std::string_view message) {
    const std::optional<std::uint32_t> place = place_for(message.size());
    if (!place) {
        return false;
    }
    if (bytes_ == nullptr) {
        bytes_ = std::make_unique_for_overwrite<char[]>(most_bytes_);
        spans_ = std::make_unique_for_overwrite<Span[]>(most_);
    }
    message.copy(bytes_.get() + *place, message.size());
    spans_[(head_ + count_) % most_] = {*place, static_cast<std::uint32_t>(message.size())};
    ++count_;
    return true;
}

void MessageQueue::pop() {
    head_ = (head_ + 1) % most_;
    --count_;
}

}  // namespace fauxboard::board
