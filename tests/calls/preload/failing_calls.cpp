// Preloaded into the real program: the n-th call of one of the system's functions fails, once or from then
// on.
//
//   FAIL_CALL=write FAIL_NTH=3 FAIL_ERROR=5 FAIL_EVER=1 LD_PRELOAD=libfailing_calls.so fauxboard run ...
//
// A file of the name FAIL_MARK appears when it has happened, so that whoever counts n up knows when to end.

#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/epoll.h>
#include <sys/file.h>
#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <sys/random.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/timerfd.h>
#include <sys/uio.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Plan {
    const char* call = std::getenv("FAIL_CALL");
    long nth = number("FAIL_NTH", 0);
    int error = static_cast<int>(number("FAIL_ERROR", EIO));
    bool ever = number("FAIL_EVER", 0) != 0;
    const char* mark = std::getenv("FAIL_MARK");
    std::atomic<long> count{0};

    static long number(const char* name, long otherwise) {
        const char* const text = std::getenv(name);
        return text == nullptr ? otherwise : std::atol(text);
    }
};

Plan& plan() {
    static Plan one;
    return one;
}

template <class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

/// What libraries do before main() is theirs, and not counted.
using Main = int(int, char**, char**);
Main* real_main = nullptr;
std::atomic<bool> begun{false};

int main_begins(int argc, char** argv, char** environment) {
    begun = true;
    return real_main(argc, argv, environment);
}

/// Whether this call of `name` is to fail; errno is set then.
bool fails(const char* name) {
    if (!begun) {
        return false;
    }
    Plan& p = plan();
    if (p.call == nullptr || std::strcmp(p.call, name) != 0) {
        return false;
    }
    const long n = ++p.count;
    if (n != p.nth && !(p.ever && n > p.nth)) {
        return false;
    }
    if (p.mark != nullptr && n == p.nth) {
        // By number: the functions' own names may be those that fail.
        static const auto real = next<int (*)(const char*, int, ...)>("open");
        const int fd = real(p.mark, O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
        static const auto real_close = next<int (*)(int)>("close");
        real_close(fd);
    }
    errno = p.error;
    return true;
}

}  // namespace

#define FAUXBOARD_FAILING(result, name, parameters, arguments, failure)      \
    extern "C" result name parameters {                                      \
        static const auto real = next<result(*) parameters>(#name);          \
        return fails(#name) ? static_cast<result>(failure) : real arguments; \
    }

FAUXBOARD_FAILING(ssize_t, read, (int fd, void* data, size_t size), (fd, data, size), -1)
FAUXBOARD_FAILING(ssize_t, write, (int fd, const void* data, size_t size), (fd, data, size), -1)
FAUXBOARD_FAILING(ssize_t, pread64, (int fd, void* data, size_t size, off64_t at), (fd, data, size, at), -1)
FAUXBOARD_FAILING(ssize_t, pread, (int fd, void* data, size_t size, off_t at), (fd, data, size, at), -1)
FAUXBOARD_FAILING(ssize_t, pwrite, (int fd, const void* data, size_t size, off_t at), (fd, data, size, at),
                  -1)
FAUXBOARD_FAILING(ssize_t, pwrite64, (int fd, const void* data, size_t size, off64_t at),
                  (fd, data, size, at), -1)
FAUXBOARD_FAILING(ssize_t, writev, (int fd, const iovec* pieces, int count), (fd, pieces, count), -1)
FAUXBOARD_FAILING(int, fsync, (int fd), (fd), -1)
FAUXBOARD_FAILING(int, ftruncate, (int fd, off_t size), (fd, size), -1)
FAUXBOARD_FAILING(int, rename, (const char* from, const char* to), (from, to), -1)
FAUXBOARD_FAILING(int, renameat, (int a, const char* from, int b, const char* to), (a, from, b, to), -1)
FAUXBOARD_FAILING(int, epoll_wait, (int fd, epoll_event* events, int most, int wait),
                  (fd, events, most, wait), -1)
FAUXBOARD_FAILING(int, epoll_ctl, (int fd, int operation, int other, epoll_event* event),
                  (fd, operation, other, event), -1)
FAUXBOARD_FAILING(int, epoll_create1, (int flags), (flags), -1)
FAUXBOARD_FAILING(int, timerfd_create, (int clock, int flags), (clock, flags), -1)
FAUXBOARD_FAILING(int, timerfd_settime, (int fd, int flags, const itimerspec* to, itimerspec* was),
                  (fd, flags, to, was), -1)
FAUXBOARD_FAILING(int, inotify_init1, (int flags), (flags), -1)
FAUXBOARD_FAILING(int, inotify_add_watch, (int fd, const char* path, uint32_t mask), (fd, path, mask), -1)
FAUXBOARD_FAILING(int, accept4, (int fd, sockaddr* address, socklen_t* size, int flags),
                  (fd, address, size, flags), -1)
FAUXBOARD_FAILING(int, socket, (int domain, int type, int protocol), (domain, type, protocol), -1)
FAUXBOARD_FAILING(int, bind, (int fd, const sockaddr* address, socklen_t size), (fd, address, size), -1)
FAUXBOARD_FAILING(int, listen, (int fd, int backlog), (fd, backlog), -1)
FAUXBOARD_FAILING(ssize_t, sendto,
                  (int fd, const void* data, size_t size, int flags, const sockaddr* to, socklen_t to_size),
                  (fd, data, size, flags, to, to_size), -1)
FAUXBOARD_FAILING(ssize_t, send, (int fd, const void* data, size_t size, int flags), (fd, data, size, flags),
                  -1)
FAUXBOARD_FAILING(ssize_t, recv, (int fd, void* data, size_t size, int flags), (fd, data, size, flags), -1)
FAUXBOARD_FAILING(ssize_t, recvfrom,
                  (int fd, void* data, size_t size, int flags, sockaddr* from, socklen_t* from_size),
                  (fd, data, size, flags, from, from_size), -1)
FAUXBOARD_FAILING(int, posix_openpt, (int flags), (flags), -1)
FAUXBOARD_FAILING(int, grantpt, (int fd), (fd), -1)
FAUXBOARD_FAILING(int, tcgetattr, (int fd, termios* settings), (fd, settings), -1)
FAUXBOARD_FAILING(int, tcsetattr, (int fd, int when, const termios* settings), (fd, when, settings), -1)
FAUXBOARD_FAILING(int, symlink, (const char* to, const char* path), (to, path), -1)
FAUXBOARD_FAILING(int, unlink, (const char* path), (path), -1)
FAUXBOARD_FAILING(int, unlinkat, (int folder, const char* path, int flags), (folder, path, flags), -1)
FAUXBOARD_FAILING(int, flock, (int fd, int operation), (fd, operation), -1)
FAUXBOARD_FAILING(int, fstat, (int fd, struct stat* out), (fd, out), -1)
FAUXBOARD_FAILING(int, fstatat, (int folder, const char* path, struct stat* out, int flags),
                  (folder, path, out, flags), -1)
FAUXBOARD_FAILING(int, pipe2, (int* ends, int flags), (ends, flags), -1)
FAUXBOARD_FAILING(int, poll, (pollfd * entries, nfds_t count, int wait), (entries, count, wait), -1)
FAUXBOARD_FAILING(int, connect, (int fd, const sockaddr* address, socklen_t size), (fd, address, size), -1)
FAUXBOARD_FAILING(int, setsockopt, (int fd, int level, int name, const void* value, socklen_t size),
                  (fd, level, name, value, size), -1)
FAUXBOARD_FAILING(int, getsockopt, (int fd, int level, int name, void* value, socklen_t* size),
                  (fd, level, name, value, size), -1)
FAUXBOARD_FAILING(int, getsockname, (int fd, sockaddr* address, socklen_t* size), (fd, address, size), -1)
FAUXBOARD_FAILING(int, getpeername, (int fd, sockaddr* address, socklen_t* size), (fd, address, size), -1)
FAUXBOARD_FAILING(int, getnameinfo,
                  (const sockaddr* address, socklen_t size, char* host, socklen_t host_size, char* service,
                   socklen_t service_size, int flags),
                  (address, size, host, host_size, service, service_size, flags), EAI_FAIL)
FAUXBOARD_FAILING(int, shutdown, (int fd, int how), (fd, how), -1)
FAUXBOARD_FAILING(ssize_t, sendmsg, (int fd, const msghdr* message, int flags), (fd, message, flags), -1)
FAUXBOARD_FAILING(int, ptsname_r, (int fd, char* name, size_t size), (fd, name, size), errno)
FAUXBOARD_FAILING(int, unlockpt, (int fd), (fd), -1)
FAUXBOARD_FAILING(int, chmod, (const char* path, mode_t mode), (path, mode), -1)
FAUXBOARD_FAILING(int, fchmod, (int fd, mode_t mode), (fd, mode), -1)
FAUXBOARD_FAILING(int, faccessat, (int folder, const char* path, int mode, int flags),
                  (folder, path, mode, flags), -1)
FAUXBOARD_FAILING(off_t, lseek, (int fd, off_t to, int from), (fd, to, from), -1)
FAUXBOARD_FAILING(int, stat, (const char* path, struct stat* out), (path, out), -1)
FAUXBOARD_FAILING(int, lstat, (const char* path, struct stat* out), (path, out), -1)
FAUXBOARD_FAILING(ssize_t, readlink, (const char* path, char* out, size_t size), (path, out, size), -1)
FAUXBOARD_FAILING(int, mkdir, (const char* path, mode_t mode), (path, mode), -1)
FAUXBOARD_FAILING(int, mkostemp, (char* name, int flags), (name, flags), -1)
FAUXBOARD_FAILING(DIR*, fdopendir, (int fd), (fd), nullptr)
FAUXBOARD_FAILING(dirent*, readdir, (DIR * folder), (folder), nullptr)
FAUXBOARD_FAILING(ssize_t, getrandom, (void* out, size_t size, unsigned flags), (out, size, flags), -1)
FAUXBOARD_FAILING(int, sigaction, (int number, const struct sigaction* now, struct sigaction* was),
                  (number, now, was), -1)
FAUXBOARD_FAILING(int, setrlimit, (__rlimit_resource_t which, const rlimit* to), (which, to), -1)
FAUXBOARD_FAILING(void*, malloc, (size_t size), (size), nullptr)
FAUXBOARD_FAILING(void*, realloc, (void* old, size_t size), (old, size), nullptr)

// dlsym() itself asks for memory by this one.
extern "C" void* __libc_calloc(size_t count, size_t size);
extern "C" void* calloc(size_t count, size_t size) {
    return fails("calloc") ? nullptr : __libc_calloc(count, size);
}

// Whatever it says, the descriptor is gone.
extern "C" int close(int fd) {
    static const auto real = next<int (*)(int)>("close");
    const int result = real(fd);
    return fails("close") ? -1 : result;
}

extern "C" int __libc_start_main(Main* program, int argc, char** argv, void (*init)(), void (*fini)(),
                                 void (*linker_fini)(), void* stack) {
    static const auto real =
        next<int (*)(Main*, int, char**, void (*)(), void (*)(), void (*)(), void*)>("__libc_start_main");
    real_main = program;
    return real(main_begins, argc, argv, init, fini, linker_fini, stack);
}

// With one optional argument, which is handed on as it is.
extern "C" int ioctl(int fd, unsigned long request, ...) {
    static const auto real = next<int (*)(int, unsigned long, ...)>("ioctl");
    va_list rest;
    va_start(rest, request);
    void* const argument = va_arg(rest, void*);
    va_end(rest);
    return fails("ioctl") ? -1 : real(fd, request, argument);
}

extern "C" int fcntl(int fd, int command, ...) {
    static const auto real = next<int (*)(int, int, ...)>("fcntl");
    va_list rest;
    va_start(rest, command);
    void* const argument = va_arg(rest, void*);
    va_end(rest);
    return fails("fcntl") ? -1 : real(fd, command, argument);
}

extern "C" int open(const char* path, int flags, ...) {
    static const auto real = next<int (*)(const char*, int, ...)>("open");
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return fails("open") ? -1 : real(path, flags, mode);
}

extern "C" int openat(int folder, const char* path, int flags, ...) {
    static const auto real = next<int (*)(int, const char*, int, ...)>("openat");
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return fails("openat") ? -1 : real(folder, path, flags, mode);
}
