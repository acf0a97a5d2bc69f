// ChiTu resin boards: what they are asked beyond the usual codes, and what they say. Sources: a list of codes
// tried on an Elegoo Mars Pro (V4.3.3_LCDC), and the programs that talk to such boards.

#include "protocol/tables.h"

namespace fauxboard::protocol::tables {

namespace {

constexpr FieldInfo m28[] = {text("", "file")};
constexpr FieldInfo m30[] = {text("", "file")};
constexpr FieldInfo m33[] = {number("I", "unknown")};
constexpr FieldInfo m110[] = {number("N", "number")};
constexpr FieldInfo m300[] = {number("S", "pitch", "Hz"), number("P", "time", "ms")};
constexpr FieldInfo m3000[] = {number("I", "from byte")};
constexpr FieldInfo m3001[] = {number("I", "from byte")};
constexpr FieldInfo m4012[] = {number("I", "what"), number("T", "size", "bytes")};
constexpr FieldInfo m5000[] = {text("", "word")};
constexpr FieldInfo m6030[] = {text("", "file")};
constexpr FieldInfo m6032[] = {text("", "file")};
constexpr FieldInfo m6040[] = {number("I", "after", "ms")};
constexpr FieldInfo m8004[] = {number("I", "Z")};
constexpr FieldInfo m8005[] = {number("Z", "Z")};
constexpr FieldInfo m8006[] = {number("I", "speed", "mm/s")};
constexpr FieldInfo m8007[] = {number("I", "speed", "mm/s")};
constexpr FieldInfo m8008[] = {number("I", "acceleration", "mm/s²")};
constexpr FieldInfo m8010[] = {number("S", "length", "mm")};
constexpr FieldInfo m8013[] = {number("I", "speed", "mm/s")};
constexpr FieldInfo m8015[] = {number("I", "homing", "mm/s"), number("P", "slow lift", "mm/s"),
                               number("T", "slow lift", "mm/s")};
constexpr FieldInfo m8016[] = {number("I", "homing", "mm/s"), number("P", "fast lift", "mm/s"),
                               number("T", "fast lift", "mm/s"), number("D", "wait", "ms")};
constexpr FieldInfo m8020[] = {number("S", "length", "mm")};
constexpr FieldInfo m8021[] = {number("S", "diameter", "mm")};
constexpr FieldInfo m8026[] = {number("I", "height", "mm")};
constexpr FieldInfo m8028[] = {number("S", "length", "mm")};
constexpr FieldInfo m8029[] = {number("I", "type"), number("T", "wiring"), number("S", "side"),
                               number("C", "after homing")};
constexpr FieldInfo m8030[] = {number("I", "fan of the LED"), number("T", "fan of the board"),
                               number("S", "LED"), number("C", "after homing")};
constexpr FieldInfo m8034[] = {number("I", "support")};
constexpr FieldInfo m8070[] = {number("Z", "lift", "mm"), number("S", "slowly", "mm"),
                               number("T", "warm-up", "s"), number("I", "speed of the line", "baud")};
constexpr FieldInfo m8071[] = {number("X", "X", "pixels"), number("Y", "Y", "pixels")};
constexpr FieldInfo m8083[] = {number("I", "off the end stop")};
constexpr FieldInfo m8084[] = {number("Z", "Z", "mm")};
constexpr FieldInfo m8085[] = {number("I", "logo", "ms"), number("T", "saver after", "s")};
constexpr FieldInfo m8087[] = {number("I", "settling", "ns"), number("T", "holding", "ns")};
constexpr FieldInfo m8489[] = {number("P", "action")};
constexpr FieldInfo m8093[] = {number("I", "what")};
constexpr FieldInfo m8512[] = {text("", "file")};
constexpr FieldInfo m9003[] = {text("", "name and password")};
constexpr FieldInfo m9005[] = {text("", "name and password")};
constexpr FieldInfo file_text[] = {text("", "name")};
constexpr FieldInfo answer[] = {text("", "text")};

constexpr CodeInfo asked(std::string_view word, std::string_view title, std::string_view meaning,
                         std::span<const FieldInfo> fields, std::string_view reply) {
    return {0, 0, word, Direction::to_board, title, meaning, fields, reply};
}
constexpr CodeInfo told(std::string_view word, std::string_view title, std::string_view meaning,
                        std::span<const FieldInfo> fields) {
    return {0, 0, word, Direction::to_screen, title, meaning, fields, {}};
}

constexpr CodeInfo requests[] = {
    request('M', 28, "upload", "ChiTu: a file is written from here on.", m28, "ok N:"),
    request('M', 29, "upload's end", "ChiTu: the file written is closed.", {}, "Done saving file!"),
    request('M', 30, "delete file", "ChiTu: removes a file of the stick.", m30,
            "File deleted :, Delete failed :"),
    request('M', 33, "stop", "ChiTu: stops the print.", m33, "ok N:"),
    request('M', 110, "line number", "The number that the next line counts from.", m110, "ok N:"),
    request('M', 300, "beep", "ChiTu: a tone.", m300, "ok N:"),
    request('M', 3000, "block query", "ChiTu: the next block of a download.", m3000, "a block"),
    request('M', 3001, "block query", "ChiTu: a block of a download again.", m3001, "a block"),
    request('M', 4000, "status query", "ChiTu: heaters, height, fans, place in the file.", {}, "ok B:"),
    request('M', 4001, "parameter query", "ChiTu: steps, volume, charset.", {}, "ok X:"),
    request('M', 4002, "version query", "ChiTu: the firmware's version.", {}, "ok V"),
    request('M', 4003, "power off", "ChiTu: switches the printer off.", {}, "ok N:"),
    request('M', 4004, "block query", "ChiTu: which command blocks.", {}, "ok C:"),
    request('M', 4006, "file query", "ChiTu: the name of the file printed.", {}, "ok '"),
    request('M', 4012, "upload query", "ChiTu: how much of an upload came.", m4012, "ok"),
    request('M', 5000, "authorisation", "ChiTu: a word of 16 bytes.", m5000, "Error:auth"),
    request('M', 5002, "identity query", "ChiTu: three words of the processor.", {}, "0x"),
    request('M', 6030, "print file", "ChiTu: opens a file and prints it.", m6030, "ok N:"),
    request('M', 6032, "open file", "ChiTu: opens a file for download.", m6032, "ok L:"),
    request('M', 6040, "restart", "ChiTu: restarts the board.", m6040, ""),
    request('M', 8004, "motor direction", "ChiTu: a setting.", m8004, "ok N:"),
    request('M', 8005, "what Z moves", "ChiTu: a setting.", m8005, "ok N:"),
    request('M', 8006, "starting speed", "ChiTu: a setting.", m8006, "ok N:"),
    request('M', 8007, "jerk", "ChiTu: a setting.", m8007, "ok N:"),
    request('M', 8008, "acceleration", "ChiTu: a setting.", m8008, "ok N:"),
    request('M', 8010, "step of Z", "ChiTu: a setting.", m8010, "ok N:"),
    request('M', 8013, "highest speed of Z", "ChiTu: a setting.", m8013, "ok N:"),
    request('M', 8015, "first speeds", "ChiTu: a setting.", m8015, "ok N:"),
    request('M', 8016, "second speeds", "ChiTu: a setting.", m8016, "ok N:"),
    request('M', 8020, "withdrawal", "ChiTu: a setting.", m8020, "ok N:"),
    request('M', 8021, "consumable", "ChiTu: a setting.", m8021, "ok N:"),
    request('M', 8026, "travel of Z", "ChiTu: a setting.", m8026, "ok N:"),
    request('M', 8028, "wire back", "ChiTu: a setting.", m8028, "ok N:"),
    request('M', 8029, "end stops", "ChiTu: a setting.", m8029, "ok N:"),
    request('M', 8030, "fans and LED", "ChiTu: a setting.", m8030, "ok N:"),
    request('M', 8034, "folders", "ChiTu: a setting.", m8034, "ok N:"),
    request('M', 8070, "lifts and projector", "ChiTu: a setting.", m8070, "ok N:"),
    request('M', 8071, "resolution", "ChiTu: a setting.", m8071, "ok N:"),
    request('M', 8083, "zero", "ChiTu: a setting.", m8083, "ok N:"),
    request('M', 8084, "zero offset", "ChiTu: a setting.", m8084, "ok N:"),
    request('M', 8085, "screen", "ChiTu: a setting.", m8085, "ok N:"),
    request('M', 8087, "external driver", "ChiTu: a setting.", m8087, "ok N:"),
    request('M', 8489, "after a print", "ChiTu: a setting.", m8489, "ok N:"),
    request('M', 8093, "diagnostics", "ChiTu: writes a file of status and settings.", m8093,
            "Done saving file!"),
    request('M', 8500, "save settings", "ChiTu: keeps the settings.", {}, "ok N:"),
    request('M', 8510, "use settings", "ChiTu: puts the settings into use, unsaved.", {}, "ok N:"),
    request('M', 8511, "saved settings", "ChiTu: takes the saved settings back.", {}, "ok N:"),
    request('M', 8512, "backup", "ChiTu: writes the settings into a file.", m8512, "Done saving file!"),
    request('M', 8513, "factory settings", "ChiTu: forgets all settings.", {}, "ok N:"),
    request('M', 9003, "join a network", "ChiTu: WiFi as a client.", m9003, "ok N:"),
    request('M', 9005, "open a network", "ChiTu: WiFi as an access point.", m9005, "ok N:"),
    asked("U100", "network name", "ChiTu: what the printer is called in the network.", file_text, "ok N:"),
    asked("M99999", "discovery", "ChiTu: who is there?", {}, "ok MAC:"),
};

/// "ok B:0/0 X:0.000 Y:0.000 Z:5.000 F:0/256 D:3860/241025/0 ", behind the "ok B:" that it begins with.
constexpr FieldInfo status[] = {
    number("", "bed", "°C"),
    bracketed(number("/", "target", "°C")),
    number("E1:", "nozzle 1", "°C"),
    bracketed(number("/", "target", "°C")),
    number("E2:", "nozzle 2", "°C"),
    bracketed(number("/", "target", "°C")),
    number("X:", "X", "mm"),
    number("Y:", "Y", "mm"),
    number("Z:", "Z", "mm", 3),
    integer("F:", "LED fan", "of 256"),
    integer("/", "board fan", "of 256"),
    integer("D:", "at", "bytes"),
    integer("/", "of", "bytes", "0: no print"),
    integer("/", "halted", {}, "1 while paused, and without a print"),
    integer("T:", "print time", "s"),
};
constexpr FieldInfo place[] = {
    number("X:", "X", "mm"),
    number("Y:", "Y", "mm"),
    number("Z:", "Z", "mm"),
    number("E:", "E", "mm"),
};

constexpr CodeInfo replies[] = {
    told("ok", "acknowledged", "The request was taken; what it asked for stands behind.", answer),
    told("ok B:", "status", "Answer to M4000.", status),
    told("ok C:", "position", "Answer to M114.", place),
    told("SD N:", "SD progress", "ChiTu 4.4.3: the first piece of the answer to M27.", answer),
    told("byte", "SD progress", "ChiTu 4.4.3: the place in the file, and its size.", answer),
    told("Error:", "refused", "The request cannot be done.", answer),
    told("Error!", "refused", "The request cannot be done.", answer),
    told("Begin file list", "file list begins", "Files and sizes follow.", {}),
    told("End file list", "file list ends", "No more files.", {}),
    told("File opened:", "file opened", "Answer to M23: name and size.", answer),
    told("File selected", "file selected", "Answer to M23.", answer),
    told("open failed, File :", "file not opened", "Answer to M23.", answer),
    told("//############Error!cann't open file", "file not opened", "Answer to M23.", answer),
    told("//#####Error!cann't open file", "no start-up file", "Of the console at power-on.", {}),
    told("chitu_initial_file_autorun!", "no start-up file", "Of the console at power-on.", {}),
    told("//Disk init fail!", "no stick", "There is no stick, or it cannot be read.", {}),
    told("//", "file", "Name of the file written.", answer),
    told("Done saving file!", "file written", "A file of the stick is whole.", {}),
    told("File deleted :", "file deleted", "A file of the stick is gone.", answer),
    told("Delete failed :", "no file to delete", "There was no such file.", answer),
    told("resend", "again, please", "A piece of an upload is wrong or not the next: its place.", answer),
    told("UART1 init OK", "power-on", "Of the console.", {}),
    told("start", "power-on", "Of the console.", {}),
    told("start_task", "power-on", "Of the console.", {}),
    told("USB disk_OK", "stick is there", "Of the console at power-on.", {}),
    told("USB disk_ok", "stick put in", "Of the console.", {}),
};

}  // namespace

std::span<const CodeInfo> chitu_requests() {
    return requests;
}
std::span<const CodeInfo> chitu_replies() {
    return replies;
}

}  // namespace fauxboard::protocol::tables
