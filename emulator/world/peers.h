#pragma once

#include <array>
#include <cstdint>
#include <iterator>
#include <string>

#include "emulator/fault/dice.h"

namespace fauxboard::world {

class World;

template <class List>
const auto& one_of(const List& list, fault::Dice& dice) {
    return list[dice.below(std::size(list))];
}

/// A number below each of these bounds, drawn in the order in which they stand, whatever compiler evaluates
/// arguments in which order: a seed plays the same world everywhere.
template <class... Bounds>
std::array<std::uint64_t, sizeof...(Bounds)> draw(fault::Dice& dice, Bounds... bounds) {
    return {dice.below(static_cast<std::uint64_t>(bounds))...};
}

// What those at the other ends of the lines do, well or badly: rows of the table in steps.cpp.
// -----------------------------------------------------------------------------------------------
void screen_asks(World& w, fault::Dice& dice);
void screen_stammers(World& w, fault::Dice& dice);
void screen_is_touched(World& w, fault::Dice& dice);
void screen_floods(World& w, fault::Dice& dice);
void host_commands(World& w, fault::Dice& dice);
void host_floods(World& w, fault::Dice& dice);
void host_stammers(World& w, fault::Dice& dice);
void host_prints(World& w, fault::Dice& dice);
void host_uploads(World& w, fault::Dice& dice);
void network_asks(World& w, fault::Dice& dice);
void network_uploads(World& w, fault::Dice& dice);

/// A file by somebody who was not there before, whoever left one unfinished. Why it was refused; empty: it
/// was not, or such a board takes none.
std::string upload_of_a_newcomer(World& w);

}  // namespace fauxboard::world
