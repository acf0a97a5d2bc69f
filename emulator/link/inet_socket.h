#pragma once

// Internal to emulator/link: what TCP and UDP share.

#include <sys/socket.h>

#include <string>
#include <vector>

#include "emulator/link/unique_fd.h"

namespace fauxboard::link {

/// The address of one end of a socket, IPv4 or IPv6.
class SocketAddress {
  public:
    SocketAddress() = default;
    SocketAddress(const sockaddr* address, socklen_t size);
    /// Of this end, and of the other; none if the system knows none.
    static SocketAddress of(int fd);
    static SocketAddress of_peer(int fd);

    bool known() const { return size_ != 0; }
    const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage_); }
    socklen_t size() const { return size_; }
    /// "127.0.0.1:4000", "[::1]:4000"; empty for none.
    std::string text() const;
    bool operator==(const SocketAddress& other) const;

  private:
    sockaddr_storage storage_{};
    socklen_t size_ = 0;
};

/// The addresses that `host_port` stands for, at least one. `type`: SOCK_STREAM or SOCK_DGRAM. Throws
/// LinkError for a bad address or an unknown host.
std::vector<SocketAddress> resolve(const std::string& host_port, int type);

/// Not blocking. None, with errno, if the system gives none.
UniqueFd make_inet_socket(const SocketAddress& address, int type);

/// A connection as a line needs it: without Nagle's wait, since a message is small and awaited; and one whose
/// other end has vanished without a word (its cable was pulled) ends within `lost_peer_s`, so that the line
/// is free for the next.
void prepare_line(int fd);
inline constexpr int lost_peer_s = 35;

}  // namespace fauxboard::link
