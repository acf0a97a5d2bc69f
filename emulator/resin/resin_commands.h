#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/resin/names.h"
#include "emulator/resin/resin_axis.h"

namespace fauxboard::resin {

/// A .gcode file of the stick that is carried out, line by line: mostly settings (M8xxx). It is no print: no
/// job runs meanwhile, and what its lines are answered with goes nowhere.
class ResinCommands {
  public:
    explicit ResinCommands(const ResinAxis& axis) : axis_(axis) {}

    /// Whether a file of this name is carried out and not printed.
    static bool fits(std::string_view path);

    /// Begins with a file's first line. `volume` is used until the end, which comes also when it can no
    /// longer be read.
    void begin(const Volume& volume, std::string path, SimTime now);
    void stop() {
        volume_ = nullptr;
        line_.reset();
    }
    bool running() const { return volume_ != nullptr; }
    /// Reads the next line when it is due and nothing moves.
    void advance(SimTime now);
    /// When the next line is due; one that waits for the axis, or to be taken, has no time of its own.
    SimTime next_event() const { return running() && !line_ && !axis_.busy() ? due_ : never; }
    /// The line that was read, without its comment; it may be blank. The next one is due from `now` on.
    std::optional<std::string> take(SimTime now);

  private:
    std::optional<std::string> read_line();

    const ResinAxis& axis_;
    const Volume* volume_ = nullptr;
    std::string path_;
    std::uint64_t offset_ = 0;
    SimTime due_{0};
    std::optional<std::string> line_;  ///< read, and not taken yet
};

}  // namespace fauxboard::resin
