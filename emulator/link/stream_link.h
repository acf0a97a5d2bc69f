#pragma once

// Internal to emulator/link.

#include <sys/types.h>

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "emulator/link/error_text.h"
#include "emulator/link/event_loop.h"
#include "emulator/link/link.h"
#include "emulator/link/pending_bytes.h"

namespace fauxboard::link {

/// What every link shares: the read loop, direct writes with a bounded rest, loss counting, telling the
/// listener. A derived class opens a descriptor, lends it with attach(), and decides what the end of the
/// stream means.
///
/// What comes in costs one read() and one turn of the event loop; a message costs one write().
/// Derived destructors must call close().
class StreamLink : public Link {
  public:
    void open(LinkListener& listener) final;
    void close() final;
    void write(std::string_view message) final;
    std::size_t pending() const final { return pending_.size(); }
    void hold(bool held) final;
    LinkState state() const final { return state_; }
    const LinkStats& stats() const final { return stats_; }

  protected:
    explicit StreamLink(EventLoop& loop)
        : loop_(loop),
          watch_(
              loop, [this] { on_readable(); }, [this] { on_writable(); }) {}

    /// Opens, and calls attach(), go_up(), go_waiting() as fits. Throws LinkError; close_device() follows
    /// then.
    virtual void open_device() = 0;
    /// Gives everything back. Called with no descriptor attached; must cope with a half-opened device.
    virtual void close_device() = 0;
    /// The attached stream ended or broke: `why` is the system's text ("Input/output error") or "end of
    /// file".
    virtual void on_end(const std::string& why) = 0;
    /// As ::read: -1 with errno, EAGAIN where there is nothing; 0 is the end of the stream.
    virtual ssize_t read_some(int fd, char* data, std::size_t size);
    /// Whether a read that brought less than it asked for has brought all there was. Saves a read each time;
    /// not so for terminals that somebody may set to lines, and sockets with urgent data.
    virtual bool short_read_is_last() const { return false; }
    /// As ::write.
    virtual ssize_t write_some(int fd, const char* data, std::size_t size);
    /// Whether what is written before the first go_up() is kept (up to backlog_limit).
    virtual bool keeps_backlog() const { return false; }

    /// Borrows `fd` (non-blocking) and reads it from now on. Throws LinkError if the event loop refuses it.
    void attach(int fd);
    /// Gives the descriptor back, unclosed.
    void detach();
    bool attached() const { return watch_.active(); }

    void go_up(std::string why);
    void go_waiting(std::string why);
    /// A sentence for the listener, the state unchanged.
    void note(std::string why);
    /// Counts what has not been sent yet as lost.
    void drop_pending();
    bool was_up() const { return was_up_; }  ///< since open()

    EventLoop& loop() { return loop_; }

  private:
    enum class Took : std::uint8_t { bytes, nothing, end, left };

    /// Puts `task` off to the loop's next turn; dropped if this link is closed or destroyed meanwhile.
    template <class Task>
    void post(Task task) {
        loop_.post([session = std::weak_ptr<char>(session_), task = std::move(task)] {
            if (!session.expired()) task();
        });
    }
    void on_readable();
    void on_writable();
    Took take();
    void flush_pending();
    void send_now(std::string_view message);
    void keep(std::string_view message, std::size_t limit);
    void lose(std::string_view message);
    void fail_later(int error);
    void announce(LinkState state, std::string why);

    EventLoop& loop_;
    Watch watch_;
    LinkListener* listener_ = nullptr;
    std::shared_ptr<char> session_;  ///< lives from open() to close(); what is put off holds it weakly
    unsigned attach_count_ = 0;      ///< tells what a former descriptor left to do from what this did
    LinkState state_ = LinkState::opening;
    bool was_up_ = false;
    bool broken_ = false;  ///< a write failed; on_end() is on its way
    bool held_ = false;    ///< see hold()
    LinkStats stats_;
    PendingBytes pending_;
    std::string end_reason_;
    std::array<char, read_limit> buffer_{};
};

/// Whether the other side of a terminal is gone.
bool hung_up(int fd);
/// What read_some() returns for a terminal's read that brought 0 bytes: 0 at the end, else -1 with EAGAIN, or
/// EINTR where something is there all the same.
ssize_t nothing_read(int fd);

}  // namespace fauxboard::link
