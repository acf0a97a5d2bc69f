#pragma once

#include <sys/types.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace fauxboard::bench {

/// A process of ours that serves one pseudo-terminal. Ended and waited for by the destructor.
class Child {
  public:
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child();

    const std::string& path() const { return path_; }  ///< of the terminal to open
    const std::string& web() const { return web_; }    ///< address of the panel; empty: none
    double cpu_seconds() const;                        ///< used so far, all threads
    double resident_bytes() const;                     ///< memory that is its own
    std::uint64_t wake_ups() const;                    ///< voluntary context switches so far, all threads

  protected:
    Child() = default;
    void stop();
    /// Starts the program and waits for its "ready", which it gives.
    nlohmann::json start(const std::string& program, const std::vector<std::string>& arguments);
    pid_t pid_ = -1;
    std::string path_;
    std::string web_;
};

/// `fauxboard run --pty` with further arguments. Throws std::runtime_error when it says no "ready".
class BoardChild final : public Child {
  public:
    BoardChild(const std::string& program, const std::vector<std::string>& arguments);
};

/// `fauxboard fleet FILE` with further arguments; path() is that of the first board. Throws as BoardChild.
class FleetChild final : public Child {
  public:
    FleetChild(const std::string& program, const std::string& file,
               const std::vector<std::string>& arguments);
    /// Of each board's terminal.
    const std::vector<std::string>& paths() const { return paths_; }

  private:
    std::vector<std::string> paths_;
};

/// The floor: blocking read, blocking write, the same line for every line end.
class EchoChild final : public Child {
  public:
    explicit EchoChild(std::string_view reply);
};

/// The peer's end of a child's terminal.
class Peer {
  public:
    explicit Peer(const std::string& path);
    ~Peer();
    Peer(const Peer&) = delete;
    Peer& operator=(const Peer&) = delete;

    void write(std::string_view bytes) const;
    /// Blocks until a line comes that starts so; the line with its end. Lines that start otherwise are passed
    /// over.
    std::string line(std::string_view start);
    /// Reads what comes within `seconds`: whether anything that starts so was among it.
    bool line_within(std::string_view start, double seconds);
    /// Reads for some time and gives the number of lines that came.
    std::size_t count_lines(double seconds);

  private:
    int fd_ = -1;
    std::string pending_;
};

/// Runs a program to its end with nothing on its standard input and output; wall-clock seconds. Throws when
/// it fails.
double time_program(const std::string& program, const std::vector<std::string>& arguments);

/// Keeps this process (0) or a child on one of the processors, when there are several.
void pin(pid_t pid, int processor);

}  // namespace fauxboard::bench
