#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace fauxboard::host {

/// Cuts a stream into lines that still have their ends, and loses no byte: the pieces, one after the other,
/// are the stream. A line ends behind LF, or behind CR where no LF follows. A line of more than `max_piece`
/// bytes comes in several pieces.
class TapCutter {
  public:
    static constexpr std::size_t max_piece = 8192;

    /// What to do with a CR while it is not known whether LF follows.
    enum class LoneCr : std::uint8_t {
        ends,   ///< the line, at once; an LF that comes later is a piece of its own
        waits,  ///< for the next byte, or for flush()
    };
    explicit TapCutter(LoneCr lone_cr) : lone_cr_(lone_cr) {}

    /// Calls take(std::string_view) for each piece that is complete.
    template <class Take>
    void feed(std::string_view bytes, Take&& take) {
        while (!bytes.empty()) {
            if (ends_in_cr() && bytes.front() != '\n') {
                flush(take);
            }
            const std::size_t mark = bytes.find_first_of("\r\n");
            const std::size_t whole = mark == std::string_view::npos ? bytes.size() : mark + 1;
            const std::size_t length = std::min(whole, max_piece - piece_.size());
            piece_.append(bytes.substr(0, length));
            bytes.remove_prefix(length);
            if (piece_.back() == '\n' || piece_.size() == max_piece) {
                flush(take);
            }
        }
        if (lone_cr_ == LoneCr::ends && ends_in_cr()) {
            flush(take);
        }
    }

    /// What there is of an unfinished line is a piece, too.
    template <class Take>
    void flush(Take&& take) {
        if (!piece_.empty()) {
            take(std::string_view(piece_));
            piece_.clear();
        }
    }

    bool empty() const { return piece_.empty(); }

  private:
    bool ends_in_cr() const { return !piece_.empty() && piece_.back() == '\r'; }

    LoneCr lone_cr_;
    std::string piece_;
};

}  // namespace fauxboard::host
