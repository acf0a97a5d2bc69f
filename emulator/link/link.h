#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace fauxboard::link {

class EventLoop;

/// A link that cannot work as it was asked for. what() is a full sentence that says what to do about it.
class LinkError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

enum class LinkState : std::uint8_t {
    opening,  ///< not open: before open(), after close()
    waiting,  ///< open, but nobody at the other end, or the port is gone and being retried
    up,       ///< somebody is at the other end
};

/// "opening", "waiting", "up": for programs that read what is logged.
constexpr std::string_view state_name(LinkState state) {
    constexpr std::string_view names[] = {"opening", "waiting", "up"};
    return names[static_cast<std::size_t>(state)];
}

/// Told what arrives. Called from the event loop only, never from inside open(), write() or close(), and
/// never after close(). May call any function of the link, and may destroy it; must not throw.
class LinkListener {
  public:
    virtual ~LinkListener() = default;
    /// Bytes as they come, 1 to 4096 at once; `bytes` is valid during the call.
    virtual void on_bytes(std::string_view bytes) = 0;
    /// The link changed, or (same state as before) something happened that a person wants to know.
    /// `why` is a sentence for the log without a full stop: "/dev/ttyUSB0 vanished (Input/output error);
    /// ...".
    virtual void on_state(LinkState state, std::string_view why) = 0;
    /// All that write() had to keep (see Link::pending) has been handed to the system.
    virtual void on_drained() {}
};

/// Counted from the link's creation. A message is one call of write(); every message's bytes end up either in
/// `bytes_out` (handed to the system), in `bytes_lost`, or are still pending.
struct LinkStats {
    std::uint64_t bytes_in = 0;
    std::uint64_t bytes_out = 0;
    std::uint64_t bytes_lost = 0;
    std::uint64_t writes_lost = 0;  ///< messages of which at least one byte was lost
};

/// One end of a line. Lives on one thread, the event loop's, which must outlive it.
class Link {
  public:
    static constexpr std::size_t read_limit = 4096;  ///< bytes, per call of on_bytes
    static constexpr std::size_t pending_limit =
        64UL * 1024;                                    ///< bytes kept while the other end does not read
    static constexpr std::size_t backlog_limit = 4096;  ///< bytes kept for the first to arrive (pty, tcp)

    Link() = default;
    Link(const Link&) = delete;
    Link& operator=(const Link&) = delete;
    virtual ~Link() = default;

    /// Starts. `listener` must live until close(). Throws LinkError when it can never work: no such port, no
    /// permission, port in use; the link is closed then. A port that goes away later is retried instead.
    virtual void open(LinkListener& listener) = 0;
    /// Idempotent; removes the link name. What is still pending is lost and counted.
    virtual void close() = 0;
    /// Sends one message, at once. Never blocks, never throws for what the line does: a UART has no back
    /// pressure, so what cannot be sent is lost, as a whole message, and counted. A message longer than
    /// `pending_limit` is always lost.
    virtual void write(std::string_view message) = 0;

    /// Bytes of messages that the system has not taken yet.
    virtual std::size_t pending() const { return 0; }
    /// Stops reading, or goes on; holds nothing after open(). What the other end sends meanwhile waits in the
    /// system: that holds up a program, and lets a serial port overrun. For whoever passes bytes on to a line
    /// that takes them more slowly. The end of the stream is found when reading goes on.
    virtual void hold(bool /*held*/) {}

    /// Changes at once; the listener hears of it on the loop's next turn.
    virtual LinkState state() const = 0;
    virtual const LinkStats& stats() const = 0;
    virtual std::string describe() const = 0;  ///< "pty /dev/pts/5 (link /tmp/screen)"
    virtual std::string kind() const = 0;      ///< "pty" | "serial" | "tcp"
    virtual std::string path() const = 0;      ///< "/dev/pts/5", "/dev/ttyUSB0", "127.0.0.1:4000"
};

/// A line that leads nowhere: nobody is ever there, and what is written to it is lost. Its kind is "none".
std::unique_ptr<Link> make_no_link();

/// Whether a path() of TCP or UDP can be reached from other computers: any address that is not loopback.
bool reaches_network(const std::string& path);

/// A pseudo-terminal of our own. `link_name`: a symlink to it, removed by close(); "" for none. An existing
/// name is replaced only if it is a symlink that points nowhere. What is written before the first peer opens
/// it is kept for that peer, up to `backlog_limit`; what is written while nobody has it open later on is
/// lost, and a new peer never reads what was meant for the one before.
///
/// A host's port drops what came before it was opened: `backlog` false. With `baud` a peer that opens it at
/// another speed is told of: on a real line it would read nothing sensible. With `exact_speed` it does read,
/// and say, what would be heard then, until its speed is right. 38400, which a new pseudo-terminal has, is
/// any speed.
struct PtyUse {
    unsigned baud = 0;  ///< bit/s; 0: any
    bool backlog = true;
    bool exact_speed = false;
};
std::unique_ptr<Link> make_pty_link(EventLoop& loop, std::string link_name, PtyUse use = {});

/// A port that exists: a serial port, or somebody else's pseudo-terminal (/dev/pts/N, or a symlink to one).
/// 8N1, no flow control, `baud` in bit/s. A port that vanishes is tried again every 500 ms; symlinks are
/// followed anew each time.
std::unique_ptr<Link> make_port_link(EventLoop& loop, std::string device, unsigned baud);

/// The board's side of a TCP line: listens on "HOST:PORT", ":PORT" or "PORT" (127.0.0.1), "[IPV6]:PORT". Port
/// 0 takes a free one; path() tells which. One client at a time; a second one is turned away. `backlog` as
/// for the pty.
std::unique_ptr<Link> make_tcp_listen_link(EventLoop& loop, std::string host_port, bool backlog = true);

/// The screen's side: connects when opened (which may take up to 5 s per address, then LinkError), and again
/// every 500 ms after the connection was lost.
std::unique_ptr<Link> make_tcp_connect_link(EventLoop& loop, std::string host_port);

}  // namespace fauxboard::link
