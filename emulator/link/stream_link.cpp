#include "emulator/link/stream_link.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>

namespace fauxboard::link {

namespace {

// What a broken stream may still hold for us is read before its end is believed; a port that only fails to
// write could go on for ever, hence the bound. 16 reads empty what a kernel keeps for a terminal.
constexpr int last_reads = 16;

bool not_now(int error) {
    return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

}  // namespace

bool hung_up(int fd) {
    pollfd poll_fd{fd, POLLIN, 0};
    return ::poll(&poll_fd, 1, 0) > 0 && (poll_fd.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
}

ssize_t nothing_read(int fd) {
    pollfd poll_fd{fd, POLLIN, 0};
    const bool ready = ::poll(&poll_fd, 1, 0) > 0;
    if (ready && (poll_fd.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0) return 0;
    errno = ready ? EINTR : EAGAIN;
    return -1;
}

void StreamLink::open(LinkListener& listener) {
    if (session_) throw LinkError(fmt::format("{} is open already.", describe()));
    session_ = std::make_shared<char>();
    listener_ = &listener;
    was_up_ = false;
    held_ = false;
    try {
        open_device();
    } catch (...) {
        close();
        throw;
    }
}

void StreamLink::close() {
    if (!session_) return;
    session_.reset();
    detach();
    drop_pending();
    close_device();
    listener_ = nullptr;
    state_ = LinkState::opening;
}

ssize_t StreamLink::read_some(int fd, char* data, std::size_t size) {
    return ::read(fd, data, size);
}
ssize_t StreamLink::write_some(int fd, const char* data, std::size_t size) {
    return ::write(fd, data, size);
}

// ---- attaching ----

void StreamLink::attach(int fd) {
    detach();
    watch_.start(fd);
    watch_.hold(held_);
}

void StreamLink::detach() {
    ++attach_count_;
    broken_ = false;
    watch_.stop();
}

// ---- reading ----

void StreamLink::hold(bool held) {
    held_ = held;
    if (attached()) watch_.hold(held);
}

void StreamLink::on_readable() {
    if (take() == Took::end) on_end(end_reason_);
}

// One read, so that a peer that floods us leaves the loop's others their turn.
StreamLink::Took StreamLink::take() {
    const ssize_t count = read_some(watch_.fd(), buffer_.data(), buffer_.size());
    if (count > 0) {
        const bool is_short = static_cast<std::size_t>(count) < buffer_.size();
        if (is_short && short_read_is_last() && !watch_.hung_up()) watch_.drained();
        stats_.bytes_in += static_cast<std::uint64_t>(count);
        const std::weak_ptr<char> session = session_;
        const unsigned id = attach_count_;
        listener_->on_bytes({buffer_.data(), static_cast<std::size_t>(count)});
        // The listener may have closed or destroyed us: nothing of this object is safe before this is asked.
        return session.expired() || id != attach_count_ ? Took::left : Took::bytes;
    }
    if (count < 0 && not_now(errno)) {
        if (errno != EINTR) watch_.drained();
        return Took::nothing;
    }
    end_reason_ = count < 0 ? error_text(errno) : "end of file";
    return Took::end;
}

// ---- writing ----

void StreamLink::write(std::string_view message) {
    if (message.empty()) return;
    if (state_ == LinkState::up && !broken_) {
        if (pending_.empty())
            send_now(message);
        else
            keep(message, pending_limit);
    } else if (session_ && !was_up_ && keeps_backlog()) {
        keep(message, backlog_limit);
    } else {
        lose(message);
    }
}

void StreamLink::send_now(std::string_view message) {
    if (message.size() > pending_limit) return lose(message);
    const ssize_t result = write_some(watch_.fd(), message.data(), message.size());
    if (result < 0 && !not_now(errno)) {
        const int error = errno;
        lose(message);
        return fail_later(error);
    }
    const std::size_t sent = result < 0 ? 0 : static_cast<std::size_t>(result);
    stats_.bytes_out += sent;
    if (sent == message.size()) return;
    pending_.push(message.substr(sent), pending_limit);
    watch_.await_writable();
}

void StreamLink::keep(std::string_view message, std::size_t limit) {
    if (!pending_.push(message, limit)) lose(message);
}

void StreamLink::lose(std::string_view message) {
    stats_.bytes_lost += message.size();
    ++stats_.writes_lost;
}

void StreamLink::drop_pending() {
    const PendingBytes::Dropped dropped = pending_.clear();
    stats_.bytes_lost += dropped.bytes;
    stats_.writes_lost += dropped.messages;
}

void StreamLink::on_writable() {
    flush_pending();
    if (pending_.empty()) listener_->on_drained();
}

void StreamLink::flush_pending() {
    if (pending_.empty() || broken_) return;
    const std::string_view rest = pending_.view();
    const ssize_t result = write_some(watch_.fd(), rest.data(), rest.size());
    if (result < 0 && !not_now(errno)) return fail_later(errno);
    if (result > 0) {
        stats_.bytes_out += static_cast<std::uint64_t>(result);
        pending_.consume(static_cast<std::size_t>(result));
    }
    if (!pending_.empty()) watch_.await_writable();
}

// A write found the line broken. The listener must not be called from inside its own write(), and what the
// other end said before it went must still be heard.
void StreamLink::fail_later(int error) {
    broken_ = true;
    post([this, id = attach_count_, why = error_text(error)] {
        if (id != attach_count_) return;
        for (int i = 0; i < last_reads; ++i) {
            const Took took = take();
            if (took == Took::left) return;
            if (took != Took::bytes) break;
        }
        on_end(why);
    });
}

// ---- telling ----

void StreamLink::go_up(std::string why) {
    was_up_ = true;
    announce(LinkState::up, std::move(why));
    flush_pending();
}

void StreamLink::go_waiting(std::string why) {
    if (was_up_) drop_pending();
    announce(LinkState::waiting, std::move(why));
}

void StreamLink::note(std::string why) {
    announce(state_, std::move(why));
}

void StreamLink::announce(LinkState state, std::string why) {
    state_ = state;
    post([this, state, text = std::move(why)] { listener_->on_state(state, text); });
}

}  // namespace fauxboard::link
