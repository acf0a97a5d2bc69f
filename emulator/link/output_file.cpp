#include "emulator/link/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "emulator/link/error_text.h"
#include "emulator/link/host_error.h"

namespace fauxboard::link {
namespace {

/// That the reader of a pipe has to take a report.
constexpr std::chrono::seconds report_patience{5};
constexpr std::string_view too_slow = "who reads the pipe does not keep up";

[[noreturn]] void refuse(std::string_view what, std::string_view why) {
    throw HostError(fmt::format("{} cannot be written ({}). Name a file in a folder of yours.", what, why));
}

// O_NONBLOCK: a pipe must have its reader now, and is never waited for. Files do not know it.
UniqueFd open_output(const std::string& file, std::string_view what) {
    UniqueFd fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, 0666));
    if (!fd && errno == ENXIO) {
        throw HostError(
            fmt::format("{} is a pipe that nobody reads. Start its reader first, or name a file.", what));
    }
    struct stat info {};
    if (!fd || ::fstat(fd.get(), &info) != 0) {
        refuse(what, error_text(errno));
    }
    if (!S_ISREG(info.st_mode)) {
        return fd;
    }
    // Two that write one file would leave something that nobody can read.
    if (::flock(fd.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        throw HostError(
            fmt::format("{} is being written by another that runs. Name a file of its own.", what));
    }
    if (::ftruncate(fd.get(), 0) != 0) {
        refuse(what, error_text(errno));
    }
    return fd;
}

}  // namespace

OutputFile::OutputFile(const std::string& file, std::string_view what, std::chrono::milliseconds patience)
    : patience_(patience), fd_(open_output(file, what)) {}

OutputFile::~OutputFile() {
    finish();
}

std::string OutputFile::append(std::string_view piece) {
    if (!fd_) {
        return {};
    }
    std::size_t done = 0;
    if (waiting_.empty()) {
        if (const int error = put(piece, done); error != 0 && error != EAGAIN) {
            return give_up(error_text(error), done);
        }
    }
    ++pieces_;
    waiting_ += piece.substr(done);
    if (!waiting_.empty()) {
        const int error = catch_up(waiting_.size() > max_waiting ? patience_ : std::chrono::milliseconds{0});
        if (error != 0 && error != EAGAIN) {
            return give_up(error_text(error), 0);
        }
    }
    return waiting_.size() > max_waiting ? give_up(std::string(too_slow), 0) : std::string();
}

std::string OutputFile::finish() {
    const int error = fd_ ? catch_up(patience_) : 0;
    fd_.reset();
    return error == 0 ? std::string() : error == EAGAIN ? std::string(too_slow) : error_text(error);
}

/// What waits goes, as far as the reader takes it. 0, EAGAIN when something is left, or another errno.
int OutputFile::catch_up(std::chrono::milliseconds patience) {
    const auto until = std::chrono::steady_clock::now() + patience;
    for (;;) {
        std::size_t done = 0;
        const int error = put(waiting_, done);
        waiting_.erase(0, done);
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(until - std::chrono::steady_clock::now()).count();
        pollfd entry{.fd = fd_.get(), .events = POLLOUT, .revents = 0};
        if (error != EAGAIN || left <= 0 || ::poll(&entry, 1, static_cast<int>(left)) <= 0) {
            return error;
        }
    }
}

/// `done` bytes of it went; 0 or an errno.
int OutputFile::put(std::string_view bytes, std::size_t& done) {
    while (done < bytes.size()) {
        const ssize_t count = ::write(fd_.get(), bytes.data() + done, bytes.size() - done);
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

std::string OutputFile::give_up(std::string why, std::size_t torn) {
    // Half a piece would make the whole file unreadable. On a pipe this fails and does no harm.
    const off_t end = ::lseek(fd_.get(), 0, SEEK_CUR);
    if (torn != 0 && end >= 0) {
        [[maybe_unused]] const int cut = ::ftruncate(fd_.get(), end - static_cast<off_t>(torn));
    }
    fd_.reset();
    waiting_ = {};
    return why;
}

void write_output(const std::string& file, std::string_view what, std::string_view bytes) {
    std::string why;
    {
        OutputFile out(file, what, report_patience);
        constexpr std::size_t piece = OutputFile::max_waiting / 2;
        for (std::size_t at = 0; at < bytes.size() && why.empty(); at += piece) {
            why = out.append(bytes.substr(at, piece));
        }
        why = why.empty() ? out.finish() : why;
    }
    struct stat info {};
    if (!why.empty()) {
        if (::stat(file.c_str(), &info) == 0 && S_ISREG(info.st_mode)) {
            ::unlink(file.c_str());
        }
        refuse(what, why);
    }
}

}  // namespace fauxboard::link
