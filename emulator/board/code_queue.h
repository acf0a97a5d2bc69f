#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace fauxboard::board {

/// What a board is still to say that stores no messages, but which of its frames are to go: their values are
/// those of the moment they leave. Of the frames that share a cell only what was said last is kept. Memory is
/// bounded.
class CodeQueue {
  public:
    CodeQueue(std::size_t room, std::size_t cells) : room_(room), cells_(cells) {}

    bool empty() const { return frames_.empty(); }
    /// False, and nothing stored, when it is full.
    bool push(std::size_t frame) {
        if (frames_.size() >= room_) {
            return false;
        }
        frames_.push_back(frame);
        return true;
    }
    /// The frame that goes next. Not to be called when empty.
    std::size_t take() {
        const std::size_t frame = frames_.front();
        frames_.erase(frames_.begin());
        return frame;
    }
    void keep(std::size_t cell, std::string_view message) { cells_[cell] = message; }
    std::string_view kept(std::size_t cell) const { return cells_[cell]; }
    void clear() { frames_.clear(); }

  private:
    std::size_t room_;
    std::vector<std::size_t> frames_;
    std::vector<std::string> cells_;
};

}  // namespace fauxboard::board
