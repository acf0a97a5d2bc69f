#pragma once

#include <cstdint>
#include <string>

#include "emulator/link/unique_fd.h"

namespace fauxboard::link {

/// A socket that takes clients of TCP, and where it is.
struct ListeningSocket {
    UniqueFd fd;             ///< does not block
    std::string text;        ///< "127.0.0.1:4000", "[::1]:4000": the address that it got
    std::string host;        ///< as it was asked for: "127.0.0.1", "myhost"
    std::uint16_t port = 0;  ///< the one it got
};

/// Listens on "HOST:PORT", ":PORT" or "PORT" (of this computer alone), "[IPV6]:PORT"; port 0 takes a free
/// one. Throws LinkError.
ListeningSocket listen_tcp(const std::string& host_port);

}  // namespace fauxboard::link
