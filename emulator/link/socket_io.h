#pragma once

#include <sys/socket.h>
#include <sys/types.h>

#include <cstddef>

namespace fauxboard::link {

/// As ::read and ::write, but never block and never raise SIGPIPE, whatever the socket's mode.
inline ssize_t read_socket(int fd, char* data, std::size_t size) {
    return ::recv(fd, data, size, MSG_DONTWAIT);
}

inline ssize_t write_socket(int fd, const char* data, std::size_t size) {
    return ::send(fd, data, size, MSG_DONTWAIT | MSG_NOSIGNAL);
}

}  // namespace fauxboard::link
