#include "emulator/host/tap_end.h"

#include <fmt/format.h>

#include "emulator/link/ports.h"

namespace fauxboard::host {

using link::LinkError;

TapEnd parse_tap_end(std::string_view text) {
    static constexpr std::string_view pty = "pty=";
    static constexpr std::string_view connect = "tcp:";
    static constexpr std::string_view listen = "tcp-listen:";
    const auto after = [&](std::string_view start) { return std::string(text.substr(start.size())); };
    TapEnd end;
    if (text == "pty") {
        return end;
    }
    if (text.starts_with(pty)) {
        end = {TapEnd::Kind::pty, after(pty)};
    } else if (text.starts_with(connect)) {
        end = {TapEnd::Kind::tcp_connect, after(connect)};
    } else if (text.starts_with(listen)) {
        end = {TapEnd::Kind::tcp_listen, after(listen)};
    } else {
        end = {TapEnd::Kind::port, std::string(text)};
    }
    if (end.name.empty()) {
        throw LinkError(
            fmt::format("'{}' is no end of a line. Expected a device (/dev/ttyUSB0), auto, pty, "
                        "pty=LINK, tcp:HOST:PORT or tcp-listen:HOST:PORT.",
                        text));
    }
    return end;
}

std::unique_ptr<link::Link> make_tap_link(link::EventLoop& loop, const TapEnd& end, unsigned baud) {
    switch (end.kind) {
        case TapEnd::Kind::pty:
            return link::make_pty_link(loop, end.name);
        case TapEnd::Kind::tcp_connect:
            return link::make_tcp_connect_link(loop, end.name);
        case TapEnd::Kind::tcp_listen:
            return link::make_tcp_listen_link(loop, end.name);
        case TapEnd::Kind::port:
            break;
    }
    return link::make_port_link(loop, end.name == "auto" ? link::pick_auto_port() : end.name, baud);
}

}  // namespace fauxboard::host
