#include "emulator/link/line_speed.h"

// <termios.h> knows only speeds with a name, and cannot be had together with the header that knows all.
#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <sys/ioctl.h>

#include <cstdint>

namespace fauxboard::link {

namespace {

constexpr std::uint64_t frame_bits = 10;  // start, 8 of data, stop

/// The level of the line in one bit of what is sent; high where nothing is.
bool level(std::string_view bytes, std::uint64_t bit) {
    const std::uint64_t at = bit / frame_bits;
    const std::uint64_t in_frame = bit % frame_bits;
    if (at >= bytes.size() || in_frame == frame_bits - 1) return true;
    return in_frame != 0 && ((static_cast<unsigned char>(bytes[at]) >> (in_frame - 1)) & 1U) != 0;
}

}  // namespace

unsigned line_speed(int fd) {
    termios2 settings{};
    return ::ioctl(fd, TCGETS2, &settings) == 0 ? settings.c_ospeed : 0;
}

std::string as_heard(std::string_view bytes, unsigned sent_baud, unsigned heard_baud) {
    if (sent_baud == heard_baud || sent_baud == 0 || heard_baud == 0) return std::string(bytes);
    std::string heard;
    const std::uint64_t end = bytes.size() * frame_bits;
    // In halves of the receiver's bits, counted in the sender's: half a bit is sent / (2 * heard).
    const auto bit_at = [&](std::uint64_t edge, std::uint64_t halves) {
        return edge + halves * sent_baud / (2ULL * heard_baud);
    };
    for (std::uint64_t edge = 0; edge < end;) {
        if (const std::uint64_t middle = bit_at(edge, 1); level(bytes, middle)) {
            edge = middle;  // too short for a start bit
        } else {
            unsigned value = 0;
            for (unsigned i = 0; i < 8; ++i) {
                value |= static_cast<unsigned>(level(bytes, bit_at(edge, 2ULL * i + 3))) << i;
            }
            heard += static_cast<char>(value);
            edge = bit_at(edge, 2 * frame_bits - 1);  // the middle of the stop bit
        }
        // To where the line falls next.
        while (edge < end && !level(bytes, edge))
            ++edge;
        while (edge < end && level(bytes, edge))
            ++edge;
    }
    return heard;
}

}  // namespace fauxboard::link
