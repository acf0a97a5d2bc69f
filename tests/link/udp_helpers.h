#pragma once

#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/link/unique_fd.h"

namespace fauxboard::link::test {

/// A sender on the loopback interface, by plain system calls.
class UdpClient {
  public:
    /// `where`: "127.0.0.1:PORT", as sockets tell it.
    explicit UdpClient(const std::string& where) : fd_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        to.sin_port = htons(static_cast<std::uint16_t>(std::stoul(where.substr(where.rfind(':') + 1))));
        REQUIRE(::connect(fd_.get(), reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0);
    }
    void send(std::string_view bytes) const {
        REQUIRE(::send(fd_.get(), bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()));
    }
    /// The next datagram; "(silence)" when none comes in `patience_ms`.
    std::string receive(int patience_ms = 0) const {
        pollfd entry{.fd = fd_.get(), .events = POLLIN, .revents = 0};
        std::string bytes(65'536, '\0');
        const ssize_t got = ::poll(&entry, 1, patience_ms) > 0
                                ? ::recv(fd_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT)
                                : -1;
        if (got < 0) {
            return "(silence)";
        }
        bytes.resize(static_cast<std::size_t>(got));
        return bytes;
    }
    std::string address() const {
        sockaddr_in own{};
        socklen_t size = sizeof own;
        REQUIRE(::getsockname(fd_.get(), reinterpret_cast<sockaddr*>(&own), &size) == 0);
        return "127.0.0.1:" + std::to_string(ntohs(own.sin_port));
    }

  private:
    UniqueFd fd_;
};

}  // namespace fauxboard::link::test
