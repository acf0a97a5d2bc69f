// Requests only a Smartto board knows, and what the screen says without a code.

#include "protocol/tables.h"

namespace fauxboard::protocol::tables {

namespace {

constexpr ValueName z_motors[] = {{0, "Z0"}, {1, "Z1"}};
constexpr FieldInfo home_offset[] = {choice("P", "motor", z_motors),
                                     number("S", "offset", "mm", 2, "added to the present one; 0 clears it")};

constexpr ValueName update_steps[] = {
    {0, "start, from the PC"}, {1, "screen ready"},   {2, "done or given up"},
    {4, "failed, once more"},  {5, "screen started"},
};
constexpr FieldInfo screen_update[] = {choice("S", "step", update_steps)};

constexpr FieldInfo status[] = {word("LCD", "for the screen")};

constexpr ValueName feeding[] = {
    {0, "feed 10 mm"},           {1, "retract 10 mm"}, {2, "load until stopped"},
    {3, "unload until stopped"}, {4, "stop"},          {5, "clean until stopped"},
};
constexpr FieldInfo extruder[] = {choice("S", "do", feeding)};

constexpr ValueName detector_part[] = {{0, "filament detector"}};
constexpr FieldInfo detector[] = {choice("P", "what", detector_part), flag("S", "detector", off_on)};

// T's field table has up and down of S9 and S10 the other way round than its button table and Z; the buttons
// win.
constexpr ValueName manual_steps[] = {
    {0, "home and go to the start height"},
    {1, "point 1, rear right"},
    {2, "point 2, rear left"},
    {3, "point 3, front left"},
    {4, "point 4, front right"},
    {5, "point 5, centre"},
    {6, "Z up 0.5 mm"},
    {7, "Z down 0.5 mm"},
    {8, "save"},
    {9, "Z down 0.05 mm"},
    {10, "Z up 0.05 mm"},
    {11, "leave"},
    {12, "adjust the delta's endstops"},
    {13, "home the delta"},
};
constexpr FieldInfo manual[] = {choice("S", "do", manual_steps)};

constexpr ValueName moves[] = {
    {0, "motors on"}, {1, "motors off"}, {2, "move X"}, {3, "move Y"}, {4, "move Z"},
};
constexpr FieldInfo motor_move[] = {
    choice("S", "do", moves),
    when(2, number("X", "by", "mm")),
    when(3, number("Y", "by", "mm")),
    when(4, number("Z", "by", "mm")),
};

constexpr ValueName disks[] = {{0, "SD card"}, {1, "U-disk"}};
constexpr FieldInfo disk[] = {choice("S", "disk", disks)};

constexpr ValueName auto_parts[] = {
    {0, "leveling"},      {1, "probe pin"},      {2, "save the Z offset"}, {3, "Z up"},
    {4, "Z down"},        {5, "Z offset query"}, {6, "to the centre"},     {7, "measure at the centre"},
    {9, "kind of probe"},
};
constexpr ValueName pin[] = {{0, "up"}, {1, "down"}, {2, "alarm release"}};
constexpr ValueName centred[] = {{0, "nozzle"}, {1, "probe"}};
constexpr ValueName measured[] = {{0, "probe"}};
constexpr ValueName probe_kinds[] = {{0, "capacitive"}, {1, "3D Touch"}};
constexpr FieldInfo auto_leveling[] = {
    choice("P", "what", auto_parts),           when(0, flag("S", "leveling", off_on)),
    when(1, choice("S", "pin", pin)),          when(2, number("S", "Z offset", "mm", 2)),
    when(3, choice("S", "step", z_steps)),     when(4, choice("S", "step", z_steps)),
    when(6, choice("S", "what", centred)),     when(7, choice("S", "what", measured)),
    when(9, choice("S", "kind", probe_kinds)),
};

constexpr FieldInfo update_result[] = {word("ok", "file taken"), word("fail", "file not taken")};

constexpr ValueName loss_parts[] = {{0, "saved print"}, {1, "screen"}};
constexpr ValueName loss_answers[] = {{0, "discard"}, {1, "resume"}};
constexpr ValueName screen_restart[] = {{0, "restart"}};
constexpr FieldInfo power_loss[] = {
    choice("P", "what", loss_parts),
    when(0, choice("S", "do", loss_answers)),
    when(1, choice("S", "do", screen_restart)),
};

constexpr ValueName wifi_parts[] = {{0, "WiFi"}, {1, "auto connect"}, {2, "access point set-up"}};
constexpr FieldInfo wifi[] = {choice("P", "what", wifi_parts, "none: ask for the state"),
                              flag("S", "state", off_on)};

constexpr ValueName stepper_parts[] = {{0, "mode"}, {1, "command"}, {2, "report"}};
constexpr ValueName stepper_commands[] = {
    {0, "calibrate"},  {1, "test calibration"}, {2, "enable level"},      {3, "direction level"},
    {4, "microsteps"}, {5, "largest current"},  {6, "holding current"},   {7, "read position"},
    {8, "PID"},        {9, "error limit"},      {10, "factory settings"}, {11, "set zero"},
};
constexpr FieldInfo steppers[] = {
    choice("P", "what", stepper_parts),        when(0, integer("C", "motor")),
    when(0, flag("D", "closed loop", off_on)), when(1, choice("C", "command", stepper_commands)),
    when(1, number("D", "value 1")),           when(1, number("E", "value 2")),
    when(1, number("F", "value 3")),
};

constexpr FieldInfo exception[] = {integer("P", "page"), integer("S", "exception")};

constexpr FieldInfo screen_version[] = {text("FW:", "firmware")};

// P is the packed ratio from an A30T; by the document P is the tool and S its percent.
constexpr FieldInfo tool_mix[] = {mixing("P", "ratio, or tool"), integer("S", "percent", "%")};
constexpr FieldInfo mix_template[] = {integer("S", "template", {}, "1..8 ready-made, 1..6 custom")};
constexpr FieldInfo template_range[] = {
    mixing("A", "start ratio"),
    mixing("B", "end ratio"),
    number("C", "start height", "mm"),
    number("D", "end height", "mm"),
};
constexpr ValueName mix_modes[] = {
    {0, "off"}, {1, "fixed ratio"}, {2, "ready-made template"}, {3, "template"}};
constexpr FieldInfo mix_mode[] = {choice("S", "mode", mix_modes, "x 256 is MS: of L22")};

constexpr ValueName addon_parts[] = {
    {0, "sound"}, {1, "backlight"}, {2, "screen lock"}, {3, "hotend correction"}};
constexpr FieldInfo addons[] = {
    choice("P", "what", addon_parts, "none: ask for the state"),
    when(0, flag("S", "sound", off_on)),
    when(1, flag("S", "backlight setting", off_on)),
    when(1, integer("E", "brightness", "%", "0..100")),
    when(2, flag("S", "lock", off_on)),
    when(2, integer("W", "password", {}, "four digits, leading zeros left out")),
    when(2, integer("E", "lock after", "s")),
    when(3, number("A", "correction", "°C")),
    when(3, number("B", "centre", "°C")),
};

constexpr ValueName settings_pages[] = {
    {0, "steps per mm"}, {1, "velocities"}, {2, "accelerations"}, {3, "jerk"},
    {4, "unknown page"}, {5, "babystep"},   {6, "home offsets"},
};
constexpr ValueName restored[] = {{0, "stored settings back"}};
constexpr FieldInfo settings[] = {choice("S", "page", settings_pages), choice("R", "restore", restored)};

constexpr ValueName move_steps[] = {{0, "30 mm"}, {1, "10 mm"}, {2, "1 mm"}, {3, "0.5 mm"}, {4, "0.1 mm"}};
constexpr FieldInfo move_step[] = {choice("S", "step", move_steps)};
constexpr FieldInfo leveling_step[] = {choice("S", "step", z_steps)};

constexpr FieldInfo log_text[] = {text("", "message")};
constexpr FieldInfo touch_point[] = {text("", "point")};
constexpr FieldInfo touch_values[] = {text("", "values")};

constexpr CodeInfo words(std::string_view start, std::string_view title, std::string_view meaning,
                         std::span<const FieldInfo> fields) {
    return {0, 0, start, Direction::to_board, title, meaning, fields, {}};
}

constexpr CodeInfo codes[] = {
    request('L', 1, "move step", "Step of the screen's move page.", move_step),
    request('L', 2, "leveling step", "Step of the screen's auto-level page.", leveling_step),
    request('L', 101, "manual leveling left", "Back to the usual status frames.", {}),
    request('M', 2011, "home offset", "Change the home offset of one of two Z motors.", home_offset,
            "L24 P6"),
    request('M', 2100, "screen firmware update", "Hand-shake of the update of the screen.", screen_update,
            "L20, L8"),
    request('M', 2101, "print status query", "Ask for the print status.", status, "L3"),
    request('M', 2103, "stop the print", "Stop the print, heaters off.", {}, "Stop Print, L3"),
    request('M', 2105, "filament", "Load, unload, clean, stop.", extruder, "L12"),
    request('M', 2106, "filament detector", "Switch the filament detector.", detector, "L3"),
    request('M', 2107, "manual leveling", "One step of manual leveling.", manual, "M2107, L10"),
    request('M', 2111, "motor move", "Reserved.", motor_move),
    request('M', 2115, "disk selection", "Choose the disk to list.", disk, "L13"),
    request('M', 2120, "auto leveling", "One step of auto leveling.", auto_leveling, "L11; L1 for moves"),
    request('M', 2121, "screen firmware file", "The screen has taken the file, or not.", update_result),
    request('M', 2130, "power-loss recovery", "Resume or discard the saved print.", power_loss, "L3"),
    request('M', 2131, "WiFi", "Set the WiFi module, or ask for its state.", wifi, "L4"),
    request('M', 2132, "closed-loop steppers", "Set the stepper control boards.", steppers, "L19"),
    request('M', 2133, "exception page", "Ask for a page.", exception, "L18"),
    request('M', 2134, "screen version", "The screen's firmware version, after L21.", screen_version, "L9"),
    request('M', 2135, "mixing ratio", "Set the mixing ratio.", tool_mix, "L22"),
    request('M', 2136, "mixing template", "Select a mixing template.", mix_template, "L22"),
    request('M', 2137, "mixing range", "Set start and end of the custom template; each may come alone.",
            template_range, "L22"),
    request('M', 2138, "mixing mode", "Switch mixing.", mix_mode, "L22"),
    request('M', 2139, "add-ons", "Set sound, backlight, lock, or ask for them.", addons, "L23"),
    request('M', 2140, "settings query", "Ask for a page of settings, or restore them.", settings, "L24"),
    words("log", "screen log", "A message at the screen's power-up, never framed.", log_text),
    words("strXPT2046_TouchPara:", "touch calibration", "Debug output of the A30 screen.", touch_values),
    words("x:", "touch point", "Debug output of the A30 screen: x:n,y:n;", touch_point),
};

}  // namespace

std::span<const CodeInfo> smartto_requests() {
    return codes;
}

}  // namespace fauxboard::protocol::tables
