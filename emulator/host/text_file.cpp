#include "emulator/host/text_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "emulator/link/unique_fd.h"

namespace fauxboard::host {
namespace {

FileText trouble(std::string clause) {
    return {std::nullopt, std::move(clause)};
}

FileText system_trouble(int error) {
    return error == ENOENT || error == ENOTDIR
               ? FileText{}
               : trouble("it cannot be read (" + std::system_category().message(error) + ")");
}

}  // namespace

FileText read_text_file(const std::filesystem::path& file) {
    // O_NONBLOCK: a pipe would wait for its writer.
    const link::UniqueFd fd(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    struct stat info {};
    if (!fd || ::fstat(fd.get(), &info) != 0) {
        return system_trouble(errno);
    }
    if (!S_ISREG(info.st_mode)) {
        return trouble("it is no plain file");
    }
    std::string text;
    std::array<char, 16384> buffer;
    for (;;) {
        const ssize_t count = ::read(fd.get(), buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count < 0) {
            return system_trouble(errno);
        }
        if (count == 0) {
            return {std::move(text), {}};
        }
        text.append(buffer.data(), static_cast<std::size_t>(count));
        // Counted as it comes: some files are larger than they say.
        if (text.size() > max_text_file_bytes) {
            return trouble("it is larger than 4 MiB");
        }
    }
}

}  // namespace fauxboard::host
