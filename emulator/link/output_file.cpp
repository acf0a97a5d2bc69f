#include "emulator/link/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <random>
#include <system_error>
#include <utility>

#include "emulator/link/error_text.h"
#include "emulator/link/host_error.h"

namespace fauxboard::link {
namespace {

/// That the reader of a pipe has to take a report.
constexpr std::chrono::seconds report_patience{5};
/// At a name that nobody else has.
constexpr int attempts = 100;
constexpr std::string_view too_slow = "who reads the pipe does not keep up";

[[noreturn]] void refuse(std::string_view what, std::string_view why) {
    throw HostError(fmt::format("{} cannot be written ({}). Name a file in a folder of yours.", what, why));
}

/// As it is, but nobody else's. O_NONBLOCK: a pipe must have its reader now, and is never waited for. Files
/// do not know it.
UniqueFd claim_output(const std::string& file, std::string_view what, struct stat& info) {
    UniqueFd fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, 0666));
    if (!fd && errno == ENXIO) {
        const bool pipe = ::stat(file.c_str(), &info) == 0 && S_ISFIFO(info.st_mode);
        refuse(what, pipe ? "it is a pipe that nobody reads: start its reader first"
                          : "it is a socket, or a device that is not there");
    }
    if (!fd || ::fstat(fd.get(), &info) != 0) {
        refuse(what, error_text(errno));
    }
    // Two that write one file would leave something that nobody can read.
    if (S_ISREG(info.st_mode) && ::flock(fd.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        throw HostError(
            fmt::format("{} is being written by another that runs. Name a file of its own.", what));
    }
    return fd;
}

UniqueFd open_output(const std::string& file, std::string_view what) {
    struct stat info {};
    UniqueFd fd = claim_output(file, what, info);
    if (S_ISREG(info.st_mode) && ::ftruncate(fd.get(), 0) != 0) {
        refuse(what, error_text(errno));
    }
    return fd;
}

/// `done` bytes of it went; 0 or an errno.
int write_on(int fd, std::string_view bytes, std::size_t& done) {
    while (done < bytes.size()) {
        const ssize_t count = ::write(fd, bytes.data() + done, bytes.size() - done);
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
        if (const int error = write_on(fd_.get(), piece, done); error != 0 && error != EAGAIN) {
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
    const int error = fd_ ? catch_up(std::max(patience_, end_patience)) : 0;
    fd_.reset();
    return error == 0 ? std::string() : error == EAGAIN ? std::string(too_slow) : error_text(error);
}

/// What waits goes, as far as the reader takes it. 0, EAGAIN when something is left, or another errno.
int OutputFile::catch_up(std::chrono::milliseconds patience) {
    const auto until = std::chrono::steady_clock::now() + patience;
    for (;;) {
        std::size_t done = 0;
        const int error = write_on(fd_.get(), waiting_, done);
        waiting_.erase(0, done);
        const auto left =
            std::chrono::ceil<std::chrono::milliseconds>(until - std::chrono::steady_clock::now()).count();
        pollfd entry{.fd = fd_.get(), .events = POLLOUT, .revents = 0};
        if (error != EAGAIN || left <= 0 || ::poll(&entry, 1, static_cast<int>(left)) <= 0) {
            return error;
        }
    }
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

namespace {

/// Into what is no plain file: a pipe, a terminal. Empty, or why not.
std::string write_into(const std::string& file, std::string_view what, std::string_view bytes) {
    OutputFile out(file, what, report_patience);
    constexpr std::size_t piece = OutputFile::max_waiting / 2;
    std::string why;
    for (std::size_t at = 0; at < bytes.size() && why.empty(); at += piece) {
        why = out.append(bytes.substr(at, piece));
    }
    return why.empty() ? out.finish() : why;
}

/// A file of a name beside `file` that nobody has; no descriptor, with errno, when there is to be none.
UniqueFd make_beside(const std::string& file, std::string& name) {
    std::random_device random;
    UniqueFd fd;
    for (int i = 0; i < attempts && !fd && (i == 0 || errno == EEXIST); ++i) {
        name = fmt::format("{}.{:08x}", file, random());
        fd = UniqueFd(::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    }
    return fd;
}

/// A new file beside `file`, which takes its name when it is whole. Empty, or why not.
std::string replace_whole(const std::string& file, std::string_view what, std::string_view bytes) {
    struct stat old {};
    const bool there = ::stat(file.c_str(), &old) == 0;
    const UniqueFd claimed = there ? claim_output(file, what, old) : UniqueFd{};
    std::string fresh;
    const UniqueFd fd = make_beside(file, fresh);
    if (!fd) {
        return error_text(errno);
    }
    std::size_t done = 0;
    int error = there && ::fchmod(fd.get(), old.st_mode & 0777U) != 0 ? errno : 0;
    error = error == 0 ? write_on(fd.get(), bytes, done) : error;
    if (error == 0 && std::rename(fresh.c_str(), file.c_str()) != 0) {
        error = errno;
    }
    if (error != 0) {
        ::unlink(fresh.c_str());
    }
    return error == 0 ? std::string() : error_text(error);
}

}  // namespace

void write_output(const std::string& file, std::string_view what, std::string_view bytes) {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    const bool plain = !fs::exists(status) || fs::is_regular_file(status);
    // Its target is what is written, and a symlink stays a symlink.
    const fs::path real = fs::weakly_canonical(fs::absolute(file, error), error);
    const std::string why =
        plain && !error ? replace_whole(real.string(), what, bytes) : write_into(file, what, bytes);
    if (!why.empty()) {
        refuse(what, why);
    }
}

}  // namespace fauxboard::link
