#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace fauxboard::screen {

/// A line as it came out of the buffer. The view lives until the callback returns.
struct IntakeLine {
    std::string_view text;
    bool cut = false;        ///< it was longer than the room for a line
    bool nul = false;        ///< a NUL ended the text before the line's end
    std::uint64_t came = 0;  ///< bytes that had come when it was whole; see LineIntake::came()
};

/// The receiving end of a screen's UART: a buffer that is looked into on a tick. What comes while it is full
/// is lost. CR (unless told otherwise) or LF ends a line, empty ones are skipped, half a line waits for ever.
/// Memory is bounded.
class LineIntake {
  public:
    explicit LineIntake(std::size_t room, bool lf_only = false) : room_(room), lf_only_(lf_only) {}

    void receive(std::string_view bytes) {
        const std::size_t fits =
            room_ - buffer_.size() < bytes.size() ? room_ - buffer_.size() : bytes.size();
        buffer_.append(bytes.substr(0, fits));
        came_ += fits;
        lost_ += bytes.size() - fits;
    }
    bool waiting() const { return !buffer_.empty(); }
    /// Bytes that have come so far, without those that were lost.
    std::uint64_t came() const { return came_; }

    /// Takes everything out; calls on_line(IntakeLine) for each line that is complete. Returns how many bytes
    /// were lost since the last time. on_line may call forget().
    template <class F>
    std::size_t drain(F&& on_line) {
        std::string bytes;
        bytes.swap(buffer_);
        const std::size_t lost = lost_;
        lost_ = 0;
        const std::uint64_t life = life_;
        std::uint64_t at = came_ - bytes.size();
        for (const char c : bytes) {
            ++at;
            if (c != '\n' && (lf_only_ || c != '\r')) {
                add(c);
                continue;
            }
            if (!partial_.empty() || nul_) {
                std::string text;
                text.swap(partial_);
                const IntakeLine line{text, cut_, nul_, at};
                cut_ = nul_ = false;
                on_line(line);
                if (life != life_) return lost;
            }
        }
        return lost;
    }

    /// The screen starts anew: everything is gone.
    void forget() {
        buffer_.clear();
        partial_.clear();
        cut_ = nul_ = false;
        lost_ = 0;
        ++life_;
    }

  private:
    void add(char c) {
        nul_ = nul_ || c == '\0';
        if (nul_) return;
        if (partial_.size() == room_) {
            cut_ = true;
            return;
        }
        partial_ += c;
    }

    std::size_t room_;
    bool lf_only_;
    std::string buffer_;
    std::string partial_;
    bool cut_ = false;
    bool nul_ = false;
    std::size_t lost_ = 0;
    std::uint64_t life_ = 0;
    std::uint64_t came_ = 0;
};

}  // namespace fauxboard::screen
