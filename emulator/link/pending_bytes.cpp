#include "emulator/link/pending_bytes.h"

#include <algorithm>

namespace fauxboard::link {

bool PendingBytes::push(std::string_view message, std::size_t limit) {
    if (message.size() > limit || size() > limit - message.size()) return false;
    data_.erase(0, head_);
    head_ = 0;
    data_.append(message);
    ends_.push_back(consumed_ + data_.size());
    return true;
}

void PendingBytes::consume(std::size_t count) {
    count = std::min(count, size());
    head_ += count;
    consumed_ += count;
    while (!ends_.empty() && ends_.front() <= consumed_)
        ends_.pop_front();
    if (empty()) {
        data_.clear();
        head_ = 0;
    }
}

PendingBytes::Dropped PendingBytes::clear() {
    const Dropped dropped{size(), ends_.size()};
    consume(size());
    return dropped;
}

}  // namespace fauxboard::link
