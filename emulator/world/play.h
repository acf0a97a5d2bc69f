#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/machine/sim_time.h"
#include "emulator/world/cast.h"

namespace fauxboard::world {

/// How a world went.
struct Outcome {
    std::string broken;        ///< what of which promise; empty: all held
    machine::SimTime time{0};  ///< virtual, of all its boards
    std::uint64_t digest = 0;  ///< of all that was heard and said, and when: the same for the same seed
    std::uint64_t requests = 0;
    bool held() const { return broken.empty(); }
};

/// Plays the steps of these numbers, and peace at the end. Any exception is a broken promise. `listener` is
/// told all that a recorder would be.
Outcome play(const Cast& cast, std::uint64_t seed, const std::vector<std::uint64_t>& steps,
             board::Observer* listener = nullptr);

/// The numbers 0 to `count` - 1: a whole world.
std::vector<std::uint64_t> whole(std::uint64_t count);

/// The fewest of the steps, found by leaving out, with which the same promise is broken.
std::vector<std::uint64_t> shrink(const Cast& cast, std::uint64_t seed, std::vector<std::uint64_t> steps);

/// A bug report: profile, seed and steps, what they are, and what was broken.
std::string report(const Cast& cast, std::uint64_t seed, const std::vector<std::uint64_t>& steps);

/// What many worlds came to.
struct Soaked {
    std::uint64_t seeds = 0;
    std::uint64_t requests = 0;
    machine::SimTime time{0};
    std::uint64_t digest = 0;  ///< of all of them: the same for the same seeds, whatever compiled the program
    std::string broken;        ///< the report of the first one that did; empty: none
};
/// Plays worlds of `steps` steps from `seed` on until `enough` says so, or a promise is broken. Every
/// sixteenth is played twice: the same seed must give the same bytes.
Soaked soak(const Cast& cast, std::uint64_t seed, std::uint64_t steps,
            const std::function<bool(const Soaked& so_far)>& enough);

}  // namespace fauxboard::world
