#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/source.h"
#include "emulator/machine/sim_time.h"

namespace fauxboard::fault {

using behaviour::Json;
using machine::SimTime;

struct Kind;

/// Which way the bytes go that a fault spoils.
enum class Direction : std::uint8_t { to_screen, to_board, both };

/// Which of a board's lines: the one with the screen, or, on boards that have only that, with the host; or
/// the USB side beside it.
enum class Line : std::uint8_t { main, usb };

/// The values of a kind's own attributes, in the order of its table: times in microseconds, rates in bytes
/// per second, choices by their index.
class Values {
  public:
    static constexpr std::size_t most = 3;

    double number(std::size_t i) const { return values_[i]; }
    std::size_t count(std::size_t i) const { return static_cast<std::size_t>(values_[i]); }
    SimTime time(std::size_t i) const { return SimTime{static_cast<SimTime::rep>(values_[i])}; }
    void set(std::size_t i, double value) { values_[i] = value; }
    bool operator==(const Values&) const = default;

  private:
    std::array<double, most> values_{};
};

/// Which lines a fault acts on. What is not given does not restrict.
struct Trigger {
    std::optional<double> probability;   ///< of each line, 0..1
    std::optional<std::uint64_t> every;  ///< only each n-th line
    std::optional<std::uint64_t> after;  ///< the first n lines are let be
    std::optional<std::uint64_t> count;  ///< acts at most so often
    std::optional<SimTime> from;         ///< virtual time; before it the fault does not even count lines
    std::optional<SimTime> until;        ///< virtual time
    std::optional<SimTime> length;       ///< "for": how long, from `from` or from when the fault is added
    std::optional<SimTime> at;           ///< virtual time; once, on the first line from then on
    /// True when lines decide, not time alone.
    bool by_line() const { return probability || every || after; }
    bool operator==(const Trigger&) const = default;
};

/// One fault as a person asks for it.
struct FaultSpec {
    const Kind* kind = nullptr;
    Direction direction = Direction::both;
    std::optional<Line> line;  ///< unsaid: the board's main line, or the only one that it has
    Trigger trigger;
    std::uint64_t seed = 1;  ///< 0 .. 2^32 - 1
    Values values;
    bool operator==(const FaultSpec&) const = default;
};

/// What is wrong with the text of a fault, all of it; `what()` is the sentences, a line each.
class FaultSpecError : public std::runtime_error {
  public:
    explicit FaultSpecError(std::vector<std::string> problems);
    const std::vector<std::string>& problems() const { return problems_; }

  private:
    std::vector<std::string> problems_;
};

/// "garble:to_screen,probability=0.01,seed=7,bits=1": a kind, then in any order its attributes and a
/// direction. Times and rates carry their unit ("200ms", "960B/s"). Throws FaultSpecError.
FaultSpec fault_from_text(std::string_view text);

/// {"kind":"garble","direction":"to_screen","probability":0.01,"seed":7,"bits":1}, or a string as above.
/// Throws FaultSpecError.
FaultSpec fault_from_json(const Json& json);

/// The two ways back; parsing them gives the same spec. Attributes at their default are left out.
std::string fault_to_text(const FaultSpec& spec);
Json fault_to_json(const FaultSpec& spec);

}  // namespace fauxboard::fault
