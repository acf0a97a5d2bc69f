#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "emulator/link/link.h"

namespace fauxboard::host {

/// One end of a tapped line, as the command line names it.
struct TapEnd {
    enum class Kind : std::uint8_t {
        port,  ///< "DEV": a serial port, or somebody's pseudo-terminal; "auto" for the only USB adapter
        pty,   ///< "pty" or "pty=LINK": one of our own
        tcp_connect,  ///< "tcp:HOST:PORT"
        tcp_listen,   ///< "tcp-listen:HOST:PORT"
    };
    Kind kind = Kind::pty;
    std::string name;  ///< device, link name or address; may be empty for a pty
    bool operator==(const TapEnd&) const = default;
};

/// Throws LinkError, with the forms that there are, for an empty one.
TapEnd parse_tap_end(std::string_view text);

/// `baud` in bit/s, for ports. Throws LinkError for an address that is none.
std::unique_ptr<link::Link> make_tap_link(link::EventLoop& loop, const TapEnd& end, unsigned baud);

}  // namespace fauxboard::host
