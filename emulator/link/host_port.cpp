#include "emulator/link/host_port.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "emulator/link/link.h"

namespace fauxboard::link {

namespace {

// Loopback unless asked otherwise: an emulator has no business on the network by default.
constexpr std::string_view default_host = "127.0.0.1";

[[noreturn]] void refuse(const std::string& text, std::string_view why) {
    throw LinkError(fmt::format(
        "\"{}\" is not an address ({}). Give HOST:PORT, :PORT, PORT or [IPV6]:PORT, such as 127.0.0.1:4000.",
        text, why));
}

}  // namespace

HostPort parse_host_port(const std::string& text) {
    std::string_view host;
    std::string_view port = text;
    if (text.starts_with('[')) {
        const std::size_t bracket = text.find("]:");
        if (bracket == std::string::npos) refuse(text, "no port after the bracket");
        host = std::string_view(text).substr(1, bracket - 1);
        port = std::string_view(text).substr(bracket + 2);
    } else if (const std::size_t colon = text.find(':'); colon != std::string::npos) {
        host = std::string_view(text).substr(0, colon);
        port = std::string_view(text).substr(colon + 1);
        if (port.find(':') != std::string_view::npos) refuse(text, "an IPv6 address needs brackets");
    }
    HostPort result{std::string(host.empty() ? default_host : host), 0};
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), result.port);
    if (error != std::errc() || end != port.data() + port.size())
        refuse(text, "the port is a number from 0 to 65535");
    return result;
}

bool reaches_network(const std::string& path) {
    const std::string host = parse_host_port(path).host;
    return !(host.starts_with("127.") || host == "::1" || host.starts_with("::ffff:127."));
}

std::string format_host_port(const std::string& host, std::uint16_t port) {
    return host.find(':') == std::string::npos ? fmt::format("{}:{}", host, port)
                                               : fmt::format("[{}]:{}", host, port);
}

}  // namespace fauxboard::link
