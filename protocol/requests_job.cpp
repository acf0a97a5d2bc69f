// Requests about the card, the print job, identity and settings that other firmwares know too.

#include "protocol/tables.h"

namespace fauxboard::protocol::tables {

namespace {

constexpr FieldInfo list_files[] = {
    word("LCD", "for the screen"),
    text("file:", "folder", "volume and path: SD1:/A30T"),
};
constexpr FieldInfo file_name[] = {
    text("", "file", "relative to the folder shown; the A30 screen leaves our L7's checksum on it (F)")};
constexpr FieldInfo file_position[] = {integer("S", "at", "bytes")};
constexpr FieldInfo message[] = {text("", "message")};
constexpr FieldInfo steps_per_mm[] = {
    number("X", "X", "steps/mm", 2),
    number("Y", "Y", "steps/mm", 2),
    number("Z", "Z", "steps/mm", 2),
    number("E", "E", "steps/mm", 2),
};
constexpr FieldInfo largest_accelerations[] = {
    number("X", "X", "mm/s²"),
    number("Y", "Y", "mm/s²"),
    number("Z", "Z", "mm/s²"),
    number("E", "E", "mm/s²"),
};
constexpr FieldInfo largest_velocities[] = {
    number("X", "X", "mm/s"),
    number("Y", "Y", "mm/s"),
    number("Z", "Z", "mm/s"),
    number("E", "E", "mm/s"),
};
constexpr FieldInfo accelerations[] = {
    number("P", "printing", "mm/s²"),
    number("R", "retract", "mm/s²"),
    number("T", "travel", "mm/s²"),
    number("S", "printing and travel", "mm/s²"),
};
constexpr FieldInfo jerk[] = {
    number("X", "X", "mm/s"), number("Y", "Y", "mm/s"),     number("Z", "Z", "mm/s"),
    number("E", "E", "mm/s"), number("S", "least", "mm/s"), number("T", "least travel", "mm/s"),
};

constexpr CodeInfo codes[] = {
    request('M', 20, "list files", "Ask for the file list; plain text when LCD and file: are missing.",
            list_files, "L7"),
    request('M', 21, "mount the card", "Take the SD card into use.", {}, "L2"),
    request('M', 22, "release the card", "Let the SD card go.", {}, "L2"),
    request('M', 23, "select file", "Select a file to print.", file_name, "L14, or L18 P26 S3 or S10"),
    request('M', 24, "start or resume", "Start the file selected, or go on with it.", {}, "Start Print:, L3"),
    request('M', 25, "pause", "Pause the print.", {}, "L3"),
    request('M', 26, "set file position", "Go on from this byte of the file.", file_position),
    request('M', 27, "SD progress query", "Ask how far the file is read.", {}, "SD printing byte"),
    request('M', 92, "steps per mm", "Set steps per mm.", steps_per_mm, "L24 P0"),
    request('M', 115, "identity query", "Ask for names and versions.", {}, "L9"),
    request('M', 117, "message", "Show a text on the screen.", message, "L14"),
    request('M', 201, "largest accelerations", "Set the axes' accelerations.", largest_accelerations),
    request('M', 203, "largest velocities", "Set the axes' velocities.", largest_velocities),
    request('M', 204, "accelerations", "Set the accelerations used.", accelerations),
    request('M', 205, "jerk", "Set jerk and least velocities.", jerk),
    request('M', 500, "save settings", "Write the settings to the EEPROM.", {}),
    request('M', 501, "load settings", "Read the settings from the EEPROM.", {}),
    request('M', 502, "factory settings", "Set all settings to their defaults.", {}),
};

}  // namespace

std::span<const CodeInfo> job_requests() {
    return codes;
}

}  // namespace fauxboard::protocol::tables
