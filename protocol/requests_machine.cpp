// Requests about the machine itself: moves, motors, heaters, fans, mixing, tools.

#include "protocol/tables.h"

namespace fauxboard::protocol::tables {

namespace {

constexpr ValueName relative_moves[] = {{0, "relative"}};
constexpr FieldInfo move[] = {
    number("X", "X", "mm"),
    number("Y", "Y", "mm"),
    number("Z", "Z", "mm"),
    number("E", "E", "mm"),
    number("F", "feedrate", "mm/min"),
    choice("I", "move", relative_moves, "of ChiTu's hosts"),
};
constexpr FieldInfo arc[] = {
    number("X", "X", "mm"), number("Y", "Y", "mm"),
    number("Z", "Z", "mm"), number("I", "I", "mm"),
    number("J", "J", "mm"), number("R", "radius", "mm"),
    number("E", "E", "mm"), number("F", "feedrate", "mm/min"),
};
constexpr FieldInfo dwell[] = {number("S", "time", "s"), number("P", "time", "ms")};
constexpr FieldInfo axes[] = {word("X", "X"), word("Y", "Y"), word("Z", "Z"), word("E", "E")};
constexpr FieldInfo position[] = {
    number("X", "X", "mm"),
    number("Y", "Y", "mm"),
    number("Z", "Z", "mm"),
    number("E", "E", "mm"),
};
constexpr FieldInfo motors_off[] = {
    word("X", "X"), word("Y", "Y"), word("Z", "Z"), word("E", "E"), number("S", "after", "s"),
};
constexpr FieldInfo heater[] = {
    number("S", "target", "°C", -1, "0: off"),
    integer("T", "extruder"),
};
constexpr FieldInfo heater_wait[] = {
    number("S", "target", "°C", -1, "0: off"),
    number("R", "target, also cooling down", "°C"),
    integer("T", "extruder"),
};
constexpr ValueName fan_names[] = {{0, "part fan"}, {1, "board fan"}, {2, "second fan"}};
constexpr FieldInfo fan[] = {choice("P", "fan", fan_names), integer("S", "speed", "of 255", "0..255")};
constexpr FieldInfo fan_off[] = {choice("P", "fan", fan_names)};
constexpr FieldInfo speed[] = {integer("S", "speed", "%", "10..999")};
constexpr FieldInfo flow[] = {integer("S", "flow", "%")};
constexpr FieldInfo babystep[] = {
    number("Z", "Z", "mm", 2, "the whole offset, not a step; refused until homed (C)")};
constexpr FieldInfo mix_weights[] = {
    number("A", "E0", {}, 1, "weights, normalised to percent"),
    number("B", "E1", {}, 1),
    number("C", "E2", {}, 1),
    number("D", "E3", {}, 1),
};
constexpr FieldInfo mix_one[] = {integer("S", "extruder"), number("P", "weight")};
constexpr FieldInfo mix_store[] = {integer("S", "tool")};
constexpr FieldInfo mix_gradient[] = {
    number("A", "from height", "mm"), number("Z", "to height", "mm"), integer("I", "from tool"),
    integer("J", "to tool"),          flag("S", "gradient", off_on),  integer("T", "tool"),
};
constexpr FieldInfo filament_change[] = {
    number("E", "retract", "mm"), number("L", "unload", "mm"), number("X", "X", "mm"),
    number("Y", "Y", "mm"),       number("Z", "lift", "mm"),
};

constexpr CodeInfo codes[] = {
    request('G', 0, "move", "Travel to a position.", move, "L1"),
    request('G', 1, "move", "Move, extruding or not.", move, "L1"),
    request('G', 2, "arc", "Move on an arc, clockwise.", arc, "L1"),
    request('G', 3, "arc", "Move on an arc, counter-clockwise.", arc, "L1"),
    request('G', 4, "wait", "Do nothing for a time.", dwell),
    request('G', 28, "home", "Home the axes named, all when none is.", axes, "L1, L12"),
    request('G', 29, "probe the bed", "Measure the bed on its grid.", {}, "L1"),
    request('G', 90, "absolute coordinates", "Moves that follow name their end.", {}),
    request('G', 91, "relative coordinates", "Moves that follow name their way.", {}),
    request('G', 92, "set position", "Call the present place by these coordinates.", position),
    request('M', 0, "continue", "The user has confirmed, after L18 P26 S15.", {}, "L3"),
    request('M', 17, "motors on", "Power the motors.", axes, "L3"),
    request('M', 18, "motors off", "Release the motors; the position is lost.", motors_off, "L3"),
    request('M', 82, "absolute extrusion", "E names an end.", {}),
    request('M', 83, "relative extrusion", "E names a length.", {}),
    request('M', 84, "motors off", "As M18.", motors_off, "L3"),
    request('M', 104, "nozzle", "Set the nozzle's target.", heater, "L2"),
    request('M', 105, "temperature query", "Ask for temperatures.", {}, "L2"),
    request('M', 106, "fan", "Set a fan's speed.", fan, "L6 by the document; A30T boards show it in L2"),
    request('M', 107, "fan off", "Stop a fan.", fan_off, "L6 by the document; A30T boards show it in L2"),
    request('M', 108, "break off", "End heating or PID tuning, after L18 P26 S14.", {}, "L3"),
    request('M', 109, "nozzle, wait", "Set the nozzle's target and wait for it.", heater_wait, "L2"),
    request('M', 112, "emergency stop", "Heaters and motors off, the job ends.", {}, "L3"),
    request('M', 114, "position query", "Ask for the position.", {}, "L1"),
    request('M', 140, "bed", "Set the bed's target.", heater, "L2"),
    request('M', 163, "mixing weight", "Set one weight of the mix being made.", mix_one),
    request('M', 164, "store the mix", "Keep the mix as a tool.", mix_store),
    request('M', 165, "mixing ratio", "Set all weights at once.", mix_weights,
            "L22 in its slot, when changed"),
    request('M', 166, "mixing gradient", "Change the mix with the height.", mix_gradient),
    request('M', 190, "bed, wait", "Set the bed's target and wait for it.", heater_wait, "L2"),
    request('M', 220, "print speed", "Scale all feedrates.", speed,
            "L5 by the document; A30T boards show it in L2"),
    request('M', 221, "flow", "Scale the extrusion.", flow),
    request('M', 290, "babystep", "Set the babystep.", babystep, "L24 P5"),
    request('M', 400, "finish moves", "Wait until all moves are done.", {}),
    request('M', 600, "change filament", "Stop for a change of filament.", filament_change, "L3"),
    request('T', 0, "tool 0", "Select extruder 0, or its mix.", {}, "L22"),
    request('T', 1, "tool 1", "Select extruder 1, or its mix.", {}, "L22"),
    request('T', 2, "tool 2", "Select extruder 2, or its mix.", {}, "L22"),
    request('T', 3, "tool 3", "Select extruder 3, or its mix.", {}, "L22"),
};

}  // namespace

std::span<const CodeInfo> machine_requests() {
    return codes;
}

}  // namespace fauxboard::protocol::tables
