#pragma once

// How addresses are written; for emulator/link, and for a command line that looks at one beforehand.

#include <cstdint>
#include <string>

namespace fauxboard::link {

struct HostPort {
    std::string host;
    std::uint16_t port = 0;
};

/// "HOST:PORT", ":PORT" or "PORT" (host 127.0.0.1), "[IPV6]:PORT". Throws LinkError with the forms that there
/// are.
HostPort parse_host_port(const std::string& text);

/// "127.0.0.1:4000", "[::1]:4000".
std::string format_host_port(const std::string& host, std::uint16_t port);

}  // namespace fauxboard::link
