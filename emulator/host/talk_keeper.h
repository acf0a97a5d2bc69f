#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/control/error.h"
#include "emulator/host/live_observer.h"

namespace fauxboard::host {

/// The lines that passed last, for whoever comes later; and the last one of each kind that the board said on
/// its main line, which is what a screen that was there would know. Bounded, and cheap: it sees every line.
class TalkKeeper {
  public:
    static constexpr std::size_t most_lines = 200;
    static constexpr std::size_t most_kinds = 64;
    static constexpr std::size_t most_bytes = 512;  ///< kept of a line

    void add(SimTime now, std::string_view from, std::string_view line, std::string_view refused = {});
    /// A line that the board said on its main line.
    void add_said(SimTime now, std::string_view line);
    /// As the topic traffic tells them, with words, oldest first.
    control::Json to_json() const;
    /// The last of each kind, in the order in which they were said.
    std::vector<std::string> last_said() const;

  private:
    struct Line {
        SimTime at{0};
        std::string_view from;     ///< a constant
        std::string_view refused;  ///< same
        std::string text;
    };
    struct Kind {
        std::string name;
        std::string text;
        std::uint64_t number = 0;
    };

    std::vector<Line> lines_;  ///< a ring
    std::size_t next_ = 0;
    std::vector<Kind> kinds_;
    std::uint64_t said_ = 0;
};

}  // namespace fauxboard::host
