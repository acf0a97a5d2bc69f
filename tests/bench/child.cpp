#include "tests/bench/child.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

namespace fauxboard::bench {
namespace {

using Clock = std::chrono::steady_clock;

int checked(int result, const char* what) {
    if (result < 0) {
        throw std::system_error(errno, std::generic_category(), what);
    }
    return result;
}

void make_raw(int fd) {
    termios settings{};
    checked(tcgetattr(fd, &settings), "tcgetattr");
    cfmakeraw(&settings);
    checked(tcsetattr(fd, TCSANOW, &settings), "tcsetattr");
}

pid_t spawn(const std::string& program, const std::vector<std::string>& arguments, int output) {
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    std::transform(words.begin(), words.end(), std::back_inserter(argv),
                   [](std::string& w) { return w.data(); });
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    if (output < 0) {
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    } else {
        posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    }
    pid_t pid = -1;
    const int error = posix_spawn(&pid, program.c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
        throw std::system_error(error, std::generic_category(), program);
    }
    return pid;
}

/// One line of a pipe, without its end; what came before the pipe was closed, if it has none.
std::string read_line(int fd) {
    std::string line;
    char byte = 0;
    while (::read(fd, &byte, 1) == 1 && byte != '\n') {
        line += byte;
    }
    return line;
}

void write_all(int fd, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(fd, bytes.data(), bytes.size());
        if (n < 0) {
            if (errno == EINTR) continue;
            throw std::system_error(errno, std::generic_category(), "write");
        }
        bytes.remove_prefix(static_cast<std::size_t>(n));
    }
}

[[noreturn]] void echo(int terminal, std::string_view reply) {
    std::array<char, 4096> bytes;
    while (true) {
        const ssize_t n = ::read(terminal, bytes.data(), bytes.size());
        if (n <= 0) {
            _exit(0);
        }
        for (auto lines = std::count(bytes.data(), bytes.data() + n, '\n'); lines > 0; --lines) {
            write_all(terminal, reply);
        }
    }
}

}  // namespace

Child::~Child() {
    stop();
}

void Child::stop() {
    if (pid_ > 0) {
        kill(pid_, SIGTERM);
        waitpid(pid_, nullptr, 0);
        pid_ = -1;
    }
}

double Child::cpu_seconds() const {
    clockid_t clock{};
    timespec time{};
    if (clock_getcpuclockid(pid_, &clock) != 0 || clock_gettime(clock, &time) != 0) {
        throw std::runtime_error("no processor clock of the child: it has ended");
    }
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

std::uint64_t Child::wake_ups() const {
    constexpr std::string_view key = "voluntary_ctxt_switches:";
    std::uint64_t sum = 0;
    for (const auto& task : std::filesystem::directory_iterator("/proc/" + std::to_string(pid_) + "/task")) {
        std::ifstream status(task.path() / "status");
        for (std::string line; std::getline(status, line);) {
            if (line.starts_with(key)) {
                sum += std::stoull(line.substr(key.size()));
            }
        }
    }
    return sum;
}

double Child::resident_bytes() const {
    std::ifstream statm("/proc/" + std::to_string(pid_) + "/statm");
    double size = 0;
    double resident = 0;
    double shared = 0;
    statm >> size >> resident >> shared;
    return (resident - shared) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

nlohmann::json Child::start(const std::string& program, const std::vector<std::string>& arguments) {
    std::array<int, 2> ends{};
    checked(pipe2(ends.data(), O_CLOEXEC), "pipe");
    pid_ = spawn(program, arguments, ends[1]);
    close(ends[1]);
    const std::string line = read_line(ends[0]);
    close(ends[0]);
    constexpr std::string_view word = "ready ";
    if (!line.starts_with(word)) {
        stop();
        throw std::runtime_error(program + " did not get ready");
    }
    pin(pid_, 1);
    nlohmann::json ready = nlohmann::json::parse(line.substr(word.size()));
    web_ = ready.value("web", "");
    return ready;
}

BoardChild::BoardChild(const std::string& program, const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"run", "--pty", "--quiet"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    path_ = start(program, all).at("path").get<std::string>();
}

FleetChild::FleetChild(const std::string& program, const std::string& file,
                       const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"fleet", file, "--quiet"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const nlohmann::json ready = start(program, all);
    for (const auto& board : ready.at("boards")) {
        paths_.push_back(board.at("path").get<std::string>());
    }
    path_ = paths_.front();
}

EchoChild::EchoChild(std::string_view reply) {
    const int terminal = checked(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC), "posix_openpt");
    checked(grantpt(terminal), "grantpt");
    checked(unlockpt(terminal), "unlockpt");
    std::array<char, 64> name{};
    checked(-ptsname_r(terminal, name.data(), name.size()), "ptsname");
    path_ = name.data();
    // Raw before anyone writes; held open by the child, so that it does not end between two peers.
    const int other = checked(open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC), "open");
    make_raw(other);
    pid_ = checked(fork(), "fork");
    if (pid_ == 0) {
        echo(terminal, reply);
    }
    close(terminal);
    close(other);
    pin(pid_, 1);
}

Peer::Peer(const std::string& path)
    : fd_(checked(open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC), path.c_str())) {
    make_raw(fd_);
    pin(0, 0);
}

Peer::~Peer() {
    close(fd_);
}

void Peer::write(std::string_view bytes) const {
    write_all(fd_, bytes);
}

std::string Peer::line(std::string_view start) {
    while (true) {
        for (std::size_t end = pending_.find('\n'); end != std::string::npos; end = pending_.find('\n')) {
            std::string found = pending_.substr(0, end + 1);
            pending_.erase(0, end + 1);
            if (found.starts_with(start)) {
                return found;
            }
        }
        std::array<char, 4096> bytes;
        const ssize_t n = ::read(fd_, bytes.data(), bytes.size());
        if (n <= 0) {
            throw std::runtime_error("the other end of the terminal has gone");
        }
        pending_.append(bytes.data(), static_cast<std::size_t>(n));
    }
}

bool Peer::line_within(std::string_view start, double seconds) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    std::string text;
    while (text.find(start) == std::string::npos) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        pollfd wait{fd_, POLLIN, 0};
        std::array<char, 4096> bytes;
        if (left <= 0 || poll(&wait, 1, static_cast<int>(left)) <= 0) {
            return false;
        }
        const ssize_t n = ::read(fd_, bytes.data(), bytes.size());
        if (n <= 0) {
            return false;
        }
        text.append(bytes.data(), static_cast<std::size_t>(n));
    }
    return true;
}

std::size_t Peer::count_lines(double seconds) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    std::size_t lines = 0;
    while (true) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        pollfd wait{fd_, POLLIN, 0};
        if (left <= 0 || poll(&wait, 1, static_cast<int>(left)) <= 0) {
            return lines;
        }
        std::array<char, 4096> bytes;
        const ssize_t n = ::read(fd_, bytes.data(), bytes.size());
        if (n <= 0) {
            return lines;
        }
        lines += static_cast<std::size_t>(std::count(bytes.data(), bytes.data() + n, '\n'));
    }
}

double time_program(const std::string& program, const std::vector<std::string>& arguments) {
    const auto start = Clock::now();
    const pid_t pid = spawn(program, arguments, -1);
    int status = 0;
    waitpid(pid, &status, 0);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw std::runtime_error(program + " failed");
    }
    return std::chrono::duration<double>(Clock::now() - start).count();
}

void pin(pid_t pid, int processor) {
    if (sysconf(_SC_NPROCESSORS_ONLN) < 2) {
        return;
    }
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<std::size_t>(processor), &one);
    sched_setaffinity(pid, sizeof one, &one);  // where it is not allowed the figures are only less steady
}

}  // namespace fauxboard::bench
