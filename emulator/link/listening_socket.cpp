#include "emulator/link/listening_socket.h"

#include <fmt/format.h>

#include <cerrno>

#include "emulator/link/error_text.h"
#include "emulator/link/host_port.h"
#include "emulator/link/inet_socket.h"
#include "emulator/link/link.h"

namespace fauxboard::link {

ListeningSocket listen_tcp(const std::string& host_port) {
    const SocketAddress address = resolve(host_port, SOCK_STREAM).front();
    UniqueFd fd = make_inet_socket(address, SOCK_STREAM);
    const int on = 1;  // else a restart would fail for a minute after the last connection
    if (!fd || ::setsockopt(fd.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0 ||
        ::bind(fd.get(), address.get(), address.size()) != 0 || ::listen(fd.get(), SOMAXCONN) != 0) {
        const int error = errno;
        throw LinkError(fmt::format("Cannot listen on {}: {}. Choose another port, or 0 for a free one.",
                                    address.text(), error_text(error)));
    }
    ListeningSocket socket;
    socket.text = SocketAddress::of(fd.get()).text();
    socket.host = parse_host_port(host_port).host;
    socket.port = parse_host_port(socket.text).port;
    socket.fd = std::move(fd);
    return socket;
}

}  // namespace fauxboard::link
