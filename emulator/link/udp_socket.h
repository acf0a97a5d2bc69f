#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace fauxboard::link {

class EventLoop;

/// Who sent a datagram: a number of the socket's own, the same for the same address as long as it is
/// remembered. 0 is nobody.
using UdpPeer = std::uint64_t;

/// Told what arrives. Called from the event loop only, never from inside a call of the socket, and never
/// after close(). May call any function of the socket, and may destroy it; must not throw.
class UdpListener {
  public:
    virtual ~UdpListener() = default;
    /// One datagram, of any length and content; `bytes` is valid during the call.
    virtual void on_datagram(UdpPeer from, std::string_view bytes) = 0;
    /// Something a person wants to know, as a sentence without a full stop.
    virtual void on_trouble(std::string_view why) = 0;
};

/// Counted from the socket's creation. What was sent went out, or was lost, or is still pending.
struct UdpStats {
    std::uint64_t datagrams_in = 0;
    std::uint64_t datagrams_out = 0;
    std::uint64_t datagrams_lost = 0;
};

/// A UDP socket on the event loop. Lives on one thread, the loop's, which must outlive it.
class UdpSocket {
  public:
    static constexpr std::size_t pending_limit = 64UL * 1024;  ///< bytes kept while the system takes none
    static constexpr std::size_t peers_limit = 64;       ///< addresses remembered; the oldest is forgotten
    static constexpr std::size_t max_datagram = 65'507;  ///< bytes

    UdpSocket() = default;
    UdpSocket(const UdpSocket&) = delete;
    UdpSocket& operator=(const UdpSocket&) = delete;
    virtual ~UdpSocket() = default;

    /// Binds and starts to read. Throws LinkError: no such address, no permission, port in use.
    virtual void open(UdpListener& listener) = 0;
    /// Idempotent. What is still pending is lost and counted.
    virtual void close() = 0;
    /// Sends one datagram, at once or as soon as the system takes it. Lost, and counted: to somebody
    /// forgotten, beyond `pending_limit`, longer than `max_datagram`, or when the system refuses it.
    virtual void send(UdpPeer to, std::string_view bytes) = 0;

    virtual std::size_t pending() const = 0;  ///< bytes
    virtual const UdpStats& stats() const = 0;
    /// "127.0.0.1:3000": where it listens; with the port that was taken if 0 was asked for.
    virtual std::string path() const = 0;
    /// The address of somebody remembered, "127.0.0.1:41234"; empty when forgotten.
    virtual std::string name(UdpPeer peer) const = 0;
};

/// For "HOST:PORT", ":PORT" or "PORT" (127.0.0.1), "[IPV6]:PORT". Throws LinkError, from open() on.
std::unique_ptr<UdpSocket> make_udp_socket(EventLoop& loop, std::string host_port);

}  // namespace fauxboard::link
