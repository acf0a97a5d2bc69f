// Every call of the system fails once, and for good: the real program says a clear sentence or goes on. It
// never hangs, leaves half a file, or ends as if it had found a bug of its own.

#include <arpa/inet.h>
#include <doctest/doctest.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/host/eeprom_file.h"
#include "tests/link/helpers.h"

namespace fauxboard::world {
namespace {

namespace fs = std::filesystem;
using link::test::TemporaryFolder;

/// Nothing is ever waited for that long in a passing test.
constexpr int patience_ms = 20'000;
constexpr int killed = 1000;
constexpr int hung = 2000;

struct Failing {
    const char* call;
    int error;
    long most;  ///< so many of its calls are tried here; FAUXBOARD_ALL_CALLS tries each of them
    /// From one that is tried to the next, for those of which there are very many.
    double further = 1;
    enum class Life : std::uint8_t { played, met } life = Life::played;  ///< see ShortLife
};

constexpr std::array table{
    Failing{"read", EIO, 12},
    Failing{"write", ENOSPC, 12},
    Failing{"open", EMFILE, 12},
    Failing{"openat", EIO, 12},
    Failing{"pread", EIO, 8},
    Failing{"fsync", EIO, 6},
    Failing{"rename", EIO, 4},
    Failing{"unlink", EIO, 4},
    Failing{"fstat", EIO, 6},
    Failing{"fstatat", EIO, 4},
    Failing{"flock", EWOULDBLOCK, 3},
    Failing{"symlink", EACCES, 2, 1, Failing::Life::met},
    Failing{"epoll_wait", EINTR, 6, 1, Failing::Life::met},
    Failing{"epoll_ctl", ENOMEM, 10, 1, Failing::Life::met},
    Failing{"epoll_create1", EMFILE, 2},
    Failing{"timerfd_create", EMFILE, 2},
    Failing{"timerfd_settime", EINVAL, 4, 1, Failing::Life::met},
    Failing{"inotify_init1", EMFILE, 2, 1, Failing::Life::met},
    Failing{"inotify_add_watch", ENOSPC, 4, 1, Failing::Life::met},
    Failing{"accept4", EMFILE, 2, 1, Failing::Life::met},
    Failing{"socket", EMFILE, 4},
    Failing{"bind", EADDRINUSE, 3},
    Failing{"listen", EADDRINUSE, 3},
    Failing{"send", EPIPE, 4, 1, Failing::Life::met},
    Failing{"sendto", EPERM, 4, 1, Failing::Life::met},
    Failing{"recv", ECONNRESET, 4, 1, Failing::Life::met},
    Failing{"recvfrom", ECONNREFUSED, 4, 1, Failing::Life::met},
    Failing{"posix_openpt", EMFILE, 2, 1, Failing::Life::met},
    Failing{"grantpt", EACCES, 2, 1, Failing::Life::met},
    Failing{"tcgetattr", EIO, 3, 1, Failing::Life::met},
    Failing{"tcsetattr", EIO, 3, 1, Failing::Life::met},
    Failing{"pipe2", EMFILE, 2},
    Failing{"malloc", ENOMEM, 24, 1.5},
};

/// A short life that uses all there is: files, sockets, a recording, the EEPROM. One is played by a scenario
/// at once, the other lasts a moment of real time, in which somebody comes by TCP and UDP.
class ShortLife {
  public:
    ShortLife() {
        fs::create_directory(folder_.file("sd"));
        std::ofstream(folder_.file("sd/part.gco")) << part;
        std::ofstream(folder_.file("own.json")) << R"({"name": "own", "extends": "geeetech-a30t"})";
        std::ofstream(folder_.file("play.json")) << R"({
  "name": "play", "profile": "geeetech-a30t",
  "steps": [ { "do": "eeprom.save" }, { "wait": "2s" }, { "request": "M105" }, { "wait": "3s" } ]
})";
    }

    /// The exit code of one run in which a call fails; `happened` whether there was such a call at all.
    int run(const Failing& failing, long nth, bool ever, bool& happened, std::string& said) {
        const std::string mark = folder_.file("mark");
        fs::remove(mark);
        const link::UniqueFd errors(::open("/tmp", O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
        std::array<int, 2> ends{};
        REQUIRE(::pipe2(ends.data(), O_CLOEXEC) == 0);
        const link::UniqueFd out(ends[0]);
        link::UniqueFd program_out(ends[1]);
        const pid_t pid = ::fork();
        if (pid == 0) {
            become(failing, nth, ever, mark, program_out.get(), errors.get());
        }
        program_out.reset();
        const std::vector<link::UniqueFd> peers =
            failing.life == Failing::Life::met ? meet(out.get()) : std::vector<link::UniqueFd>{};
        const int code = wait(pid);
        happened = fs::exists(mark);
        said.resize(4096);
        const ssize_t size = ::pread(errors.get(), said.data(), said.size(), 0);
        said.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
        return code;
    }

    /// Whether what is kept on disk is as it was before or as it is to be, and not in between.
    bool files_are_whole() const {
        const std::string eeprom = content("eeprom");
        return (eeprom.empty() || host::eeprom_image(eeprom).has_value()) && content("sd/part.gco") == part;
    }

  private:
    static constexpr std::string_view part = "M104 S60\nG28\nG1 X10\nG1 X20\n";

    std::string content(const char* name) const {
        std::ifstream in(folder_.file(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    [[noreturn]] void become(const Failing& failing, long nth, bool ever, const std::string& mark, int out,
                             int errors) const {
        ::setenv("LD_PRELOAD", FAUXBOARD_FAILING_CALLS, 1);
        ::setenv("FAIL_CALL", failing.call, 1);
        ::setenv("FAIL_NTH", std::to_string(nth).c_str(), 1);
        ::setenv("FAIL_ERROR", std::to_string(failing.error).c_str(), 1);
        ::setenv("FAIL_EVER", ever ? "1" : "0", 1);
        ::setenv("FAIL_MARK", mark.c_str(), 1);
        const std::vector<std::string> how =
            failing.life == Failing::Life::met
                ? std::vector<std::string>{"--profile", folder_.file("own.json"), "--duration", "0.2s",
                                           "--host-pty=" + folder_.file("usb")}
                : std::vector<std::string>{
                      "--script", folder_.file("play.json"), "--speed", "max", "--host-tcp", ":0"};
        std::vector<std::string> args{FAUXBOARD_PROGRAM,
                                      "run",
                                      "--tcp",
                                      ":0",
                                      "--udp",
                                      ":0",
                                      "--sd",
                                      folder_.file("sd"),
                                      "--eeprom",
                                      folder_.file("eeprom"),
                                      "--record",
                                      folder_.file("talk.jsonl"),
                                      "--control",
                                      folder_.file("control")};
        args.insert(args.end(), how.begin(), how.end());
        std::vector<char*> words;
        for (std::string& arg : args) {
            words.push_back(arg.data());
        }
        words.push_back(nullptr);
        ::dup2(::open("/dev/null", O_RDWR), 0);
        ::dup2(out, 1);
        ::dup2(errors, 2);
        ::execv(words[0], words.data());
        ::_exit(127);
    }

    /// Comes to the program when it is ready, by each of its sockets, and asks. It may be gone already.
    static std::vector<link::UniqueFd> meet(int out) {
        std::string line;
        pollfd entry{.fd = out, .events = POLLIN, .revents = 0};
        for (char c = 0; c != '\n' && ::poll(&entry, 1, patience_ms) > 0 && ::read(out, &c, 1) == 1;) {
            line += c;
        }
        std::vector<link::UniqueFd> peers;
        const auto ready =
            nlohmann::json::parse(line.substr(std::min(line.find('{'), line.size())), nullptr, false);
        for (const auto& [key, type] : {std::pair{"path", SOCK_STREAM}, std::pair{"udp", SOCK_DGRAM}}) {
            const std::string where = ready.is_object() ? ready.value(key, "") : "";
            sockaddr_in address{};
            address.sin_family = AF_INET;
            address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
            address.sin_port =
                htons(static_cast<std::uint16_t>(std::atoi(where.c_str() + where.find(':') + 1)));
            peers.emplace_back(::socket(AF_INET, type | SOCK_CLOEXEC, 0));
            if (::connect(peers.back().get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) ==
                0) {
                constexpr std::string_view question = "N-0 M105*10\r\n";
                (void)!::send(peers.back().get(), question.data(), question.size(), MSG_NOSIGNAL);
            }
        }
        return peers;
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

/// The failing calls of one kind, and with which exit code how many of the runs ended.
struct Tried {
    std::size_t runs = 0;
    std::map<int, std::size_t> outcomes;
};

void try_calls(ShortLife& life, const Failing& failing, bool ever, bool all, Tried& tried) {
    long nth = 1;
    for (long i = 0; all || i < failing.most; ++i) {
        bool happened = false;
        std::string said;
        const int code = life.run(failing, nth, ever, happened, said);
        if (!happened) {
            return;  // there are not so many
        }
        // Whose every word fails cannot say that it does.
        const bool mute = ever && std::string_view(failing.call) == "write";
        const std::string what =
            fmt::format("{} number {}{}", failing.call, nth, ever ? " and all after" : "");
        CAPTURE(what);
        CAPTURE(said);
        CHECK(code != hung);
        CHECK(code < killed);
        CHECK(code != 70);
        CHECK((code == 0 || mute || !said.empty()));
        CHECK(life.files_are_whole());
        ++tried.runs;
        ++tried.outcomes[code];
        nth = all ? nth + 1 : std::max(nth + 1, std::lround(static_cast<double>(nth) * failing.further));
    }
}

// FAUXBOARD_ALL_CALLS=1 build/test_world tries each of them, which takes an hour.
TEST_CASE("every call of the system fails once and for good, and nothing worse comes of it") {
    if (sanitized) {
        MESSAGE("skipped: nothing can be preloaded into a program under a sanitizer");
        return;
    }
    const bool all = std::getenv("FAUXBOARD_ALL_CALLS") != nullptr;
    ShortLife life;
    std::size_t runs = 0;
    std::string told;
    for (const Failing& failing : table) {
        Tried tried;
        for (const bool ever : {false, true}) {
            try_calls(life, failing, ever, all, tried);
        }
        runs += tried.runs;
        told += fmt::format("\n{:<18}{:>6}", failing.call, tried.runs);
        for (const auto& [code, count] : tried.outcomes) {
            told += fmt::format("   exit {}: {}", code, count);
        }
    }
    MESSAGE(runs << " failing calls" << told);
    CHECK(runs > 150);
}

}  // namespace
}  // namespace fauxboard::world
