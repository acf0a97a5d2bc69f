#include "emulator/link/local_path.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cerrno>
#include <cstring>

#include "emulator/link/error_text.h"
#include "emulator/link/link.h"

namespace fauxboard::link {
namespace {

sockaddr_un address_of(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.empty() || path.size() >= sizeof address.sun_path || path.find('\0') != std::string::npos) {
        throw LinkError(
            fmt::format("\"{}\" cannot be the name of a socket: it has {} bytes, and 1 to {} can "
                        "be had. Choose a shorter path.",
                        path.substr(0, 200), path.size(), sizeof address.sun_path - 1));
    }
    path.copy(static_cast<char*>(address.sun_path), path.size());
    return address;
}

UniqueFd make_socket(const std::string& path, int more_flags) {
    UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | more_flags, 0));
    if (!fd) {
        throw LinkError(fmt::format("No socket for {}: {}.", path, error_text(errno)));
    }
    return fd;
}

/// 0, or what connect() says.
int connect_error(int fd, const sockaddr_un& address) {
    // The interface of sockets is older than void pointers.
    const auto* any = reinterpret_cast<const sockaddr*>(&address);  // NOLINT
    int result = 0;
    do {
        result = ::connect(fd, any, sizeof address);
    } while (result != 0 && errno == EINTR);
    return result == 0 ? 0 : errno;
}

/// Makes room for a new socket, if what is there is one that nobody listens on.
void remove_stale(const std::string& path, const sockaddr_un& address) {
    struct stat found {};
    if (::lstat(path.c_str(), &found) != 0) {
        return;  // gone, or out of reach: bind() finds the words
    }
    if (!S_ISSOCK(found.st_mode)) {
        throw LinkError(fmt::format("{} exists and is not a socket; choose another path.", path));
    }
    const UniqueFd probe = make_socket(path, SOCK_NONBLOCK);
    const int error = connect_error(probe.get(), address);
    if (error == ECONNREFUSED) {
        ::unlink(path.c_str());
    } else if (error == 0 || error == EAGAIN) {
        throw LinkError(fmt::format("{} is in use: a program listens there. Choose another path.", path));
    } else {
        throw LinkError(
            fmt::format("{} is a socket of which nobody can say whether it is in use ({}). Remove "
                        "it, or choose another path.",
                        path, error_text(error)));
    }
}

/// For a moment, nothing that this process makes is for others.
class PrivateUmask {
  public:
    PrivateUmask() : before_(::umask(0077)) {}
    ~PrivateUmask() { ::umask(before_); }
    PrivateUmask(const PrivateUmask&) = delete;
    PrivateUmask& operator=(const PrivateUmask&) = delete;

  private:
    mode_t before_;
};

}  // namespace

UniqueFd LocalPath::listen(const std::string& path) {
    remove();
    const sockaddr_un address = address_of(path);
    remove_stale(path, address);
    UniqueFd fd = make_socket(path, SOCK_NONBLOCK);
    // Linux gives the name the mode of the socket less the umask; elsewhere chmod() below is what counts, and
    // nobody can connect before listen().
    ::fchmod(fd.get(), 0600);
    const PrivateUmask umask;
    const auto* any = reinterpret_cast<const sockaddr*>(&address);  // NOLINT
    if (::bind(fd.get(), any, sizeof address) != 0) {
        throw LinkError(fmt::format("The socket {} cannot be made: {}.", path, error_text(errno)));
    }
    struct stat made {};
    path_ = path;
    if (::lstat(path.c_str(), &made) == 0) {
        device_ = made.st_dev;
        inode_ = made.st_ino;
    }
    if (::chmod(path.c_str(), 0600) != 0 || ::listen(fd.get(), SOMAXCONN) != 0) {
        const int error = errno;
        remove();
        throw LinkError(fmt::format("The socket {} cannot be listened on: {}.", path, error_text(error)));
    }
    return fd;
}

void LocalPath::remove() noexcept {
    struct stat found {};
    if (!path_.empty() && ::lstat(path_.c_str(), &found) == 0 && found.st_dev == device_ &&
        found.st_ino == inode_) {
        ::unlink(path_.c_str());
    }
    path_.clear();
}

UniqueFd connect_local(const std::string& path) {
    const sockaddr_un address = address_of(path);
    UniqueFd fd = make_socket(path, 0);
    switch (const int error = connect_error(fd.get(), address)) {
        case 0:
            return fd;
        case ENOENT:
            throw LinkError(
                fmt::format("There is no {}; `fauxboard run --control {}` makes it.", path, path));
        case ECONNREFUSED:
            throw LinkError(
                fmt::format("Nobody listens on {}: the board that made it has ended, or it is no "
                            "socket. `fauxboard run --control {}` starts one.",
                            path, path));
        default:
            throw LinkError(fmt::format("Cannot connect to {}: {}.", path, error_text(error)));
    }
}

}  // namespace fauxboard::link
