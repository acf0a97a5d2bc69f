#pragma once

#include <cstdint>
#include <string_view>

namespace fauxboard::host {

/// Text for a person or a program, on a descriptor that may be slow, full or closed.
class TextOutput {
  public:
    enum class WhenFull : std::uint8_t {
        leave_out,  ///< a log must never hold up the board: what nobody takes is lost
        wait,
    };
    /// Borrows `fd`.
    explicit TextOutput(int fd, WhenFull when_full = WhenFull::leave_out) : fd_(fd), when_full_(when_full) {}

    /// Writes one text, its line ends included, as a whole or not at all; should the other side stop reading
    /// in the middle of a very long one, the next starts on a new line. False when it was left out.
    bool write(std::string_view text);
    /// A terminal that shows colours, for a user who has not forbidden them (NO_COLOR).
    bool colours() const;
    std::uint64_t left_out() const { return left_out_; }

  private:
    bool write_all(std::string_view text);
    bool ready() const;

    int fd_;
    WhenFull when_full_;
    bool torn_ = false;
    std::uint64_t left_out_ = 0;
};

}  // namespace fauxboard::host
