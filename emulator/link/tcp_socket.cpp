#include "emulator/link/tcp_socket.h"

#include <fmt/format.h>
#include <sys/socket.h>

#include "emulator/link/link.h"
#include "emulator/link/tcp_address.h"

namespace fauxboard::link {

using asio::ip::tcp;

std::vector<tcp::endpoint> resolve(asio::io_context& context, const std::string& host_port) {
    const HostPort address = parse_host_port(host_port);
    asio::error_code error;
    const tcp::resolver::results_type results = tcp::resolver(context).resolve(
        address.host, std::to_string(address.port), tcp::resolver::numeric_service, error);
    std::vector<tcp::endpoint> endpoints;
    for (const auto& result : results)
        endpoints.push_back(result.endpoint());
    if (error || endpoints.empty()) {
        throw LinkError(fmt::format("The host \"{}\" is not known: {}.", address.host, error.message()));
    }
    return endpoints;
}

std::string to_text(const tcp::endpoint& endpoint) {
    return format_host_port(endpoint.address().to_string(), endpoint.port());
}

void send_at_once(tcp::socket& socket) {
    asio::error_code ignored;  // slower without, but not wrong
    socket.set_option(tcp::no_delay(true), ignored);
}

ssize_t read_socket(int fd, char* data, std::size_t size) {
    return ::recv(fd, data, size, MSG_DONTWAIT);
}

ssize_t write_socket(int fd, const char* data, std::size_t size) {
    return ::send(fd, data, size, MSG_DONTWAIT | MSG_NOSIGNAL);
}

}  // namespace fauxboard::link
