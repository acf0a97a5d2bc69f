#include "tools/control_client.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

#include "emulator/host/text_output.h"
#include "emulator/link/link.h"
#include "emulator/link/local_path.h"
#include "tools/patience.h"

namespace fauxboard::tools {
namespace {

/// More than any answer has; a peer that is no board must not fill our memory.
constexpr std::size_t most_line = 16UL * 1024 * 1024;

ssize_t read_retry(int fd, char* data, std::size_t size) {
    ssize_t got = 0;
    do {
        got = ::read(fd, data, size);
    } while (got < 0 && errno == EINTR);
    return got;
}

/// `fauxboard run --control X &`, then `fauxboard ctl X`: the board has its socket a moment later.
link::UniqueFd connect_patiently(const std::string& path, int timeout_ms) {
    link::UniqueFd fd;
    wait_a_moment(
        [&] {
            try {
                fd = link::connect_local(path);
            } catch (const link::LinkError&) {  // perhaps the next time; the last one is told
            }
            return static_cast<bool>(fd);
        },
        timeout_ms);
    return fd ? std::move(fd) : link::connect_local(path);
}

}  // namespace

ControlClient::ControlClient(const std::string& path, int timeout_ms)
    : fd_(connect_patiently(path, timeout_ms)), timeout_ms_(timeout_ms) {}

bool ControlClient::send(std::string_view bytes) const {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(fd_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent < 0 && errno != EINTR) {
            return false;
        }
        bytes.remove_prefix(sent < 0 ? 0 : static_cast<std::size_t>(sent));
    }
    return true;
}

void ControlClient::finish() const {
    ::shutdown(fd_.get(), SHUT_WR);
}

ControlClient::Got ControlClient::receive(std::string& line) {
    std::array<char, 4096> buffer{};
    std::size_t end = rest_.find('\n');
    while (end == std::string::npos) {
        pollfd ready{fd_.get(), POLLIN, 0};
        const int count = ::poll(&ready, 1, timeout_ms_);
        if (count == 0) {
            return Got::silence;
        }
        if (count < 0 && errno == EINTR) {
            continue;
        }
        const ssize_t got = read_retry(fd_.get(), buffer.data(), buffer.size());
        if (got <= 0 || rest_.size() > most_line) {
            return Got::end;
        }
        const std::size_t from = rest_.size();
        rest_.append(buffer.data(), static_cast<std::size_t>(got));
        end = rest_.find('\n', from);
    }
    line.assign(rest_, 0, end);
    rest_.erase(0, end + 1);
    return Got::line;
}

void ControlClient::copy(int in, int out) {
    host::TextOutput output(out, host::TextOutput::WhenFull::wait);
    std::array<char, 4096> buffer{};
    for (;;) {
        std::array<pollfd, 2> ready{pollfd{fd_.get(), POLLIN, 0}, pollfd{in, POLLIN, 0}};
        if (::poll(ready.data(), ready.size(), -1) < 0 && errno != EINTR) {
            return;
        }
        if (ready[0].revents != 0) {
            const ssize_t got = read_retry(fd_.get(), buffer.data(), buffer.size());
            if (got <= 0) {
                return;
            }
            output.write({buffer.data(), static_cast<std::size_t>(got)});
        } else if (ready[1].revents != 0) {
            const ssize_t got = read_retry(in, buffer.data(), buffer.size());
            if (got <= 0) {
                finish();
                in = -1;  // poll() passes over it
            } else if (!send({buffer.data(), static_cast<std::size_t>(got)})) {
                in = -1;
            }
        }
    }
}

}  // namespace fauxboard::tools
