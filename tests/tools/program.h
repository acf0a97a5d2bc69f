#pragma once

// Running the real program.

#include <string>
#include <vector>

#include "tests/link/helpers.h"

namespace fauxboard::test {

/// A new folder, removed with all that is in it.
class TemporaryFolder : public link::test::TemporaryFolder {
  public:
    /// Writes a file and returns its path.
    std::string put(const std::string& name, const std::string& bytes) const;
};

struct Outcome {
    int code = -1;    ///< exit code; -1 where it did not exit by itself
    std::string out;  ///< all that it wrote to stdout
};

/// Runs a shell command to its end.
Outcome run_shell(const std::string& command);

/// Runs the `fauxboard` of this build to its end: `arguments` as for a shell, stderr along with stdout.
Outcome run_program(const std::string& arguments);

/// The `fauxboard` of this build, running beside the test; killed when the test forgets it.
class RunningProgram {
  public:
    /// stderr goes to the file `log`.
    RunningProgram(const std::vector<std::string>& arguments, const std::string& log);
    ~RunningProgram();
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    /// The next line of stdout, its end left off; waits for it. Empty at the end.
    std::string read_line();
    /// Asks it to end, and waits: its exit code, -1 if a signal ended it.
    int end(int signal);

  private:
    int process_ = -1;
    int out_ = -1;
};

/// Text at its line ends, which are left off.
std::vector<std::string> lines_of(const std::string& text);

}  // namespace fauxboard::test
