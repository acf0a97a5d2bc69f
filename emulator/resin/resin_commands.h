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
    void stop() { volume_ = nullptr; }
    bool running() const { return volume_ != nullptr; }
    /// When the next line may be taken; a line that waits for the axis has no time of its own.
    SimTime next_event() const { return running() && !axis_.busy() ? due_ : never; }
    /// The next line without its comment, if it is due and nothing moves. Blank ones are passed over.
    std::optional<std::string> take(SimTime now);

  private:
    std::optional<std::string> read_line();

    const ResinAxis& axis_;
    const Volume* volume_ = nullptr;
    std::string path_;
    std::uint64_t offset_ = 0;
    SimTime due_{0};
};

}  // namespace fauxboard::resin
