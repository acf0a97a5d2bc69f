// L1..L9: position, temperatures, print status, files, identity.

#include "protocol/tables.h"

namespace fauxboard::protocol::tables {

namespace {

constexpr FieldInfo l1[] = {
    number("X", "X", "mm", 3, "end of the last move accepted by the planner, not the moving head (C)"),
    number("Y", "Y", "mm", 3),
    number("Z", "Z", "mm", 3, "without the babystep (C)"),
    number("E", "E", "mm", -1, "in the document, never seen from a board"),
    integer("F", "feedrate", "mm/s",
            "of the move being executed, truncated; keeps its last value when idle (C)"),
};

// The blank before each slash belongs to the format: "B:22.0 /0.0 /0" (C).
constexpr FieldInfo heater_target = bracketed(number("/", "target", "°C", 1));
constexpr FieldInfo heater_on = bracketed(flag("/", "heating", off_on));
constexpr ValueName media[] = {
    {0, "SD card present"},
    {1, "no SD card"},
    {2, "SD card failed"},
    {16, "SD card present, no U-disk"},
    {17, "no SD card, no U-disk"},
    {18, "SD card failed, no U-disk"},
    {32, "SD card present, U-disk failed"},
    {33, "no SD card, U-disk failed"},
    {34, "SD card failed, U-disk failed"},
};
constexpr FieldInfo l2[] = {
    number("B:", "bed", "°C", 1, "printed with the fraction mirrored on an A30T: P = 2 ceil(T) - T (C)"),
    heater_target,
    heater_on,
    number("T0:", "extruder 0", "°C", 1),
    heater_target,
    heater_on,
    number("T1:", "extruder 1", "°C", 1, "an A30T has no sensor there; an A30 leaves T1 and T2 out"),
    heater_target,
    heater_on,
    number("T2:", "extruder 2", "°C", 1),
    heater_target,
    heater_on,
    choice("SD:", "storage", media, "low nibble SD card, high nibble U-disk"),
    integer("F0:", "part fan", "%"),
    integer("F2:", "board fan", "%", "fixed at 50 on an A30T"),
    integer("R:", "print speed", "%", "10..800"),
    integer("FR:", "feedrate", "mm/s", "the same value as F of L1"),
};

constexpr ValueName print_states[] = {
    {0, "idle"}, {1, "printing"}, {2, "paused"}, {3, "recovery"}, {4, "finished"},
};
constexpr ValueName volumes[] = {{0, "from the SD card"}, {1, "from the U-disk"}};
constexpr ValueName motors[] = {{0, "motors off"}, {1, "motors on"}};
constexpr ValueName filament[] = {
    {0, "no filament"},
    {1, "filament present"},
    {255, "filament detector off"},
};
constexpr ValueName leveling[] = {{0, "auto leveling off"}, {1, "auto leveling on"}};
constexpr ValueName probes[] = {
    {0, "capacitive probe"},
    {1, "3D Touch"},
    {254, "capacitive probe only"},
};
constexpr ValueName wifi[] = {{0, "no WiFi"}, {1, "WiFi fitted"}};
constexpr FieldInfo l3[] = {
    choice("PS:", "print status", print_states),
    choice("VL:", "volume", volumes),
    choice("MT:", "motors", motors, "a change sends L3 in the next slot (C)"),
    choice("FT:", "filament", filament),
    choice("AL:", "auto leveling", leveling),
    choice("ST:", "probe", probes),
    choice("WF:", "WiFi", wifi),
    mixing("MR:", "mixing ratio"),
    text("FN:", "file name", "the A30 screen wants ` PG:` after it and drops 50 characters and more"),
    integer("PG:", "progress", "%", "0..100"),
    integer("TM:", "time", "s", "since the start of the print"),
    integer("LA:", "layer"),
    integer("LC:", "layer count"),
};

constexpr ValueName server_states[] = {{0, "server off"}, {1, "server on"}, {2, "server connected"}};
constexpr ValueName router_states[] = {{0, "router off"}, {1, "router on"}, {2, "router connected"}};
constexpr FieldInfo l4[] = {
    flag("WT:", "WiFi", off_on),
    flag("CF:", "auto connect", off_on),
    flag("AP:", "access point set-up", off_on),
    choice("SS:", "server", server_states),
    integer("RS:", "signal", {}, "0 none, 1..5"),
    choice("RE:", "router", router_states),
    text("RI:", "router address", {}, ':'),
    text("RA:", "network name", {}, ':'),
    text("SA:", "server address", {}, ':'),
};

constexpr FieldInfo l5[] = {integer("S", "speed", "%")};

constexpr ValueName fans[] = {{0, "part fan"}, {1, "board fan"}};
constexpr FieldInfo l6[] = {choice("P", "fan", fans), integer("S", "speed", "%")};

constexpr ValueName list_begins[] = {{0, "begins, SD card"}, {1, "begins, U-disk"}};
constexpr ValueName list_ends[] = {{0, "ends, SD card"}, {1, "ends, U-disk"}};
constexpr FieldInfo l7[] = {
    choice("begin file list:", "begin of the list", list_begins),
    choice("end file list:", "end of the list", list_ends),
    integer("P", "entry", {}, "from 0; a folder is not marked"),
    text("", "name", "the first entry of a folder is Main/FOLDER, the way back"),
};

constexpr FieldInfo l8[] = {text(":", "firmware file", "must hold `bin` (F)", ';')};

constexpr FieldInfo l9[] = {
    text("DN:", "device", {}, ';'),
    text("DM:", "model", {}, ';'),
    text("SN:", "serial number", "16 bytes of erased flash (0xFF) on the recorded board", ';'),
    text("FV:", "firmware", {}, ';'),
    text("PV:", "print volume", {}, ';'),
    text("HV:", "hardware", {}, ';'),
};

constexpr CodeInfo codes[] = {
    reply(1, "position", "Position and feedrate.", l1),
    reply(2, "temperatures", "Temperatures, storage, fans and speed, sent when one of them changed.", l2),
    reply(3, "print status", "State of the print job and of the machine.", l3),
    reply(4, "WiFi", "State of the WiFi module.", l4),
    reply(5, "print speed", "The print speed set; the A30 screen misreads it, the A30T board never sends it.",
          l5),
    reply(6, "fan", "A fan's speed; the A30 screen misreads it, the A30T board never sends it.", l6),
    reply(7, "file list", "One line of a file list: begin, entries, end.", l7),
    reply(8, "screen firmware file", "A firmware file for the screen follows.", l8, "M2121"),
    reply(9, "identity", "Names and versions of the board, for the about page.", l9),
};

}  // namespace

std::span<const CodeInfo> status_replies() {
    return codes;
}

}  // namespace fauxboard::protocol::tables
