#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/host/text_output.h"
#include "emulator/link/unique_fd.h"

namespace fauxboard::host {

/// The files of a log: the one that is written, FILE, and older ones, FILE.1 the youngest of them. Nothing
/// but printable text gets into them. Never waits for a pipe's reader; what cannot be written is left out,
/// counted and told, and does no harm to what stands there.
class LogFile {
  public:
    struct Options {
        std::string path;
        std::uintmax_t most_bytes = 10UL * 1024 * 1024;  ///< of each file
        unsigned files = 5;                              ///< all together, from 1
        std::string head;                                ///< first line of each; see is_ours()
    };
    /// Told when it begins to lose lines, and when it ends: must not write into it.
    using OnTrouble = std::function<void(std::string_view sentence)>;

    /// Goes on where FILE ends, or begins it anew where its head is another one. New files are for their user
    /// alone. Throws link::HostError: for a file that is not a log of ours (nor is one of those that it would
    /// be renamed to), that another process writes, or that cannot be opened; for a pipe that nobody reads.
    LogFile(Options options, OnTrouble on_trouble);

    /// One line, without its end.
    void write(std::string_view line);

    /// Heads of all logs of ours begin so, as text and as JSON.
    static constexpr std::string_view text_mark = "# fauxboard's log";
    static constexpr std::string_view json_mark = "{\"log\": \"fauxboard\"";

    /// Where the log is that is so many files older; 0: the one that is written.
    static std::string path_of(const std::string& path, unsigned age);

  private:
    /// Whether it is not there, empty, or begins as our logs do.
    static bool is_ours(const std::string& path);
    std::string path_of(unsigned age) const { return path_of(options_.path, age); }
    /// Throws link::HostError.
    void open(int more_flags);
    void begin();
    void rotate();
    bool put(std::string_view line);
    void give_up(const std::string& why);

    Options options_;
    OnTrouble on_trouble_;
    link::UniqueFd fd_;
    std::optional<TextOutput> out_;
    bool is_plain_ = false;       ///< a file, which grows; not a pipe or a terminal
    std::uintmax_t bytes_ = 0;    ///< of it, or of what was begun here
    std::uint64_t left_out_ = 0;  ///< and not told in it yet
    bool told_ = false;           ///< that it takes no more
};

}  // namespace fauxboard::host
