#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "emulator/behaviour/value.h"
#include "emulator/machine/machine.h"

namespace fauxboard::behaviour {

/// A list that a kind of machine has for the screen that is part of its board: the files of a folder.
struct List {
    std::string_view path;
    std::string_view help;
    std::span<const std::string_view> columns;      ///< the first is what an entry is called
    std::size_t (*count)(const machine::Machine&);  ///< 0 on a machine of another kind
    /// Row and column from 0. Borrowed texts live until the machine is changed.
    Value (*get)(const machine::Machine&, std::size_t row, std::size_t column);
};

/// Pictures that a kind of machine has, by index from 0: previews, what a panel shows.
struct Picture {
    std::string_view path;
    std::string_view help;
    /// False when there is none now, or the machine is of another kind.
    bool (*size)(const machine::Machine&, std::size_t index, std::uint32_t& width, std::uint32_t& height);
    /// One row of it, each pixel 0xRRGGBB. False when it cannot be had.
    bool (*row)(const machine::Machine&, std::size_t index, std::uint32_t y, std::span<std::uint32_t> rgb);
};

/// The list, or the picture, at `path`, of whatever kind; null when there is none.
const List* find_list(std::string_view path);
const Picture* find_picture(std::string_view path);
/// The path that looks most like `path`; empty when nothing does.
std::string_view nearest_picture(std::string_view path);

}  // namespace fauxboard::behaviour
