#include "tools/file_source.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <limits>
#include <system_error>

#include "emulator/link/host_error.h"

namespace fauxboard::tools {

FileSource::FileSource(const std::string& path)
    // O_NONBLOCK: a pipe has no end to wait for.
    : fd_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {
    struct stat info {};
    if (!fd_ || ::fstat(fd_.get(), &info) != 0) {
        throw link::HostError(
            fmt::format("{} cannot be read: {}.", path, std::system_category().message(errno)));
    }
    if (!S_ISREG(info.st_mode)) {
        throw link::HostError(fmt::format("{} cannot be read: it is no file.", path));
    }
}

std::uint64_t FileSource::size() const {
    struct stat info {};
    return ::fstat(fd_.get(), &info) == 0 ? static_cast<std::uint64_t>(info.st_size) : 0;
}

std::size_t FileSource::read(std::uint64_t offset, std::span<char> out) const {
    if (offset > static_cast<std::uint64_t>(std::numeric_limits<off_t>::max())) {
        return 0;
    }
    std::size_t total = 0;
    while (total < out.size()) {
        const ssize_t got =
            ::pread(fd_.get(), out.data() + total, out.size() - total, static_cast<off_t>(offset + total));
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0) {
            break;
        }
        total += static_cast<std::size_t>(got);
    }
    return total;
}

}  // namespace fauxboard::tools
