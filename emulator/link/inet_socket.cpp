#include "emulator/link/inet_socket.h"

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>

#include "emulator/link/error_text.h"
#include "emulator/link/host_port.h"
#include "emulator/link/link.h"

namespace fauxboard::link {

SocketAddress::SocketAddress(const sockaddr* address, socklen_t size)
    : size_(std::min<socklen_t>(size, sizeof storage_)) {
    std::memcpy(&storage_, address, size_);
}

SocketAddress SocketAddress::of(int fd) {
    SocketAddress address;
    socklen_t size = sizeof address.storage_;
    if (::getsockname(fd, reinterpret_cast<sockaddr*>(&address.storage_), &size) == 0) address.size_ = size;
    return address;
}

SocketAddress SocketAddress::of_peer(int fd) {
    SocketAddress address;
    socklen_t size = sizeof address.storage_;
    if (::getpeername(fd, reinterpret_cast<sockaddr*>(&address.storage_), &size) == 0) address.size_ = size;
    return address;
}

std::string SocketAddress::text() const {
    std::array<char, NI_MAXHOST> host{};
    std::array<char, NI_MAXSERV> port{};
    if (!known() || ::getnameinfo(get(), size_, host.data(), host.size(), port.data(), port.size(),
                                  NI_NUMERICHOST | NI_NUMERICSERV) != 0) {
        return {};
    }
    std::uint16_t number = 0;
    std::from_chars(port.data(), port.data() + std::strlen(port.data()), number);
    return format_host_port(host.data(), number);
}

bool SocketAddress::operator==(const SocketAddress& other) const {
    return size_ == other.size_ && std::memcmp(&storage_, &other.storage_, size_) == 0;
}

std::vector<SocketAddress> resolve(const std::string& host_port, int type) {
    const HostPort wanted = parse_host_port(host_port);
    addrinfo hints{};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = type;
    hints.ai_flags = AI_NUMERICSERV;
    addrinfo* found = nullptr;
    const int error = ::getaddrinfo(wanted.host.c_str(), std::to_string(wanted.port).c_str(), &hints, &found);
    const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(found, &::freeaddrinfo);
    std::vector<SocketAddress> addresses;
    for (const addrinfo* each = found; error == 0 && each != nullptr; each = each->ai_next)
        addresses.emplace_back(each->ai_addr, each->ai_addrlen);
    if (addresses.empty()) {
        throw LinkError(fmt::format("The host \"{}\" is not known: {}.", wanted.host,
                                    error == EAI_SYSTEM ? error_text(errno) : ::gai_strerror(error)));
    }
    return addresses;
}

UniqueFd make_inet_socket(const SocketAddress& address, int type) {
    return UniqueFd(::socket(address.get()->sa_family, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
}

void prepare_line(int fd) {
    constexpr int probe_s = 5;
    constexpr int probes = 3;
    const auto set = [fd](int level, int option, int value) {
        (void)::setsockopt(fd, level, option, &value, sizeof value);  // worse without, but not wrong
    };
    set(IPPROTO_TCP, TCP_NODELAY, 1);
    set(SOL_SOCKET, SO_KEEPALIVE, 1);
    set(IPPROTO_TCP, TCP_KEEPIDLE, lost_peer_s - probes * probe_s);
    set(IPPROTO_TCP, TCP_KEEPINTVL, probe_s);
    set(IPPROTO_TCP, TCP_KEEPCNT, probes);
    set(IPPROTO_TCP, TCP_USER_TIMEOUT, lost_peer_s * 1000);  // the same for what was sent and not taken
}

}  // namespace fauxboard::link
