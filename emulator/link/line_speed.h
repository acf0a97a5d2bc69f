#pragma once

#include <string>
#include <string_view>

namespace fauxboard::link {

/// The speed that a terminal is set to, in bit/s, also one that has no name (250000); 0 where it cannot be
/// told.
unsigned line_speed(int fd);

/// What a new pseudo-terminal is set to before anybody chooses: it means nothing.
inline constexpr unsigned unset_speed = 38400;

/// What a receiver at `heard_baud` makes of bytes that are sent one right behind the other at `sent_baud`, 8
/// data bits, no parity, 1 stop bit: it waits for the line to fall, then looks at the middle of each of its
/// own bits. A stop bit that is none is not looked at, as by most receivers; the next byte begins where the
/// line falls again. At the same speed it is the same. At most 5 bytes for each of `bytes`.
std::string as_heard(std::string_view bytes, unsigned sent_baud, unsigned heard_baud);
inline constexpr std::size_t most_heard_per_byte = 5;

}  // namespace fauxboard::link
