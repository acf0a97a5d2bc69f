#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace fauxboard::host {

/// Text of whatever origin (the line, the network, a file's name, a profile) as it may go to a terminal: what
/// a terminal would obey, or show so as to deceive, stands as \xHH, byte by byte. That is all control
/// characters (also those that UTF-8 spells with two bytes), marks that turn the direction of writing, and
/// bytes that are no UTF-8. Line feeds and tabs stay.
std::string plain_text(std::string_view text);

/// The same for what is to stay within one line: line feeds are spelled out as well.
std::string plain_line(std::string_view text);

/// What a part of a line for people is, and so how it is coloured.
enum class Ink : std::uint8_t { plain, incoming, outgoing, warning, error, faint };

/// A line for people, made of parts. The only way in which an escape sequence of ours reaches a terminal; no
/// part brings one along.
class StyledLine {
  public:
    explicit StyledLine(bool colours) : colours_(colours) {}

    /// Adds one part, padded with blanks to `width` characters (UTF-8 counted as such).
    StyledLine& add(std::string_view part, Ink ink = Ink::plain, std::size_t width = 0);
    /// The line takes the place of what stands in the terminal's: for progress, on terminals only.
    StyledLine& over() {
        bytes_ += "\r\x1b[K";
        return *this;
    }
    /// Begins the next line.
    StyledLine& end() {
        bytes_ += '\n';
        return *this;
    }
    const std::string& bytes() const { return bytes_; }

  private:
    bool colours_;
    std::string bytes_;
};

}  // namespace fauxboard::host
