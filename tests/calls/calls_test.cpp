// Every call of the system fails once, and for good: the real program says a clear sentence or goes on. It
// never hangs, leaves half a file, or ends as if it had found a bug of its own.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>

#include "tests/calls/short_life.h"

namespace fauxboard::calls {
namespace {

struct Failing {
    const char* call;
    int error;
    long most;  ///< so many of its calls are tried here; FAUXBOARD_ALL_CALLS tries each of them in each life
    Life life = Life::played;
    /// From one that is tried to the next, in all of them: there are very many.
    double further = 1;
};

constexpr std::array table{
    Failing{"read", EIO, 12},
    Failing{"read", EIO, 4, Life::shown},
    Failing{"write", ENOSPC, 12},
    Failing{"write", ENOSPC, 8, Life::shown},
    Failing{"writev", ENOSPC, 4, Life::shown},
    Failing{"open", EMFILE, 12},
    Failing{"openat", EIO, 12},
    Failing{"openat", EMFILE, 6, Life::uploaded},
    Failing{"pread", EIO, 8},
    Failing{"pwrite", ENOSPC, 6, Life::uploaded},
    Failing{"ftruncate", EIO, 4, Life::uploaded},
    Failing{"fsync", EIO, 6},
    Failing{"fsync", EIO, 4, Life::uploaded},
    Failing{"rename", EIO, 4},
    Failing{"renameat", EIO, 2, Life::uploaded},
    Failing{"unlink", EIO, 4},
    Failing{"unlinkat", EIO, 3, Life::uploaded},
    Failing{"fstat", EIO, 6},
    Failing{"fstatat", EIO, 4},
    Failing{"flock", EWOULDBLOCK, 3},
    Failing{"symlink", EACCES, 2, Life::met},
    Failing{"epoll_wait", EINTR, 6, Life::met},
    Failing{"epoll_ctl", ENOMEM, 10, Life::met},
    Failing{"epoll_ctl", ENOMEM, 6, Life::fleet},
    Failing{"epoll_create1", EMFILE, 2},
    Failing{"epoll_create1", EMFILE, 2, Life::uploaded},
    Failing{"timerfd_create", EMFILE, 2},
    Failing{"timerfd_settime", EINVAL, 4, Life::met},
    Failing{"inotify_init1", EMFILE, 2, Life::met},
    Failing{"inotify_add_watch", ENOSPC, 4, Life::met},
    Failing{"accept4", EMFILE, 2, Life::met},
    Failing{"accept4", EMFILE, 2, Life::uploaded},
    Failing{"socket", EMFILE, 4},
    Failing{"socket", EMFILE, 4, Life::fleet},
    Failing{"bind", EADDRINUSE, 3},
    Failing{"listen", EADDRINUSE, 3},
    Failing{"send", EPIPE, 4, Life::met},
    Failing{"sendto", EPERM, 4, Life::met},
    Failing{"sendto", EPERM, 4, Life::uploaded},
    Failing{"recv", ECONNRESET, 4, Life::met},
    Failing{"recvfrom", ECONNREFUSED, 4, Life::met},
    Failing{"posix_openpt", EMFILE, 2, Life::met},
    Failing{"grantpt", EACCES, 2, Life::met},
    Failing{"tcgetattr", EIO, 3, Life::met},
    Failing{"tcsetattr", EIO, 3, Life::met},
    Failing{"pipe2", EMFILE, 2},
    Failing{"close", EIO, 8},
    Failing{"close", EINTR, 8, Life::uploaded},
    Failing{"poll", EINTR, 4, Life::fleet},
    Failing{"connect", ECONNREFUSED, 2, Life::met},
    Failing{"setsockopt", ENOPROTOOPT, 6, Life::met},
    Failing{"setsockopt", ENOPROTOOPT, 6, Life::uploaded},
    Failing{"getsockopt", ENOPROTOOPT, 4, Life::met},
    Failing{"getsockname", ENOBUFS, 4},
    Failing{"getsockname", ENOBUFS, 4, Life::uploaded},
    Failing{"getpeername", ENOTCONN, 2, Life::met},
    Failing{"getnameinfo", EINVAL, 4, Life::met},
    Failing{"shutdown", ENOTCONN, 2, Life::uploaded},
    Failing{"sendmsg", EPIPE, 4, Life::uploaded},
    Failing{"ioctl", ENOTTY, 6, Life::met},
    Failing{"fcntl", EINVAL, 6, Life::uploaded},
    Failing{"ptsname_r", ENOTTY, 2, Life::met},
    Failing{"unlockpt", EINVAL, 2, Life::met},
    Failing{"chmod", EPERM, 2},
    Failing{"fchmod", EPERM, 3},
    Failing{"faccessat", EACCES, 2, Life::uploaded},
    Failing{"lseek", EIO, 3},
    Failing{"lstat", EIO, 3},
    Failing{"stat", EIO, 6},
    Failing{"readlink", EIO, 2},
    Failing{"mkdir", EACCES, 1, Life::shown},
    Failing{"mkostemp", EACCES, 2},
    Failing{"mkostemp", EACCES, 2, Life::shown},
    Failing{"fdopendir", ENOMEM, 2, Life::uploaded},
    Failing{"fdopendir", ENOMEM, 2, Life::shown},
    Failing{"readdir", EIO, 2, Life::shown},
    Failing{"getrandom", ENOSYS, 2, Life::uploaded},
    Failing{"sigaction", EINVAL, 2},
    Failing{"setrlimit", EPERM, 1, Life::fleet},
    Failing{"calloc", ENOMEM, 6, Life::uploaded, 1.5},
    Failing{"realloc", ENOMEM, 6, Life::uploaded, 1.5},
    Failing{"malloc", ENOMEM, 24, Life::played, 1.5},
};

/// The failing calls of one kind, and with which exit code how many of the runs ended.
struct Tried {
    long most_calls = 0;  ///< that there were in one life
    std::size_t runs = 0;
    std::map<int, std::size_t> outcomes;
};

/// Tries them until there is no such call any more, or `most` are tried. `further` > 1 leaves out some.
void try_calls(ShortLife& life, const Failing& failing, bool ever, long most, double further, Tried& tried) {
    long nth = 1;
    for (long i = 0; i < most; ++i) {
        const LifeEnd end = life.run({failing.call, failing.error, nth, ever});
        if (!end.happened) {
            return;  // there are not so many
        }
        // Whose every word fails cannot say that it does.
        const bool mute = ever && std::string_view(failing.call) == "write";
        const std::string what =
            fmt::format("{} number {}{}", failing.call, nth, ever ? " and all after" : "");
        CAPTURE(what);
        CAPTURE(end.said);
        CHECK(end.code != hung);
        CHECK(end.code < killed);
        CHECK(end.code != 70);
        CHECK((end.code == 0 || mute || !end.said.empty()));
        CHECK(end.torn == "");
        ++tried.runs;
        ++tried.outcomes[end.code];
        tried.most_calls = std::max(tried.most_calls, nth);
        nth = std::max(nth + 1, std::lround(static_cast<double>(nth) * further));
    }
}

std::string told(const char* call, Life life, const Tried& tried) {
    std::string line = fmt::format("\n{:<18}{:<10}{:>7} calls{:>6} runs", call, to_string(life),
                                   tried.most_calls, tried.runs);
    for (const auto& [code, count] : tried.outcomes) {
        line += fmt::format("   exit {}: {}", code, count);
    }
    return line;
}

std::string try_both(ShortLife& life, Life which, const Failing& failing, long most, double further,
                     std::size_t& runs) {
    Tried tried;
    for (const bool ever : {false, true}) {
        try_calls(life, failing, ever, most, further, tried);
    }
    runs += tried.runs;
    return tried.runs == 0 ? std::string() : told(failing.call, which, tried);
}

TEST_CASE("every call of the system fails once and for good, and nothing worse comes of it") {
    std::map<Life, std::unique_ptr<ShortLife>> lives;
    std::size_t runs = 0;
    std::string lines;
    for (const Failing& failing : table) {
        auto& life = lives[failing.life];
        life = life ? std::move(life) : std::make_unique<ShortLife>(failing.life);
        lines += try_both(*life, failing.life, failing, failing.most, failing.further, runs);
    }
    MESSAGE(runs << " failing calls" << lines);
    CHECK(runs > 200);
}

TEST_CASE("where no call fails, each life goes as it is meant to") {
    for (std::size_t i = 0; i < life_count; ++i) {
        CAPTURE(std::string(to_string(static_cast<Life>(i))));
        const LifeEnd end = ShortLife(static_cast<Life>(i)).run();
        CAPTURE(end.said);
        CHECK(end.code == 0);
        CHECK_FALSE(end.happened);
        CHECK(end.torn == "");
        CHECK(end.missing == "");
    }
}

TEST_CASE("an upload is on the disk for certain before it has its name, and is acknowledged after that") {
    ShortLife life(Life::uploaded);
    CHECK(life.run().acknowledged);
    for (const char* call : {"fsync", "renameat"}) {
        const LifeEnd end = life.run({call, EIO, 1, false});
        CHECK(end.happened);
        CHECK_FALSE(end.acknowledged);
        CHECK(end.torn == "");
    }
}

/// What FAUXBOARD_ALL_CALLS asks for: "1" is all, "uploaded" is one life, "uploaded,fleet:close,poll" is two
/// lives and two of the calls.
bool wanted(std::string_view which, std::string_view names) {
    const std::string all = fmt::format(",{},", names);
    return names.empty() || names == "1" || all.find(fmt::format(",{},", which)) != std::string::npos;
}

// FAUXBOARD_ALL_CALLS=1 build/test_calls -tc="*single call*" takes an hour. Memory is asked for a hundred
// thousand times in a life: of these each of the first thirty, and then each that is 5 % further.
TEST_CASE("every single call of the system in every life" *
          doctest::skip(std::getenv("FAUXBOARD_ALL_CALLS") == nullptr)) {
    const std::string_view asked = std::getenv("FAUXBOARD_ALL_CALLS");
    const auto colon = std::min(asked.find(':'), asked.size());
    const std::string_view calls = asked.substr(std::min(colon + 1, asked.size()));
    std::size_t runs = 0;
    for (std::size_t i = 0; i < life_count; ++i) {
        const auto which = static_cast<Life>(i);
        if (!wanted(to_string(which), asked.substr(0, colon))) {
            continue;
        }
        ShortLife life(which);
        std::map<std::string_view, bool> done;
        for (const Failing& failing : table) {
            if (wanted(failing.call, calls) && !std::exchange(done[failing.call], true)) {
                const std::string line = try_both(life, which, failing, std::numeric_limits<long>::max(),
                                                  failing.further > 1 ? 1.05 : 1, runs);
                MESSAGE(line);
            }
        }
    }
    MESSAGE(runs << " failing calls");
    CHECK(runs > (asked == "1" ? 2000 : 0));
}

}  // namespace
}  // namespace fauxboard::calls
