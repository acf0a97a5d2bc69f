// Feeds a recording's screen side to the real program over a pseudo-terminal, in real time, and compares what
// the board says with a replay of the same recording in virtual time. Takes as long as the recording does, so
// it is no part of the test suite: `tools/test --live`, or
//
//     fauxboard_live PROGRAM RECORDING [SECONDS=60]

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "emulator/host/profile_files.h"
#include "emulator/link/unique_fd.h"
#include "emulator/record/recording.h"
#include "emulator/record/replay.h"
#include "protocol/framing.h"

namespace {

using fauxboard::record::RecordedLine;
using Clock = std::chrono::steady_clock;

struct Heard {
    double t;
    std::string line;
};

/// The program on a pty of its own; ended when this goes.
class Board {
  public:
    explicit Board(const std::string& program) {
        std::array<int, 2> ends{};
        if (pipe(ends.data()) != 0) {
            std::perror("pipe");
            std::exit(4);
        }
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
        std::vector<std::string> words{program, "run", "-q", "--profile", "geeetech-a30t"};
        std::vector<char*> argv;
        for (std::string& word : words) {
            argv.push_back(word.data());
        }
        argv.push_back(nullptr);
        if (posix_spawn(&pid_, program.c_str(), &actions, nullptr, argv.data(), environ) != 0) {
            std::perror(program.c_str());
            std::exit(4);
        }
        posix_spawn_file_actions_destroy(&actions);
        close(ends[1]);
        std::string ready;
        char c = 0;
        while (read(ends[0], &c, 1) == 1 && c != '\n') {
            ready += c;
        }
        const auto where = nlohmann::json::parse(ready.substr(std::string("ready ").size()));
        line_ = fauxboard::link::UniqueFd(open(where["path"].get<std::string>().c_str(), O_RDWR | O_NOCTTY));
        termios settings{};
        tcgetattr(line_.get(), &settings);
        cfmakeraw(&settings);
        tcsetattr(line_.get(), TCSANOW, &settings);
    }
    ~Board() {
        kill(pid_, SIGTERM);
        waitpid(pid_, nullptr, 0);
    }
    Board(const Board&) = delete;
    Board& operator=(const Board&) = delete;

    void say(const std::string& line) const {
        const std::string bytes = line + "\r\n";
        if (write(line_.get(), bytes.data(), bytes.size()) < 0) {
            std::perror("write");
        }
    }

    /// Listens until `until` seconds after the board's first byte.
    void listen(double until) {
        while (true) {
            const double left = heard_.empty() ? 60 : until - now();
            pollfd wait{line_.get(), POLLIN, 0};
            if (left <= 0 || poll(&wait, 1, static_cast<int>(std::ceil(left * 1000))) == 0) {
                return;
            }
            std::array<char, 4096> bytes{};
            const ssize_t count = read(line_.get(), bytes.data(), bytes.size());
            if (count <= 0) {
                return;
            }
            if (!started_) {
                origin_ = Clock::now();
                started_ = true;
            }
            splitter_.feed({bytes.data(), static_cast<std::size_t>(count)}, [this](std::string_view line) {
                heard_.push_back({now(), std::string(line)});
            });
        }
    }

    const std::vector<Heard>& heard() const { return heard_; }

  private:
    double now() const { return std::chrono::duration<double>(Clock::now() - origin_).count(); }

    pid_t pid_ = -1;
    fauxboard::link::UniqueFd line_;
    Clock::time_point origin_;
    bool started_ = false;
    fauxboard::protocol::LineSplitter splitter_;
    std::vector<Heard> heard_;
};

int compare(const std::vector<Heard>& live, const std::vector<RecordedLine>& replayed, double seconds) {
    std::size_t same = 0;
    std::size_t expected = 0;
    double worst = 0;
    for (const RecordedLine& line : replayed) {
        const double t = fauxboard::machine::to_seconds(line.t);
        if (t > seconds - 0.5) {  // the last half second may be cut off on one side
            break;
        }
        if (expected < live.size() && live[expected].line == line.bytes) {
            ++same;
            worst = std::max(worst, std::abs(live[expected].t - t));
        } else {
            std::printf("replay %9.3f  %s\nlive   %9.3f  %s\n", t, line.bytes.c_str(),
                        expected < live.size() ? live[expected].t : 0.0,
                        expected < live.size() ? live[expected].line.c_str() : "(nothing)");
        }
        ++expected;
    }
    std::printf(
        "%zu of %zu lines of the first %.0f s are the same live as in the replay; times differ by at most "
        "%.1f ms\n",
        same, expected, seconds, worst * 1000);
    return same == expected && expected > 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: %s PROGRAM RECORDING [SECONDS]\n", argv[0]);
        return 2;
    }
    const double seconds = argc > 3 ? std::atof(argv[3]) : 60;
    try {
        const auto recording = fauxboard::record::load_recording(argv[2]);
        const auto replayed =
            fauxboard::record::replay(fauxboard::host::load_profile_by_name("geeetech-a30t"), recording, {});
        Board board(argv[1]);
        for (const RecordedLine& line : recording) {
            const double t = fauxboard::machine::to_seconds(line.t);
            if (t < seconds && line.from == RecordedLine::From::screen) {
                board.listen(t);
                board.say(line.bytes);
            }
        }
        board.listen(seconds);
        return compare(board.heard(), replayed.lines, seconds);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 3;
    }
}
