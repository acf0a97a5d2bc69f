#include "emulator/host/log_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "emulator/host/plain_text.h"
#include "emulator/link/host_error.h"

namespace fauxboard::host {
namespace {

std::string error_text(int error) {
    return std::system_category().message(error);
}

/// The first bytes of a plain file; empty when there is none. Waits for nothing.
std::string beginning(const std::string& path, std::size_t size) {
    const link::UniqueFd fd(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    struct stat what {};
    if (!fd || ::fstat(fd.get(), &what) != 0 || !S_ISREG(what.st_mode)) {
        return {};
    }
    std::string out(size, '\0');
    const ssize_t count = ::read(fd.get(), out.data(), out.size());
    out.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    return out;
}

}  // namespace

LogFile::LogFile(Options options, OnTrouble on_trouble)
    : options_(std::move(options)), on_trouble_(std::move(on_trouble)) {
    open(0);
    for (unsigned age = 0; is_plain_ && age < options_.files; ++age) {
        if (!is_ours(path_of(age))) {
            throw link::HostError(fmt::format(
                "{} is no log of fauxboard's, and would be written over. Move it away, or name another file.",
                path_of(age)));
        }
    }
    if (bytes_ != 0 && beginning(options_.path, options_.head.size()) != options_.head) {
        rotate();
    } else if (bytes_ == 0) {
        begin();
    }
}

bool LogFile::is_ours(const std::string& path) {
    struct stat what {};
    if (::lstat(path.c_str(), &what) != 0) {
        return true;
    }
    const std::string head = beginning(path, std::max(text_mark.size(), json_mark.size()));
    return (S_ISREG(what.st_mode) && what.st_size == 0) || head.starts_with(text_mark) ||
           head.starts_with(json_mark);
}

std::string LogFile::path_of(const std::string& path, unsigned age) {
    return age == 0 ? path : fmt::format("{}.{}", path, age);
}

// O_NONBLOCK: a pipe must have its reader now, and is never waited for. Files do not know it.
void LogFile::open(int more_flags) {
    fd_.reset(::open(options_.path.c_str(),
                     O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NOCTTY | O_NONBLOCK | more_flags, 0600));
    struct stat what {};
    if (!fd_ && errno == ENXIO) {
        throw link::HostError(
            fmt::format("The log {} is a pipe that nobody reads. Start its reader first, or name a file.",
                        options_.path));
    }
    if (!fd_ || ::fstat(fd_.get(), &what) != 0) {
        throw link::HostError(
            fmt::format("The log {} cannot be written ({}). Name a file in a folder of yours.", options_.path,
                        error_text(errno)));
    }
    is_plain_ = S_ISREG(what.st_mode);
    bytes_ = is_plain_ ? static_cast<std::uintmax_t>(what.st_size) : 0;
    if (is_plain_ && ::flock(fd_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        throw link::HostError(
            fmt::format("Another fauxboard writes the log {}. Each needs one of its own.", options_.path));
    }
    out_.emplace(fd_.get());
}

void LogFile::begin() {
    bytes_ = 0;
    if (!put(options_.head)) {
        ++left_out_;
    }
}

/// FILE.3 becomes FILE.4, and so on; a new FILE begins.
void LogFile::rotate() {
    for (unsigned age = 1; age < options_.files; ++age) {
        if (!is_ours(path_of(age))) {
            return give_up(path_of(age) + " is there, and no log of fauxboard's");
        }
    }
    for (unsigned age = options_.files - 1; age > 0; --age) {
        const std::string to = path_of(age);
        if (std::rename(path_of(age - 1).c_str(), to.c_str()) != 0 && errno != ENOENT) {
            return give_up(fmt::format("it cannot be renamed to {}: {}", to, error_text(errno)));
        }
    }
    try {
        if (options_.files == 1) {
            open(O_TRUNC);
        } else {
            open(O_EXCL);
        }
    } catch (const link::HostError& error) {
        return give_up(error.what());
    }
    begin();
}

void LogFile::write(std::string_view line) {
    if (out_ && is_plain_ && bytes_ > options_.head.size() + 1 &&
        bytes_ + line.size() >= options_.most_bytes) {
        rotate();
    }
    if (!out_) {
        return;
    }
    if (left_out_ != 0 &&
        put(fmt::format("{} lines were left out here: they could not be written", left_out_))) {
        left_out_ = 0;
        told_ = false;
    }
    if (left_out_ == 0 && put(line)) {
        return;
    }
    ++left_out_;
    if (!std::exchange(told_, true) && on_trouble_) {
        const int error = out_->error();
        on_trouble_(fmt::format("the log {} takes no more ({}); lines are left out of it until it does",
                                options_.path,
                                error == 0 ? "its reader does not keep up" : error_text(error)));
    }
}

bool LogFile::put(std::string_view line) {
    const std::string text = plain_line(line) + "\n";
    if (out_->write(text)) {
        bytes_ += text.size();
        return true;
    }
    if (is_plain_) {  // half a line
        [[maybe_unused]] const int cut = ::ftruncate(fd_.get(), static_cast<off_t>(bytes_));
    }
    return false;
}

void LogFile::give_up(const std::string& why) {
    out_.reset();
    fd_.reset();
    if (on_trouble_) {
        on_trouble_(fmt::format("the log {} ends here: {}", options_.path, why));
    }
}

}  // namespace fauxboard::host
