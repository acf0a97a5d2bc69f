#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/behaviour/profile.h"

namespace fauxboard::board {

/// The receiving end of a board whose ring and lines are small: what comes while the ring is full is lost,
/// until the next tick has emptied it; a line of full length is cut, and the rest is the next one; a comment
/// is left out; a NUL ends a line's text, so that behind one that stands at its start nothing is seen of the
/// line. CR or LF ends a line, empty ones are skipped. Memory is bounded.
class RingIntake {
  public:
    /// `tick` counts the times the ring was emptied so far; without one, it is as large as need be. Calls
    /// on_line(std::string_view) for each line; it may call reset(). Returns how many of the bytes were lost.
    template <class F>
    std::size_t feed(std::optional<std::uint64_t> tick, std::string_view bytes,
                     const behaviour::LineConfig& line, F&& on_line) {
        if (tick != tick_) {
            tick_ = tick;
            used_ = 0;
        }
        const bool small = tick && line.ring_bytes != 0;
        const std::size_t room =
            small ? line.ring_bytes - std::min<std::size_t>(used_, line.ring_bytes) : bytes.size();
        const std::size_t fits = std::min(bytes.size(), room);
        used_ += fits;
        for (const char c : bytes.substr(0, fits)) {
            const bool end = c == '\r' || c == '\n';
            if (!end) {
                add(c, line);
            }
            if (end || text_.size() == line.line_bytes) {
                hand_over(end, on_line);
            }
        }
        return bytes.size() - fits;
    }

    void reset() {
        text_.clear();
        over_ = false;
        used_ = 0;
    }
    std::uint64_t nuls() const { return nuls_; }

  private:
    void add(char c, const behaviour::LineConfig& line) {
        nuls_ += c == '\0' ? 1 : 0;
        over_ = over_ || c == '\0' || (line.comment != 0 && c == line.comment);
        if (!over_) {
            text_ += c;
        }
    }
    template <class F>
    void hand_over(bool end, F&& on_line) {
        over_ = over_ && !end;
        if (!text_.empty()) {
            std::string text;
            text.swap(text_);
            on_line(std::string_view(text));
        }
    }

    std::string text_;
    bool over_ = false;  ///< the rest of the line is not looked at
    std::optional<std::uint64_t> tick_;
    std::size_t used_ = 0;
    std::uint64_t nuls_ = 0;
};

}  // namespace fauxboard::board
