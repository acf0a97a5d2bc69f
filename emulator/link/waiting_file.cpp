#include "emulator/link/waiting_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>

#include "emulator/link/unique_fd.h"

namespace fauxboard::link {

bool must_be_waited_for(const std::string& file) {
    const UniqueFd fd(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    struct stat info {};
    if (!fd || ::fstat(fd.get(), &info) != 0 || !S_ISREG(info.st_mode)) {
        return false;
    }
    pollfd entry{.fd = fd.get(), .events = POLLIN, .revents = 0};  // real files are always ready
    return ::poll(&entry, 1, 0) == 0;
}

}  // namespace fauxboard::link
