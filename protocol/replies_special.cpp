// L10..L24 and the lines a board sends without an L code.

#include "protocol/tables.h"

namespace fauxboard::protocol::tables {

namespace {

constexpr FieldInfo l10[] = {
    number("S", "Z", "mm", 2),
    number("X", "endstop adjustment X", "mm", -1, "X and all that follow: delta printers only"),
    number("Y", "endstop adjustment Y", "mm"),
    number("Z", "endstop adjustment Z", "mm"),
    number("H", "print height", "mm"),
    number("O", "delta radius error", "mm"),
    number("R", "delta radius", "mm"),
    number("D", "diagonal rod", "mm"),
    number("F", "smooth rod offset", "mm"),
};

constexpr ValueName nothing_more[] = {{0, "probe"}};
constexpr FieldInfo l11[] = {choice("P", "what", nothing_more, "always 0"), number("S", "Z offset", "mm", 2)};

constexpr ValueName extruder_states[] = {
    {0, "done"}, {1, "retract 10 mm"}, {2, "loading"}, {3, "unloading"}, {5, "cleaning"},
};
constexpr ValueName machine[] = {{0, "machine"}};
constexpr FieldInfo l12[] = {
    choice("P", "what", machine, "always 0"),
    choice("S", "state", extruder_states, "0 also ends a homing and a wait for a temperature (C)"),
};

constexpr FieldInfo l13[] = {text("", "message", "`Disk select success`")};
constexpr FieldInfo l14[] = {
    text("", "message", "M117's text with its leading blank; the A30 screen shows up to 39 characters")};
constexpr FieldInfo l15[] = {flag("S", "filament detector", off_on)};

constexpr ValueName power_loss[] = {{0, "power-loss recovery"}, {1, "screen"}};
constexpr ValueName restart[] = {{0, "restart"}};
constexpr FieldInfo l16[] = {
    choice("P", "what", power_loss),
    when(0, integer("", "offer", {}, "15: a saved print can be resumed (F)")),
    when(0, integer("S", "state")),
    when(1, choice("S", "do", restart)),
};

constexpr FieldInfo l17[] = {integer("S", "result", {}, "reserved")};

constexpr ValueName pages[] = {{26, "message page"}};
// As the A30T's screen words them (profiles/screens), 6 to 9: a print of the SD card, of the PC.
constexpr ValueName exceptions[] = {
    {0, "no filament"},
    {1, "SD card removed"},
    {2, "resume the interrupted print?"},
    {3, "file not found"},
    {4, "hotend temperature abnormal"},
    {5, "bed temperature abnormal"},
    {6, "hotend temperature abnormal, print stopped"},
    {7, "bed temperature abnormal, print stopped"},
    {8, "hotend temperature abnormal, stop the print"},
    {9, "bed temperature abnormal, stop the print"},
    {10, "cannot open the file"},
    {11, "3D Touch alarm: check and retry"},
    {12, "hotend too cold to change filament"},
    {13, "not available while printing"},
    {14, "stop the PID tuning?"},
    {15, "waiting for the user"},
};
constexpr FieldInfo l18[] = {
    choice("P", "page", pages),
    choice("S", "exception", exceptions,
           "15 and above crash an A30 screen, 16 and above show an empty question"),
};

constexpr ValueName stepper_parts[] = {{0, "mode"}, {1, "command"}, {2, "report"}};
constexpr FieldInfo l19[] = {
    choice("P", "what", stepper_parts),
    integer("S", "state"),
    integer("C", "motor or command"),
    integer("D", "value"),
    when(2, integer("SM:", "motor")),
    when(2, number("TC:", "calibration error", "°")),
    when(2, integer("ED:", "enable level")),
    when(2, integer("DI:", "direction level", {}, "the document's name")),
    when(2, integer("DP:", "direction level", {}, "the name the A30 screen reads")),
    when(2, integer("MS:", "microsteps")),
    when(2, integer("MC:", "largest current", "mA")),
    when(2, integer("HC:", "holding current", "mA")),
};

constexpr ValueName update_steps[] = {{0, "start"}};
constexpr FieldInfo l20[] = {choice("S", "step", update_steps)};

constexpr ValueName questions[] = {{0, "firmware version?"}};
constexpr ValueName screen_part[] = {{0, "screen"}};
constexpr FieldInfo l21[] = {choice("P", "what", screen_part), choice("S", "question", questions)};

constexpr ValueName mixing_modes[] = {
    {0, "mixing off"},
    {256, "fixed ratio"},
    {512, "template"},
    {768, "ratio by height"},
};
constexpr FieldInfo l22[] = {
    choice("MS:", "mode", mixing_modes, "256 x S of M2138; the lower byte is the kind within the mode"),
    mixing("MR:", "mixing ratio"),
    mixing("SP:", "start ratio"),
    mixing("EP:", "end ratio"),
    number("SH:", "start height", "mm", 2),
    number("EH:", "end height", "mm", 2),
};

constexpr ValueName sound[] = {{0, "sound off"}, {1, "sound on"}};
constexpr ValueName backlight[] = {{0, "backlight setting off"}, {1, "backlight setting on"}};
constexpr ValueName lock[] = {{0, "screen lock off"}, {1, "screen lock on"}};
constexpr ValueName deviation[] = {{0, "hotend correction off"}, {1, "hotend correction on"}};
constexpr FieldInfo l23[] = {
    flag("SE:", "sound", sound),
    flag("BE:", "backlight setting", backlight),
    integer("BP:", "backlight", "%", "1..100"),
    flag("CE:", "screen lock", lock),
    flag("HE:", "hotend correction", deviation),
    integer("SP:", "password", {}, "four digits, leading zeros left out"),
    integer("ST:", "lock after", "s"),
    integer("HC:", "correction centre", "°C"),
    integer("HO:", "correction", "°C"),
};

constexpr ValueName settings_pages[] = {
    {0, "steps per mm"}, {1, "velocities"}, {2, "accelerations"}, {3, "jerk"},
    {4, "unknown page"}, {5, "babystep"},   {6, "home offsets"},
};
constexpr FieldInfo l24[] = {
    choice("P", "page", settings_pages),
    when(0, number("A", "X", "steps/mm", 2)),
    when(0, number("B", "Y", "steps/mm", 2)),
    when(0, number("C", "Z", "steps/mm", 2)),
    when(0, number("D", "E", "steps/mm", 2)),
    when(1, number("A", "X", "mm/s", 0)),
    when(1, number("B", "Y", "mm/s", 0)),
    when(1, number("C", "Z", "mm/s", 0)),
    when(1, number("D", "E", "mm/s", 0)),
    when(1, number("E", "least", "mm/s", 0)),
    when(1, number("F", "least travel", "mm/s", 0)),
    when(2, number("A", "printing", "mm/s²", 0, "T says steps/s², but 500 of those would be 6 mm/s²")),
    when(2, number("B", "retract", "mm/s²", 0)),
    when(2, number("C", "X", "mm/s²", 0)),
    when(2, number("D", "Y", "mm/s²", 0)),
    when(2, number("E", "Z", "mm/s²", 0)),
    when(2, number("F", "E", "mm/s²", 0)),
    when(3, number("A", "X", "mm/s", 2)),
    when(3, number("B", "Y", "mm/s", 2)),
    when(3, number("C", "Z", "mm/s", 2)),
    when(3, number("D", "E", "mm/s", 2)),
    when(5, number("A", "Z", "mm", 2)),
    when(6, number("A", "Z0", "mm", 2)),
    when(6, number("B", "Z1", "mm", 2)),
};

constexpr CodeInfo codes[] = {
    reply(10, "manual leveling", "Height reached, after every M2107.", l10),
    reply(11, "auto leveling", "The probe's Z offset.", l11),
    reply(12, "extruder", "State of loading and unloading; also the end of a long action.", l12),
    reply(13, "disk selection", "Answer to M2115.", l13),
    reply(14, "message", "Text for the print page.", l14),
    reply(15, "filament detector", "Reserved: boards answer with L3.", l15),
    reply(16, "restart", "Offers to resume after a power loss, or restarts the screen.", l16, "M2130"),
    reply(17, "motor move", "Reserved.", l17),
    reply(18, "exception", "Opens a page for something out of order.", l18),
    reply(19, "closed-loop steppers", "State of the stepper control boards.", l19),
    reply(20, "screen firmware update", "Starts the update of the screen.", l20, "M2100"),
    reply(21, "question to the screen", "Repeated until the screen has told its version.", l21, "M2134"),
    reply(22, "mixing", "Mixing mode, ratio and template.", l22),
    reply(23, "add-ons", "Sound, backlight, screen lock.", l23),
    reply(24, "settings", "One page of settings, named by P.", l24),
};

constexpr FieldInfo sd_progress[] = {integer("", "at"), integer("/", "of", "bytes")};
constexpr FieldInfo start_print[] = {text("", "file", "volume and path: SD1:/A30T/cube.gco")};
constexpr FieldInfo manual_leveling[] = {
    number("Z:", "Z", "mm", 2),
    word("ok", "point reached"),
    word("fail", "point not reached"),
    word("save success", "saved"),
};
constexpr FieldInfo screen_update[] = {text("start:", "firmware file", "must hold `bin`", ';')};

constexpr CodeInfo bare[] = {
    {0,
     0,
     "SD printing byte",
     Direction::to_screen,
     "SD progress",
     "Answer to M27, sent without frame.",
     sd_progress,
     {}},
    {0,
     0,
     "Start Print:",
     Direction::to_screen,
     "print started",
     "Answer to M24, sent without frame.",
     start_print,
     {}},
    {0,
     0,
     "Stop Print",
     Direction::to_screen,
     "print stopped",
     "Answer to M2103, sent without frame.",
     {},
     {}},
    {'M',
     2107,
     {},
     Direction::to_screen,
     "manual leveling",
     "Answer to M2107, sent without frame before L10.",
     manual_leveling,
     {}},
    {'M',
     2121,
     {},
     Direction::to_screen,
     "screen firmware update",
     "Announces a firmware file.",
     screen_update,
     "M2121"},
};

}  // namespace

std::span<const CodeInfo> special_replies() {
    return codes;
}
std::span<const CodeInfo> bare_replies() {
    return bare;
}

}  // namespace fauxboard::protocol::tables
