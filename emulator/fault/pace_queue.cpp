#include "emulator/fault/pace_queue.h"

#include <algorithm>

namespace fauxboard::fault {
namespace {

SimTime travel(std::size_t bytes, double bytes_per_s) {
    return bytes_per_s > 0 ? machine::from_seconds(static_cast<double>(bytes) / bytes_per_s) : SimTime{0};
}

}  // namespace

void PaceQueue::put(Piece piece, const Pace& pace) {
    const SimTime start = std::max(free_, piece.time + pace.delay);
    free_ = start + travel(piece.bytes.size(), pace.bytes_per_s);
    held_ += piece.bytes.size();
    waiting_.push_back({std::move(piece), start, pace.bytes_per_s, 0});
}

std::size_t PaceQueue::portion_end(const Waiting& item) {
    const std::size_t size = item.piece.bytes.size();
    if (item.bytes_per_s <= 0) {
        return size;
    }
    const auto step = static_cast<std::size_t>(item.bytes_per_s * machine::to_seconds(portion));
    return std::min(size, item.done + std::max<std::size_t>(1, step));
}

SimTime PaceQueue::due() const {
    if (waiting_.empty()) {
        return machine::never;
    }
    const Waiting& next = waiting_.front();
    return next.start + travel(portion_end(next), next.bytes_per_s);
}

Piece PaceQueue::take() {
    return take_to(portion_end(waiting_.front()), due());
}

Piece PaceQueue::take_rest() {
    return take_to(waiting_.front().piece.bytes.size(), due());
}

Piece PaceQueue::take_to(std::size_t end, SimTime time) {
    Waiting& next = waiting_.front();
    Piece out{time, next.piece.bytes.substr(next.done, end - next.done), next.piece.first && next.done == 0,
              next.piece.gap};
    held_ -= out.bytes.size();
    next.done = end;
    if (next.done == next.piece.bytes.size()) {
        waiting_.pop_front();
    }
    return out;
}

}  // namespace fauxboard::fault
