// Every call of the system fails once, and for good: the real program says a clear sentence or goes on. It
// never hangs, leaves half a file, or ends as if it had found a bug of its own.

#include <doctest/doctest.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "emulator/host/eeprom_file.h"
#include "tests/link/helpers.h"

namespace fauxboard::world {
namespace {

namespace fs = std::filesystem;
using link::test::TemporaryFolder;

/// Nothing is ever waited for that long in a passing test.
constexpr int patience_ms = 60'000;
constexpr int killed = 1000;
constexpr int hung = 2000;

struct Failing {
    const char* call;
    int error;
    long most;  ///< so many of its calls are tried one by one here; FAUXBOARD_ALL_CALLS tries all
};

constexpr std::array table{
    Failing{"read", EIO, 12},
    Failing{"write", ENOSPC, 12},
    Failing{"open", EMFILE, 12},
    Failing{"openat", EIO, 12},
    Failing{"pread", EIO, 8},
    Failing{"pwrite", ENOSPC, 8},
    Failing{"fsync", EIO, 6},
    Failing{"rename", EIO, 4},
    Failing{"renameat", ENOSPC, 4},
    Failing{"epoll_wait", EINTR, 8},
    Failing{"epoll_ctl", ENOMEM, 8},
    Failing{"epoll_create1", EMFILE, 2},
    Failing{"timerfd_create", EMFILE, 2},
    Failing{"timerfd_settime", EINVAL, 4},
    Failing{"inotify_init1", EMFILE, 2},
    Failing{"inotify_add_watch", ENOSPC, 4},
    Failing{"accept4", EMFILE, 2},
    Failing{"socket", EMFILE, 4},
    Failing{"bind", EADDRINUSE, 3},
    Failing{"listen", EADDRINUSE, 3},
    Failing{"sendto", EPIPE, 4},
    Failing{"poll", EINTR, 6},
    Failing{"pipe2", EMFILE, 2},
    Failing{"ftruncate", EIO, 2},
    Failing{"malloc", ENOMEM, 0},
};

/// A short life that uses all there is: files, sockets, a recording, the EEPROM, the place of a job.
class Life {
  public:
    Life() {
        fs::create_directory(folder_.file("sd"));
        std::ofstream(folder_.file("sd/part.gco")) << "M104 S60\nG28\nG1 X10\nG1 X20\n";
        std::ofstream(folder_.file("play.json")) << R"({
  "name": "play", "profile": "geeetech-a30t",
  "steps": [ { "do": "eeprom.save" }, { "wait": "2s" }, { "request": "M105" }, { "wait": "3s" } ]
})";
    }

    /// The exit code of one run in which a call fails; `happened` whether there was such a call at all.
    int run(const Failing& failing, long nth, bool ever, bool& happened, std::string& said) {
        const std::string mark = folder_.file("mark");
        fs::remove(mark);
        const int errors = ::open("/tmp", O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
        const pid_t pid = ::fork();
        if (pid == 0) {
            become(failing, nth, ever, mark, errors);
        }
        const int code = wait(pid);
        happened = fs::exists(mark);
        said.resize(4096);
        const ssize_t size = ::pread(errors, said.data(), said.size(), 0);
        said.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
        ::close(errors);
        return code;
    }

    /// Whether what is kept on disk is as it was before or as it is to be, and not in between.
    bool files_are_whole() const {
        std::ifstream in(folder_.file("eeprom"), std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        return text.empty() || host::eeprom_image(text).has_value();
    }

  private:
    [[noreturn]] void become(const Failing& failing, long nth, bool ever, const std::string& mark,
                             int errors) {
        ::setenv("LD_PRELOAD", FAUXBOARD_FAILING_CALLS, 1);
        ::setenv("FAIL_CALL", failing.call, 1);
        ::setenv("FAIL_NTH", std::to_string(nth).c_str(), 1);
        ::setenv("FAIL_ERROR", std::to_string(failing.error).c_str(), 1);
        ::setenv("FAIL_EVER", ever ? "1" : "0", 1);
        ::setenv("FAIL_MARK", mark.c_str(), 1);
        std::vector<std::string> args{FAUXBOARD_PROGRAM,
                                      "run",
                                      "--tcp",
                                      ":0",
                                      "--host-tcp",
                                      ":0",
                                      "--udp",
                                      ":0",
                                      "--script",
                                      folder_.file("play.json"),
                                      "--speed",
                                      "max",
                                      "--sd",
                                      folder_.file("sd"),
                                      "--eeprom",
                                      folder_.file("eeprom"),
                                      "--record",
                                      folder_.file("talk.jsonl"),
                                      "--control",
                                      folder_.file("control")};
        std::vector<char*> words;
        for (std::string& arg : args) {
            words.push_back(arg.data());
        }
        words.push_back(nullptr);
        ::dup2(::open("/dev/null", O_RDWR), 1);
        ::dup2(errors, 2);
        ::execv(words[0], words.data());
        ::_exit(127);
    }

    static int wait(pid_t pid) {
        const link::UniqueFd process(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
        pollfd entry{.fd = process.get(), .events = POLLIN, .revents = 0};
        if (::poll(&entry, 1, patience_ms) <= 0) {
            ::kill(pid, SIGKILL);
            ::waitpid(pid, nullptr, 0);
            return hung;
        }
        int status = 0;
        ::waitpid(pid, &status, 0);
        return WIFSIGNALED(status) ? killed + WTERMSIG(status) : WEXITSTATUS(status);
    }

    TemporaryFolder folder_;
};

#if defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;  // which wants to be loaded before all others
#elif defined(__has_feature)
constexpr bool sanitized = __has_feature(address_sanitizer);
#else
constexpr bool sanitized = false;
#endif

// Takes minutes: build/test_world --no-skip; FAUXBOARD_ALL_CALLS=1 for each of them.
TEST_CASE("every call of the system fails once and for good, and nothing worse comes of it" *
          doctest::skip()) {
    if (sanitized) {
        MESSAGE("skipped: nothing can be preloaded into a program under a sanitizer");
        return;
    }
    const bool all = std::getenv("FAUXBOARD_ALL_CALLS") != nullptr;
    Life life;
    std::size_t tried = 0;
    std::map<int, std::size_t> outcomes;
    for (const Failing& failing : table) {
        for (const bool ever : {false, true}) {
            bool happened = true;
            const long most = all ? 100'000 : failing.most;
            for (long nth = 1; happened && nth <= most; ++nth) {
                std::string said;
                const int code = life.run(failing, nth, ever, happened, said);
                if (!happened) {
                    break;
                }
                CAPTURE(failing.call);
                CAPTURE(nth);
                CAPTURE(ever);
                CAPTURE(said);
                CHECK(code != hung);
                CHECK(code < killed);
                CHECK(code != 70);
                CHECK((code == 0 || !said.empty()));
                CHECK(life.files_are_whole());
                ++tried;
                ++outcomes[code];
            }
        }
    }
    std::string told;
    for (const auto& [code, count] : outcomes) {
        told += fmt::format("; {} ended with {}", count, code);
    }
    MESSAGE(tried << " failing calls" << told);
    CHECK(tried > 100);
}

}  // namespace
}  // namespace fauxboard::world
