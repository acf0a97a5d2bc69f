// Boards that speak as hosts do: what Marlin is asked beyond the usual codes, and how its lines begin.
// Source: Marlin 2.1.2.7, as it stands in the answers of the profile `marlin`.

#include "protocol/tables.h"

namespace fauxboard::protocol::tables {

namespace {

constexpr FieldInfo rest[] = {text("", "text")};
constexpr FieldInfo seconds[] = {number("S", "every", "s", -1, "0: never")};
constexpr FieldInfo answer[] = {integer("S", "button", {}, "0 is the first")};
constexpr FieldInfo progress[] = {number("P", "progress", "%"), number("R", "left", "min")};
constexpr FieldInfo tuning[] = {integer("E", "heater", {}, "-1: the bed"), number("S", "target", "°C"),
                                integer("C", "cycles"), word("U", "use the result")};
constexpr FieldInfo leveling[] = {flag("S", "leveling", off_on), number("Z", "fade height", "mm"),
                                  word("V", "print the mesh")};
constexpr FieldInfo xyz[] = {number("X", "X", "mm"), number("Y", "Y", "mm"), number("Z", "Z", "mm")};
constexpr FieldInfo pid[] = {number("P", "P"), number("I", "I"), number("D", "D")};
constexpr FieldInfo factor[] = {number("K", "K")};
constexpr FieldInfo sensor[] = {flag("S", "sensor", off_on), number("D", "distance", "mm")};
constexpr FieldInfo recovery[] = {flag("S", "recovery", off_on)};
constexpr FieldInfo cold[] = {number("S", "least", "°C"), flag("P", "cold extrusion", off_on)};

/// "T:22.00 /0.00 B:22.00 /0.00 @:0 B@:0 W:?", behind the "T:" that its line begins with.
constexpr FieldInfo temperatures[] = {
    number("", "nozzle", "°C", 2),
    bracketed(number("/", "target", "°C", 2)),
    number("B:", "bed", "°C", 2),
    bracketed(number("/", "target", "°C", 2)),
    number("C:", "chamber", "°C", 2),
    bracketed(number("/", "target", "°C", 2)),
    number("T0:", "extruder 0", "°C", 2),
    bracketed(number("/", "target", "°C", 2)),
    number("T1:", "extruder 1", "°C", 2),
    bracketed(number("/", "target", "°C", 2)),
    integer("@:", "nozzle power", "of 127"),
    integer("B@:", "bed power", "of 127"),
    text("W:", "must hold for", "whole seconds; ? while it is not there"),
};
constexpr FieldInfo place[] = {
    number("", "X", "mm", 2),   number("Y:", "Y", "mm", 2), number("Z:", "Z", "mm", 2),
    number("E:", "E", "mm", 2), text("Count", "steps"),
};

constexpr CodeInfo asked(std::uint16_t number, std::string_view title, std::string_view meaning,
                         std::span<const FieldInfo> fields, std::string_view reply = "ok") {
    return request('M', number, title, meaning, fields, reply);
}
constexpr CodeInfo told(std::string_view word, std::string_view title, std::string_view meaning,
                        std::span<const FieldInfo> fields = {}) {
    return {0, 0, word, Direction::to_screen, title, meaning, fields, {}};
}

constexpr CodeInfo requests[] = {
    asked(48, "probe repeatability", "Probes one place again and again.", rest, "Mean:"),
    asked(73, "set progress", "The slicer's own word for how far the print is.", progress),
    asked(75, "start the print's timer", "For the statistics.", {}),
    asked(76, "pause the print's timer", "For the statistics; a host may pause as well.", {}),
    asked(77, "stop the print's timer", "For the statistics.", {}),
    asked(78, "print statistics", "How many prints, how long, how much filament.", {}, "Stats:"),
    asked(113, "keepalive", "How often a waiting host is told so.", seconds),
    asked(118, "say", "The board says the text.", rest, "the text"),
    asked(125, "park and pause", "The head parks and the board waits for its user.", rest),
    asked(154, "position reports", "The position comes by itself.", seconds),
    asked(155, "temperature reports", "Temperatures come by themselves.", seconds),
    asked(211, "soft end stops", "Whether moves end at the volume's borders.", recovery),
    asked(301, "nozzle PID", "The controller's constants.", pid),
    asked(302, "cold extrusion", "How warm a nozzle must be for filament to move.", cold),
    asked(303, "PID tuning", "Finds the constants of a heater's controller.", tuning, "PID Autotune start"),
    asked(304, "bed PID", "The controller's constants.", pid),
    asked(306, "model predictive control", "Constants of the nozzle's model, or T: finds them.", rest),
    asked(410, "quick stop", "Drops all moves, at once.", {}),
    asked(412, "runout sensor", "Whether the sensor ends a print without filament.", sensor),
    asked(413, "power-loss recovery", "Whether a print can be taken up again after a power cut.", recovery),
    asked(420, "leveling", "Switches the mesh on and off, or shows it.", leveling),
    asked(486, "cancel objects", "Objects of a print are left out from here on.", rest),
    asked(503, "settings query", "Every setting as a command that sets it.", {}, "all settings"),
    asked(524, "stop the print", "The print from the card ends.", {}),
    asked(701, "load filament", "Moves filament in, and asks whether to purge more.", rest),
    asked(702, "unload filament", "Moves filament out.", rest),
    asked(808, "repeat marker", "A file goes back to it so often.", rest),
    asked(851, "probe offset", "Where the probe is, seen from the nozzle.", xyz),
    asked(876, "answer a question", "The host's user has chosen a button.", answer),
    asked(900, "linear advance", "The extruder's lead.", factor),
    asked(928, "log to a file", "What comes is written to a file and carried out.", rest),
    asked(997, "restart", "The board starts anew.", {}),
    asked(999, "go on after a stop", "The board takes commands again.", {}, "Resend:"),
    asked(1000, "take the print up again", "After a power cut.", {}),
};

constexpr CodeInfo replies[] = {
    told("ok T:", "temperatures", "Answer to M105.", temperatures),
    told("T:", "temperatures", "Of a wait for a heater, or a report (M155).", temperatures),
    told("X:", "position", "Answer to M114, also behind moves of their own; or a report (M154).", place),
    told("Resend:", "again, please", "The number of the line wanted next.", rest),
    told("echo:busy:", "busy", "The board is at work, or waits for its user; it has heard.", rest),
    told("echo:Unknown command:", "unknown command", "The board does not know it.", rest),
    told("echo:Now fresh file:", "file chosen", "Ahead of what M23 and M28 say.", rest),
    told("Writing to file:", "upload begins", "Answer to M28.", rest),
    told("Done saving file.", "file written", "Answer to M29."),
    told("Done printing file", "print finished", "The file's end was reached."),
    told("Not SD printing", "no print", "Answer to M27."),
    told("echo:", "message", "For the user.", rest),
    told("//action:prompt_begin", "question", "To the host's user; its buttons follow.", rest),
    told("//action:prompt_button", "button", "Of the question; M876 S answers with its number.", rest),
    told("//action:prompt_show", "question is whole", "The host shows it."),
    told("//action:prompt_end", "question is over", "The host takes it away."),
    told("//action:", "host action", "What the host should do.", rest),
    told("FIRMWARE_NAME:", "identity", "Answer to M115.", rest),
    told("Cap:", "capability", "What the firmware was built with; 0 without, 1 with.", rest),
    told("PowerUp", "power-on", "Why the board started."),
    told("External Reset", "reset", "Why the board started."),
    told("Software Reset", "reset", "Why the board started."),
    told("Watchdog Reset", "reset", "Why the board started."),
    told("Brown out Reset", "reset", "Why the board started."),
    told("Marlin", "firmware", "Its version.", rest),
    told("FR:", "print speed", "Answer to M220.", rest),
    told("Stats:", "print statistics", "Answer to M78.", rest),
};

}  // namespace

std::span<const CodeInfo> marlin_requests() {
    return requests;
}
std::span<const CodeInfo> marlin_replies() {
    return replies;
}

}  // namespace fauxboard::protocol::tables
