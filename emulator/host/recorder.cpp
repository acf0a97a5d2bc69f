#include "emulator/host/recorder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "emulator/link/host_error.h"
#include "emulator/record/recording.h"
#include "protocol/secrets.h"

namespace fauxboard::host {
namespace {

constexpr std::size_t max_datagram = 4096;

}  // namespace

// O_NONBLOCK: a pipe must have its reader now, and is never waited for. Files do not know it.
Recorder::Recorder(std::string file, OnTrouble on_trouble)
    : file_(std::move(file)),
      on_trouble_(std::move(on_trouble)),
      fd_(::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, 0666)) {
    if (!fd_ && errno == ENXIO) {
        throw link::HostError(fmt::format(
            "The recording {} is a pipe that nobody reads. Start its reader first, or name a file.", file_));
    }
    if (!fd_) {
        throw link::HostError(
            fmt::format("The recording {} cannot be written ({}). Name a file in a folder of "
                        "yours.",
                        file_, std::system_category().message(errno)));
    }
}

void Recorder::on_received(SimTime now, board::Channel channel, std::string_view line, board::Verdict) {
    // What came as a datagram is kept as one.
    if (channel != board::Channel::network) {
        write(now,
              record::recording_line(now, board::other_end(channel), "line", protocol::mask_secrets(line)));
    }
}

void Recorder::on_sent(SimTime now, board::Channel channel, std::string_view line) {
    if (channel != board::Channel::network) {
        write(now,
              record::recording_line(now, board::own_end(channel), "line", protocol::mask_secrets(line)));
    }
}

void Recorder::on_world(SimTime now, std::string_view words) {
    write(now, record::recording_line(now, from_name(record::RecordedLine::From::world), "do", words));
}

void Recorder::on_datagram(SimTime now, std::uint64_t peer, bool to_board, std::string_view bytes) {
    using From = record::RecordedLine::From;
    // Longer ones are neither pieces of files nor requests, and would not fit into a line of a recording.
    const std::string_view kept = bytes.substr(0, max_datagram);
    write(now, record::recording_line(
                   {now, to_board ? From::network : From::module, protocol::mask_secrets(kept), peer}));
}

void Recorder::write(SimTime now, const std::string& text) {
    if (!fd_) {
        return;
    }
    const bool behind = !waiting_.empty();
    const std::string& all = behind ? waiting_.append(text) : text;
    std::size_t done = 0;
    const int error = put(all, done);
    if (error != 0 && error != EAGAIN) {
        return give_up(now, std::system_category().message(error), done);
    }
    ++lines_;
    if (behind) {
        waiting_.erase(0, done);
    } else {
        waiting_.assign(text, done);
    }
    if (waiting_.size() > max_waiting) {
        give_up(now, "who reads the pipe does not keep up", 0);
    }
}

/// `done` bytes of it went; 0 or an errno.
int Recorder::put(std::string_view text, std::size_t& done) {
    while (done < text.size()) {
        const ssize_t count = ::write(fd_.get(), text.data() + done, text.size() - done);
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            return count < 0 ? errno : EIO;
        }
        done += static_cast<std::size_t>(count);
    }
    return 0;
}

void Recorder::give_up(SimTime now, const std::string& why, std::size_t torn) {
    // Half a line would make the whole recording unreadable. On a pipe this fails and does no harm.
    const off_t end = ::lseek(fd_.get(), 0, SEEK_CUR);
    if (torn != 0 && end >= 0) {
        [[maybe_unused]] const int cut = ::ftruncate(fd_.get(), end - static_cast<off_t>(torn));
    }
    fd_.reset();
    waiting_ = {};
    if (on_trouble_) {
        on_trouble_(now, fmt::format("the recording {} ends here, after {} lines: {}", file_, lines_, why));
    }
}

}  // namespace fauxboard::host
