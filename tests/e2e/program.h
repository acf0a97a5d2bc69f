#pragma once

#include <doctest/doctest.h>
#include <sys/types.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "emulator/link/unique_fd.h"
#include "protocol/framing.h"
#include "tests/link/helpers.h"

namespace fauxboard::e2e {

using link::UniqueFd;
using link::test::contains;
using link::test::TemporaryFolder;
using protocol::frame;
using Args = std::vector<std::string>;

// What the exit codes say is a contract with scripts, and so written down here once more.
constexpr int failed = 1;
constexpr int usage = 2;
constexpr int bad_input = 3;
constexpr int no_port = 4;
constexpr int timed_out = 5;

/// How long anything may take before a test gives up. Nothing is ever waited for that long in a passing test.
inline constexpr int patience_ms = 60'000;

/// Reads lines from a descriptor, waiting for each as long as it takes, within reason.
class LineReader {
  public:
    explicit LineReader(int fd) : fd_(fd) {}
    /// The next line without its end; "(end)" at the end of the stream; "(silence)" if nothing came in time.
    std::string next();
    /// The next line that has `part` in it; the last one looked at ("(end)", "(silence)") when there is none.
    std::string find(std::string_view part);
    /// What is there already is thrown away, whole lines or not.
    void drop();

  private:
    int fd_;
    std::string rest_;
};

/// One run of the real program. Its stderr goes to a file. Killed at the end if it still runs.
class Program {
  public:
    enum class Stdout { pipe, narrow_pipe, closed, broken, full };
    explicit Program(const Args& args, Stdout out = Stdout::pipe);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    /// The object of the `ready` line, which must be the next line.
    nlohmann::json ready();
    LineReader& out() { return reader_; }
    void signal(int number) const;
    /// Waits for the end; the exit code, or 1000 + the signal that ended it.
    int wait();
    /// Tells it to end, and waits.
    int stop();
    /// What it said on stderr so far.
    std::string errors() const;

  private:
    pid_t pid_ = -1;
    UniqueFd out_;
    UniqueFd errors_;
    LineReader reader_{-1};
};

/// The exit code of a whole run with its stdout and stderr.
struct Result {
    int code;
    std::string out;
    std::string errors;
};
Result run(const Args& args);

/// Something that cannot work, and what is to be said of it.
struct Mistake {
    Args args;
    int code;
    std::string says;
};
/// Each is refused with its exit code and its sentence, and nothing on stdout.
void check_mistakes(const std::vector<Mistake>& mistakes);

/// The screen's end of the line.
class Peer {
  public:
    /// A pseudo-terminal by its path, or "HOST:PORT" of a socket.
    explicit Peer(const std::string& where);
    LineReader& lines() { return reader_; }
    /// All of it, waiting as long as the line is full.
    void say(std::string_view bytes) const;
    /// Asks, framed, and gives the first line back that has `part` in it.
    std::string ask(std::string_view body, std::string_view part);

  private:
    UniqueFd fd_;
    LineReader reader_{-1};
};

}  // namespace fauxboard::e2e
