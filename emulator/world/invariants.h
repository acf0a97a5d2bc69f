#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "emulator/board/board.h"
#include "emulator/world/disk.h"
#include "emulator/world/ledger.h"
#include "emulator/world/stores.h"

namespace fauxboard::screen {
class Screen;
}

namespace fauxboard::world {

/// What an invariant may look at.
struct View {
    const board::Board& board;
    const Ledger& ledger;
    const Disk& disk;
    const Eeprom& eeprom;
    const screen::Screen* screen;  ///< null: nobody touches this board
    board::Channel channel = board::Channel::main;
    std::string_view output{};  ///< of Moment::output: what the board just put on that line
};

/// Where a job that was cut off is to go on.
struct Place {
    std::string path;
    std::uint64_t byte = 0;
};
/// As the machine's values tell it; nothing when there is none, or on a machine that takes up no jobs.
std::optional<Place> saved_place(const machine::Machine& machine);

/// How many commands of the USB side had no acknowledgement since power-on because their dialect has none.
std::uint64_t commands_without_ok(const machine::Machine& machine);

/// The number of a field; nothing on a machine that has none.
std::optional<double> number_of(const machine::Machine& machine, std::string_view path);

/// When an invariant is looked at.
enum class Moment : std::uint8_t {
    output,     ///< something goes out on a line
    step,       ///< after each thing that happens to the board
    power_cut,  ///< the board has just been switched on again
    peace,      ///< at the end: all troubles taken away, time given, and each line asked once
};

/// A promise, in words that a user can rely on, and what finds out that it was broken.
struct Invariant {
    Moment moment;
    std::string_view name;
    std::string_view promise;
    /// What was found instead; empty when it holds.
    std::string (*broken)(const View& view);
};

/// All of them. Two more are looked at by whoever plays a world: equal seed, equal bytes (Outcome::digest);
/// and that it ends.
std::span<const Invariant> invariants();

}  // namespace fauxboard::world
