#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "emulator/machine/sim_time.h"

namespace fauxboard::fault {

using machine::SimTime;

/// Some bytes of a line, with the time they came.
struct Piece {
    SimTime time{0};
    std::string bytes;
    bool first = true;  ///< the start of a line is in it
    bool gap = false;   ///< line ends and NULs between lines: no line at all
};

/// Cuts a byte stream into lines with their line ends, whatever chunks it comes in, and loses nothing.
///
/// LF, CR LF and CR alone end a line; line ends and NULs between lines are gaps. A line that stalls for
/// `patience` or grows beyond `longest` goes on in parts: the rest of it is passed on as it comes.
class LineCutter {
  public:
    static constexpr SimTime patience{100'000};
    static constexpr std::size_t longest = 4096;  ///< bytes, line end not counted; also all that is ever held

    /// Calls on_piece(Piece&&) for all that is complete.
    template <class F>
    void feed(SimTime now, std::string_view bytes, F&& on_piece);

    /// Lets go what is held, as a part of a line.
    template <class F>
    void flush(F&& on_piece) {
        if (!held_.empty()) {
            emit(last_, on_piece);
        }
        in_line_ = in_line_ && !cr_;
        first_ = !in_line_;
        cr_ = false;
    }

    /// Bytes went past the cutter, when nothing was held: where the next line starts is remembered.
    void passed(std::string_view bytes) {
        in_line_ = ends_in_line(bytes, in_line_);
        first_ = !in_line_;
    }

    /// When flush() is to be called; never, if nothing is held.
    SimTime due() const { return held_.empty() ? machine::never : last_ + patience; }
    /// The start of the line at hand has been let go, its end has not come.
    bool in_rest() const { return in_line_ && !first_; }
    std::size_t held() const { return held_.size(); }

    /// Whether the stream stands inside a line after `bytes`, if it stood so before as `in_line` says.
    static bool ends_in_line(std::string_view bytes, bool in_line) {
        const std::size_t last = bytes.find_last_not_of('\0');
        if (last == std::string_view::npos) {
            return in_line;
        }
        return bytes[last] != '\r' && bytes[last] != '\n';
    }

    static constexpr std::string_view gaps{"\r\n\0", 3};
    static constexpr std::string_view line_ends{"\r\n", 2};

  private:
    template <class F>
    void emit(SimTime time, F&& on_piece) {
        on_piece(Piece{time, std::exchange(held_, {}), first_, false});
    }
    template <class F>
    void finish(SimTime now, F&& on_piece) {
        emit(now, on_piece);
        in_line_ = cr_ = false;
        first_ = true;
    }
    template <class F>
    void hold(SimTime now, std::string_view text, F&& on_piece);

    std::string held_;
    SimTime last_{0};
    bool in_line_ = false;
    bool first_ = true;  ///< nothing of the line has been let go yet
    bool cr_ = false;    ///< held_ ends in a CR that an LF may follow
};

template <class F>
void LineCutter::hold(SimTime now, std::string_view text, F&& on_piece) {
    if (first_ && text.size() > longest - held_.size()) {
        const std::size_t room = longest - held_.size();
        held_.append(text.substr(0, room));
        emit(now, on_piece);
        first_ = false;
        text.remove_prefix(room);
    }
    held_.append(text);
}

template <class F>
void LineCutter::feed(SimTime now, std::string_view bytes, F&& on_piece) {
    last_ = now;
    while (!bytes.empty()) {
        if (cr_) {
            if (bytes.front() == '\n') {
                held_ += '\n';
                bytes.remove_prefix(1);
            }
            finish(now, on_piece);
        } else if (!in_line_) {
            const std::size_t gap = std::min(bytes.find_first_not_of(gaps), bytes.size());
            if (gap != 0) {
                on_piece(Piece{now, std::string(bytes.substr(0, gap)), true, true});
            }
            bytes.remove_prefix(gap);
            in_line_ = !bytes.empty();
        } else {
            const std::size_t end = std::min(bytes.find_first_of(line_ends), bytes.size());
            hold(now, bytes.substr(0, end), on_piece);
            bytes.remove_prefix(end);
            if (!bytes.empty()) {
                held_ += bytes.front();
                cr_ = bytes.front() == '\r';
                bytes.remove_prefix(1);
                if (!cr_) {
                    finish(now, on_piece);
                }
            }
        }
    }
    if (in_line_ && !first_ && !cr_ && !held_.empty()) {
        emit(now, on_piece);
    }
}

}  // namespace fauxboard::fault
