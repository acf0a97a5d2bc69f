#pragma once

// Internal to emulator/link. The one header that pulls in Asio's TCP.

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

#include "emulator/link/event_loop.h"
// After event_loop.h, which see.
#include <asio/ip/tcp.hpp>

namespace fauxboard::link {

/// The endpoints of `host_port`. Throws LinkError for a bad address or an unknown host.
std::vector<asio::ip::tcp::endpoint> resolve(asio::io_context& context, const std::string& host_port);

/// "127.0.0.1:4000", "[::1]:4000".
std::string to_text(const asio::ip::tcp::endpoint& endpoint);

/// Without Nagle's wait: a message is small and awaited.
void send_at_once(asio::ip::tcp::socket& socket);

/// As ::read and ::write, but never block and never raise SIGPIPE, whatever the socket's mode.
ssize_t read_socket(int fd, char* data, std::size_t size);
ssize_t write_socket(int fd, const char* data, std::size_t size);

}  // namespace fauxboard::link
