#include "tests/e2e/program.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <csignal>

// The C library's header forgets this (its bug 29594).
extern "C" {
#include <sys/pidfd.h>
}

namespace fauxboard::e2e {
namespace {

bool wait_for(int fd, short events) {
    pollfd entry{.fd = fd, .events = events, .revents = 0};
    return ::poll(&entry, 1, patience_ms) > 0;
}

/// In the child: takes the descriptors over and becomes the program.
[[noreturn]] void become(const Args& args, Program::Stdout out, int out_fd, int errors_fd) {
    std::signal(SIGPIPE, SIG_DFL);
    std::signal(SIGXFSZ, SIG_DFL);
    ::dup2(errors_fd, 2);
    if (out == Program::Stdout::closed) {
        ::close(1);
    } else if (out == Program::Stdout::full) {
        ::dup2(::open("/dev/full", O_WRONLY), 1);
    } else {
        ::dup2(out_fd, 1);
    }
    std::vector<char*> words{const_cast<char*>(FAUXBOARD_PROGRAM)};
    for (const std::string& arg : args)
        words.push_back(const_cast<char*>(arg.c_str()));
    words.push_back(nullptr);
    ::execv(FAUXBOARD_PROGRAM, words.data());
    ::_exit(127);
}

UniqueFd connect_to(const std::string& where) {
    const std::size_t colon = where.rfind(':');
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(where.substr(colon + 1))));
    REQUIRE(::inet_pton(AF_INET, where.substr(0, colon).c_str(), &address.sin_addr) == 1);
    UniqueFd fd(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    REQUIRE(::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    REQUIRE(::fcntl(fd.get(), F_SETFL, O_NONBLOCK) == 0);
    return fd;
}

}  // namespace

std::string LineReader::next() {
    while (true) {
        if (const std::size_t end = rest_.find('\n'); end != std::string::npos) {
            std::string line = rest_.substr(0, end);
            rest_.erase(0, end + 1);
            if (line.ends_with('\r')) line.pop_back();
            return line;
        }
        if (!wait_for(fd_, POLLIN)) {
            return "(silence)";
        }
        std::array<char, 4096> buffer;
        const ssize_t count = ::read(fd_, buffer.data(), buffer.size());
        if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) {
            return "(end)";
        }
        rest_.append(buffer.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
    }
}

std::string LineReader::find(std::string_view part) {
    std::string line;
    do {
        line = next();
    } while (line.find(part) == std::string::npos && line != "(end)" && line != "(silence)");
    return line;
}

void LineReader::drop() {
    rest_.clear();
    link::test::take(fd_);
}

Program::Program(const Args& args, Stdout out) {
    std::array<int, 2> ends{};
    REQUIRE(::pipe2(ends.data(), O_CLOEXEC) == 0);
    out_.reset(ends[0]);
    const UniqueFd child_out(ends[1]);
    errors_.reset(::open("/tmp", O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
    REQUIRE(errors_);
    if (out == Stdout::broken) {
        out_.reset();
    } else if (out == Stdout::narrow_pipe) {
        REQUIRE(::fcntl(ends[0], F_SETPIPE_SZ, 4096) == 4096);
    }
    pid_ = ::fork();
    REQUIRE(pid_ >= 0);
    if (pid_ == 0) {
        become(args, out, child_out.get(), errors_.get());
    }
    reader_ = LineReader(out_.get());
}

Program::~Program() {
    if (pid_ > 0) {
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
    }
}

nlohmann::json Program::ready() {
    const std::string line = reader_.next();
    INFO(line);
    INFO(errors());
    REQUIRE(line.starts_with("ready {"));
    return nlohmann::json::parse(line.substr(6));
}

void Program::signal(int number) const {
    REQUIRE(pid_ > 0);
    REQUIRE(::kill(pid_, number) == 0);
}

int Program::wait() {
    const UniqueFd process(::pidfd_open(pid_, 0));
    REQUIRE(process);
    REQUIRE_MESSAGE(wait_for(process.get(), POLLIN), "the program does not end: " << errors());
    int status = 0;
    REQUIRE(::waitpid(pid_, &status, 0) == pid_);
    pid_ = -1;
    return WIFSIGNALED(status) ? 1000 + WTERMSIG(status) : WEXITSTATUS(status);
}

int Program::stop() {
    signal(SIGTERM);
    return wait();
}

std::string Program::errors() const {
    std::string text;
    std::array<char, 4096> buffer;
    for (off_t at = 0;;) {
        const ssize_t count = ::pread(errors_.get(), buffer.data(), buffer.size(), at);
        if (count <= 0) {
            return text;
        }
        text.append(buffer.data(), static_cast<std::size_t>(count));
        at += count;
    }
}

Result run(const Args& args) {
    Program program(args);
    Result result{};
    for (std::string line = program.out().next(); line != "(end)" && line != "(silence)";
         line = program.out().next()) {
        result.out += line + '\n';
    }
    result.code = program.wait();
    result.errors = program.errors();
    return result;
}

void check_mistakes(const std::vector<Mistake>& mistakes) {
    for (const Mistake& mistake : mistakes) {
        const Result result = run(mistake.args);
        std::string words;
        for (const std::string& arg : mistake.args) {
            words += arg + ' ';
        }
        CAPTURE(words);
        CAPTURE(result.errors);
        CHECK(result.code == mistake.code);
        CHECK(result.out.empty());
        CHECK(contains(result.errors, mistake.says));
    }
}

Peer::Peer(const std::string& where)
    : fd_(where.starts_with('/') ? link::test::open_terminal(where) : connect_to(where)),
      reader_(fd_.get()) {}

void Peer::say(std::string_view bytes) const {
    while (!bytes.empty()) {
        REQUIRE(wait_for(fd_.get(), POLLOUT));
        const ssize_t count = ::write(fd_.get(), bytes.data(), bytes.size());
        REQUIRE((count > 0 || errno == EAGAIN));
        bytes.remove_prefix(count > 0 ? static_cast<std::size_t>(count) : 0);
    }
}

std::string Peer::ask(std::string_view body, std::string_view part) {
    say(frame(body));
    return reader_.find(part);
}

}  // namespace fauxboard::e2e
