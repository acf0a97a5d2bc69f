#pragma once

#include <span>
#include <string_view>

#include "emulator/fault/dice.h"

namespace fauxboard::world {

class World;

/// A kind of thing that can happen. A new one is a new row.
struct StepKind {
    std::string_view name;
    unsigned weight;  ///< how often, against the others
    void (*run)(World& world, fault::Dice& dice);
};

std::span<const StepKind> step_kinds();

/// The name of what the dice say.
std::string_view step_name(fault::Dice dice);

/// What the dice say: lets some time pass, and one thing happen.
void do_step(World& world, fault::Dice& dice);

}  // namespace fauxboard::world
