#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "emulator/link/unique_fd.h"

namespace fauxboard::host {

class StyledLine;

/// Text for a person or a program, on a descriptor that may be slow, full or closed. All that the program
/// prints goes through here, so that nothing but printable text leaves (see plain_text.h).
class TextOutput {
  public:
    enum class WhenFull : std::uint8_t {
        leave_out,  ///< a log must never hold up the board: what nobody takes is lost
        wait,
    };
    /// Borrows `fd`. With `leave_out` no call ever waits, whatever the descriptor is and whoever shares it.
    explicit TextOutput(int fd, WhenFull when_full = WhenFull::leave_out);

    /// Writes one text, its line ends included, as a whole or not at all: the end of one of which the other
    /// side took the beginning only is kept, and comes before the next. False when it was left out.
    bool write(std::string_view text);
    bool write(const StyledLine& line);
    /// The same for what must come: what does not go now waits here, in front of all that is written later.
    /// Call flush() now and then.
    void keep(std::string_view text);
    /// Whether nothing waits any more.
    bool flush();
    /// Why the last text did not go, an errno; 0 while nothing was wrong but that nobody read.
    int error() const { return error_; }

    /// A terminal that shows colours, for a user who has not forbidden them (NO_COLOR).
    bool colours() const;
    /// Of the terminal that it goes to; 0 for anything else.
    std::size_t columns() const;
    std::uint64_t left_out() const { return left_out_; }

  private:
    bool write_plain(std::string_view text);
    std::size_t put(std::string_view text);
    bool wait_for_room();
    long write_some(std::string_view text) const;

    int fd_;
    WhenFull when_full_;
    bool is_socket_ = false;
    bool is_stream_ = false;  ///< a terminal or a pipe: its writes may block
    link::UniqueFd own_;      ///< the same one, opened again for us alone and not blocking
    std::string rest_;
    int error_ = 0;
    std::uint64_t left_out_ = 0;
};

}  // namespace fauxboard::host
