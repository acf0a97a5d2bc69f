// What `fauxboard tap` costs on the way, against a bare copying loop in a process of its own.

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "emulator/link/unique_fd.h"
#include "tests/bench/figure.h"

namespace fauxboard::bench {
namespace {

using link::UniqueFd;
using Clock = std::chrono::steady_clock;

constexpr double delay_limit = 1.5;
constexpr double recording_limit = 2;  // two files more to write, on the same processor
constexpr int patience_ms = 20'000;

/// A pseudo-terminal of ours, raw; somebody else opens its other end by name. We have it open, too, so that
/// nothing is refused before they do.
struct Terminal {
    UniqueFd master{::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
    std::string path;
    UniqueFd other_end;

    Terminal() {
        std::array<char, 128> name{};
        termios settings{};
        if (!master || ::grantpt(master.get()) != 0 || ::unlockpt(master.get()) != 0 ||
            ::ptsname_r(master.get(), name.data(), name.size()) != 0 ||
            ::tcgetattr(master.get(), &settings) != 0) {
            return;
        }
        ::cfmakeraw(&settings);
        ::tcsetattr(master.get(), TCSANOW, &settings);
        path = name.data();
        other_end.reset(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    }
};

bool wait_for(int fd, short events) {
    pollfd entry{.fd = fd, .events = events, .revents = 0};
    return ::poll(&entry, 1, patience_ms) > 0;
}

/// What was read of one end is written to the other, and nothing else is done.
[[noreturn]] void copy_bare(const std::string& a, const std::string& b) {
    const std::array<int, 2> fds{::open(a.c_str(), O_RDWR | O_NOCTTY), ::open(b.c_str(), O_RDWR | O_NOCTTY)};
    std::array<char, 4096> buffer{};
    for (;;) {
        std::array<pollfd, 2> entries{{{fds[0], POLLIN, 0}, {fds[1], POLLIN, 0}}};
        ::poll(entries.data(), entries.size(), -1);
        for (const std::size_t i : {0U, 1U}) {
            if ((entries[i].revents & POLLIN) == 0) {
                if (entries[i].revents != 0) {
                    ::_exit(0);
                }
                continue;
            }
            const ssize_t count = ::read(fds[i], buffer.data(), buffer.size());
            for (ssize_t done = 0; done < count;) {
                const ssize_t wrote =
                    ::write(fds[1 - i], buffer.data() + done, static_cast<std::size_t>(count - done));
                if (wrote <= 0) {
                    ::_exit(1);
                }
                done += wrote;
            }
        }
    }
}

[[noreturn]] void run_tap(const std::string& program, const std::string& a, const std::string& b,
                          const std::vector<std::string>& more) {
    std::vector<std::string> words{program, "tap", a, b, "-q"};
    words.insert(words.end(), more.begin(), more.end());
    std::vector<char*> pointers;
    std::transform(words.begin(), words.end(), std::back_inserter(pointers),
                   [](std::string& word) { return word.data(); });
    pointers.push_back(nullptr);
    const int nowhere = ::open("/dev/null", O_RDWR);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    ::execv(program.c_str(), pointers.data());
    ::_exit(127);
}

/// Two terminals and a process that passes bytes on between them.
class Passage {
  public:
    explicit Passage(const std::function<void(const std::string&, const std::string&)>& pass_on) {
        if (a_.path.empty() || b_.path.empty()) {
            return;
        }
        process_ = ::fork();
        if (process_ == 0) {
            pass_on(a_.path, b_.path);
            ::_exit(1);
        }
    }
    ~Passage() {
        if (process_ > 0) {
            ::kill(process_, SIGTERM);
            ::waitpid(process_, nullptr, 0);
        }
    }
    Passage(const Passage&) = delete;
    Passage& operator=(const Passage&) = delete;

    int a() const { return a_.master.get(); }
    int b() const { return b_.master.get(); }
    /// One message from A to B; seconds, or nothing when it does not arrive.
    std::optional<double> send(std::string_view message) const {
        std::array<char, 4096> buffer{};
        const auto start = Clock::now();
        if (::write(a(), message.data(), message.size()) != static_cast<ssize_t>(message.size())) {
            return std::nullopt;
        }
        for (std::size_t heard = 0; heard < message.size();) {
            if (!wait_for(b(), POLLIN)) {
                return std::nullopt;
            }
            const ssize_t count = ::read(b(), buffer.data(), buffer.size());
            heard += count > 0 ? static_cast<std::size_t>(count) : 0;
        }
        return std::chrono::duration<double>(Clock::now() - start).count();
    }

  private:
    Terminal a_;
    Terminal b_;
    pid_t process_ = -1;
};

/// The same message over one terminal, with nobody in between.
double direct(const Terminal& terminal, std::string_view message) {
    const int other_end = terminal.other_end.get();
    std::array<char, 4096> buffer{};
    const auto start = Clock::now();
    [[maybe_unused]] const ssize_t wrote = ::write(terminal.master.get(), message.data(), message.size());
    for (std::size_t heard = 0; heard < message.size() && wait_for(other_end, POLLIN);) {
        const ssize_t count = ::read(other_end, buffer.data(), buffer.size());
        heard += count > 0 ? static_cast<std::size_t>(count) : 0;
    }
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// This process and those it starts meanwhile, on one processor. On several, how long it takes to wake
/// another one varies tenfold, and says nothing of the tap.
class OnOneProcessor {
  public:
    OnOneProcessor() {
        known_ = ::sched_getaffinity(0, sizeof before_, &before_) == 0;
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(static_cast<unsigned>(std::max(0, ::sched_getcpu())), &one);
        ::sched_setaffinity(0, sizeof one, &one);
    }
    ~OnOneProcessor() {
        if (known_) {
            ::sched_setaffinity(0, sizeof before_, &before_);
        }
    }
    OnOneProcessor(const OnOneProcessor&) = delete;
    OnOneProcessor& operator=(const OnOneProcessor&) = delete;

  private:
    cpu_set_t before_{};
    bool known_ = false;
};

/// The tenth that was quickest: what the way takes where nothing else wants the processor at that moment. The
/// middle says more of the scheduler than of the tap.
double quickest_tenth(std::vector<double> times) {
    const auto at = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 10);
    std::nth_element(times.begin(), at, times.end());
    return *at;
}

Figure delay_figure(const Settings& settings, const std::string& name, double limit,
                    const std::vector<std::string>& more) {
    constexpr std::string_view message = "N-0 L1 X10.000 Y20.000 Z5.000 F100*113\r\n";
    Figure figure{name, "us added", 0, std::nullopt, limit};
    const OnOneProcessor here;
    const Passage bare(copy_bare);
    const Passage tap(
        [&](const std::string& a, const std::string& b) { run_tap(settings.program, a, b, more); });
    const Terminal alone;
    std::vector<double> bare_times;
    std::vector<double> tap_times;
    std::vector<double> direct_times;
    // In turn, so that what else this computer does troubles all alike.
    const int rounds = settings.smoke ? 1 : 60;
    for (int round = 0; round < rounds + 1; ++round) {
        for (int i = 0; i < 100; ++i) {
            const auto by_bare = bare.send(message);
            const auto by_tap = tap.send(message);
            if (!by_bare || !by_tap) {
                figure.skipped = "a message did not arrive";
                return figure;
            }
            if (round != 0) {  // the first one warms up
                bare_times.push_back(*by_bare * 1e6);
                tap_times.push_back(*by_tap * 1e6);
                direct_times.push_back(direct(alone, message) * 1e6);
            }
        }
    }
    const double direct_us = quickest_tenth(direct_times);
    figure.measured = quickest_tenth(tap_times) - direct_us;
    figure.floor = quickest_tenth(bare_times) - direct_us;
    return figure;
}

/// Sends `bytes` from A to B as fast as they are taken. Seconds; `wrong` counts bytes that arrive changed or
/// not at all.
double flood(const Passage& passage, const std::string& bytes, std::size_t& wrong) {
    std::vector<char> buffer(65'536);
    std::size_t said = 0;
    std::size_t heard = 0;
    wrong = 0;
    const auto start = Clock::now();
    while (heard < bytes.size()) {
        std::array<pollfd, 2> entries{
            {{passage.b(), POLLIN, 0},
             {passage.a(), static_cast<short>(said < bytes.size() ? POLLOUT : 0), 0}}};
        if (::poll(entries.data(), entries.size(), patience_ms) <= 0) {
            break;
        }
        if ((entries[1].revents & POLLOUT) != 0) {
            const ssize_t count =
                ::write(passage.a(), bytes.data() + said, std::min<std::size_t>(65'536, bytes.size() - said));
            said += count > 0 ? static_cast<std::size_t>(count) : 0;
        }
        if ((entries[0].revents & POLLIN) != 0) {
            const ssize_t count = ::read(passage.b(), buffer.data(), buffer.size());
            for (ssize_t i = 0; i < count; ++i, ++heard) {
                wrong +=
                    heard >= bytes.size() || buffer[static_cast<std::size_t>(i)] != bytes[heard] ? 1U : 0U;
            }
        }
    }
    wrong += bytes.size() - std::min(heard, bytes.size());
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<Figure> tap_delay(const Settings& settings) {
    std::vector<Figure> figures{delay_figure(settings, "tap: delay", delay_limit, {})};
    const auto folder =
        std::filesystem::temp_directory_path() / fmt::format("fauxboard-bench-{}", ::getpid());
    std::filesystem::create_directory(folder);
    figures.push_back(delay_figure(settings, "tap: delay, recording and capturing", recording_limit,
                                   {"--record", folder / "tap.jsonl", "--pcapng", folder / "tap.pcapng"}));
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
    return figures;
}

std::vector<Figure> tap_flood(const Settings& settings) {
    std::mt19937_64 random(1);
    std::string bytes(settings.smoke ? 1'000'000 : 100'000'000, '\0');
    std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<char>(random() >> 56); });
    std::size_t wrong = 0;
    std::size_t wrong_bare = 0;
    const double bare = flood(Passage(copy_bare), bytes, wrong_bare);
    const double tap = flood(
        Passage([&](const std::string& a, const std::string& b) { run_tap(settings.program, a, b, {}); }),
        bytes, wrong);
    const std::string name = fmt::format("tap: {} MB", bytes.size() / 1'000'000);
    return {{name + ", bytes lost or changed", "bytes", static_cast<double>(wrong), std::nullopt, 0},
            {name, "s", tap, bare, 2}};
}

}  // namespace

std::vector<Benchmark> tap_benchmarks() {
    return {{"tap-delay", "how much later a line arrives with a tap in between", tap_delay},
            {"tap-flood", "100 MB through a tap, as fast as they go", tap_flood}};
}

}  // namespace fauxboard::bench
