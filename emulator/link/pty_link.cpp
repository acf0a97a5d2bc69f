#include "emulator/link/pty_link.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <termios.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <utility>

#include "emulator/link/line_speed.h"
#include "emulator/link/link_name.h"
#include "emulator/link/peer_watch.h"
#include "emulator/link/stream_link.h"
#include "emulator/link/unique_fd.h"

namespace fauxboard::link {

namespace {

/// A pseudo-terminal of our own.
///
/// While a peer is watched for we do not hold the slave open ourselves: then the kernel tells the truth about
/// the last peer's leaving (the master reads what is left, then EIO, and polls as hung up), and inotify only
/// has to tell that somebody came. The master is not read while nobody is there. Settings are made through
/// the master, where Linux applies them to the slave.
class PtyLink final : public StreamLink {
  public:
    PtyLink(EventLoop& loop, std::string link_name, bool watch_peers, PtyUse use)
        : StreamLink(loop),
          use_(use),
          watch_events_(loop, [this] { on_watch(); }),
          name_(std::move(link_name)),
          watch_peers_(watch_peers) {}
    ~PtyLink() override { close(); }

    std::string describe() const override {
        return name_.empty() ? "pty " + path_ : fmt::format("pty {} (link {})", path_, name_);
    }
    std::string kind() const override { return "pty"; }
    std::string path() const override { return path_; }

  private:
    void open_device() override;
    void close_device() override;
    void on_end(const std::string& why) override;
    bool keeps_backlog() const override { return use_.backlog; }
    ssize_t read_some(int fd, char* data, std::size_t size) override;
    ssize_t write_some(int fd, const char* data, std::size_t size) override;
    /// A master is read by bytes, never by lines; at a wrong speed not all that there is room for is read.
    bool short_read_is_last() const override { return !garbled_; }

    void open_master();
    void hold_slave();
    bool make_raw() const;
    void forget_unread() const;
    void on_watch();
    unsigned wrong_speed() const;
    void look_at_speed();

    PtyUse use_;
    bool looked_ = false;   ///< at the speed of the peer that is there
    bool garbled_ = false;  ///< what was read last
    Watch watch_events_;    ///< borrows watch_'s descriptor
    std::string name_;
    bool watch_peers_;
    std::string path_;
    UniqueFd master_;
    UniqueFd slave_;  ///< only where peers cannot be watched for
    PeerWatch watch_;
    LinkName link_;
};

[[noreturn]] void fail(const char* what) {
    throw LinkError(fmt::format("No pseudo-terminal: {}: {}.", what, error_text(errno)));
}

void PtyLink::open_device() {
    open_master();
    const bool watched = watch_peers_ && watch_.start(path_);
    if (!watched) hold_slave();
    // Only now: who waits for the name opens it at once, and must be seen.
    if (!name_.empty()) link_.create(name_, path_);
    if (!watched) {
        attach(master_.get());
        return go_up(
            fmt::format("{} is open; there is no telling whether anybody is at the other end", path_));
    }
    watch_events_.start(watch_.fd());
    go_waiting(fmt::format("{} is open; waiting for somebody to open its other end", path_));
}

void PtyLink::open_master() {
    master_.reset(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!master_) fail("the system gives none");
    std::array<char, 128> path{};
    if (::grantpt(master_.get()) != 0 || ::unlockpt(master_.get()) != 0) fail("it cannot be unlocked");
    if (::ptsname_r(master_.get(), path.data(), path.size()) != 0) fail("it has no name");
    path_ = path.data();
    if (!make_raw()) fail("it cannot be set to raw");
}

// A slave that nobody has open makes the master fail; where we cannot tell whether there is a peer, we are
// one.
void PtyLink::hold_slave() {
    slave_.reset(::open(path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!slave_) fail("its other end cannot be opened");
}

void PtyLink::close_device() {
    watch_events_.stop();
    watch_.stop();
    link_.remove();
    slave_.reset();
    master_.reset();
}

// ---- peers ----

void PtyLink::on_watch() {
    const PeerWatch::Seen seen = watch_.take();
    if (!seen.anything) return watch_events_.drained();
    const bool nobody = hung_up(master_.get());
    if (state() == LinkState::up) {
        if (nobody) return;  // the read loop delivers what is left, then finds the end
        if (seen.reopened) {
            // One left and the next came before we looked.
            drop_pending();
            forget_unread();
            looked_ = false;
            go_waiting(fmt::format("{} was closed at its other end", path_));
            go_up(fmt::format("{} was opened at its other end", path_));
        }
        if (watch_.count() == 0) watch_.set_count(1);
        return;
    }
    if (!seen.opened) return;
    try {
        if (!attached()) attach(master_.get());
    } catch (const LinkError& error) {
        return note(error.what());
    }
    // One that has come and gone is heard, but it is not the one that the backlog is for.
    looked_ = false;
    if (!nobody) go_up(fmt::format("{} was opened at its other end", path_));
}

void PtyLink::on_end(const std::string& /*why*/) {
    detach();
    watch_.set_count(0);
    if (state() != LinkState::up) return;
    // A peer that came this very moment may have made its own settings.
    if (!hung_up(master_.get()) || !make_raw()) forget_unread();
    go_waiting(fmt::format("{} was closed at its other end; what is sent now is lost", path_));
}

// ---- settings ----

ssize_t PtyLink::read_some(int fd, char* data, std::size_t size) {
    const unsigned peer = use_.exact_speed ? wrong_speed() : 0;
    garbled_ = peer != 0;
    const ssize_t count = StreamLink::read_some(fd, data, garbled_ ? size / most_heard_per_byte : size);
    if (count <= 0) return count;
    if (!looked_) look_at_speed();
    if (!garbled_) return count;
    const std::string heard = as_heard({data, static_cast<std::size_t>(count)}, peer, use_.baud);
    if (heard.empty()) {
        errno = EINTR;
        return -1;  // not the end: something came, and was nothing
    }
    std::copy(heard.begin(), heard.end(), data);
    return static_cast<ssize_t>(heard.size());
}

// What a peer at another speed does not take of its garbage is lost: there is no telling what it belonged to.
ssize_t PtyLink::write_some(int fd, const char* data, std::size_t size) {
    const unsigned peer = use_.exact_speed ? wrong_speed() : 0;
    if (peer == 0) return StreamLink::write_some(fd, data, size);
    const std::string heard = as_heard({data, size}, use_.baud, peer);
    const ssize_t count = heard.empty() ? 0 : StreamLink::write_some(fd, heard.data(), heard.size());
    return count < 0 ? count : static_cast<ssize_t>(size);
}

/// The peer's, where it is not the board's; else 0. What a new pseudo-terminal has nobody has chosen.
unsigned PtyLink::wrong_speed() const {
    if (use_.baud == 0) return 0;
    const unsigned speed = line_speed(master_.get());
    return speed == use_.baud || speed == unset_speed ? 0 : speed;
}

// When its first bytes come a peer has set its speed, if it ever does.
void PtyLink::look_at_speed() {
    looked_ = true;
    if (const unsigned peer = wrong_speed(); peer != 0) {
        note(fmt::format("{} was opened at {} baud, the board has {}: {}", path_, peer, use_.baud,
                         use_.exact_speed ? "both hear nothing but garbage"
                                          : "a real line would bring nothing but garbage"));
    }
}

// No echo, no translation of line ends; whatever the last peer made of it. Drops what the slave has not read.
bool PtyLink::make_raw() const {
    termios settings{};
    if (::tcgetattr(master_.get(), &settings) != 0) return false;
    ::cfmakeraw(&settings);
    (void)::tcflush(master_.get(), TCOFLUSH);
    return ::tcsetattr(master_.get(), TCSAFLUSH, &settings) == 0;
}

// tcflush() on the master empties what is on its way to the slave, but not what waits in the slave to be
// read. Setting the same settings again with TCSAFLUSH does, without opening the slave, which would look like
// a peer.
void PtyLink::forget_unread() const {
    termios settings{};
    if (::tcgetattr(master_.get(), &settings) != 0) return;
    (void)::tcflush(master_.get(), TCOFLUSH);
    (void)::tcsetattr(master_.get(), TCSAFLUSH, &settings);
}

}  // namespace

std::unique_ptr<Link> make_pty_link(EventLoop& loop, std::string link_name, bool watch_peers, PtyUse use) {
    return std::make_unique<PtyLink>(loop, std::move(link_name), watch_peers, use);
}

std::unique_ptr<Link> make_pty_link(EventLoop& loop, std::string link_name, PtyUse use) {
    return make_pty_link(loop, std::move(link_name), true, use);
}

}  // namespace fauxboard::link
