#include "emulator/resin/resin_files.h"

#include <array>
#include <cstdio>
#include <string_view>

#include "emulator/resin/printer.h"

namespace fauxboard::resin {
namespace {

using enum ResinSetting;

template <class... A>
std::string format(const char* form, A... values) {
    std::array<char, 256> text{};
    const int size = std::snprintf(text.data(), text.size(), form, values...);
    return {text.data(), static_cast<std::size_t>(size < 0 ? 0 : size)};
}

std::string value_text(const ResinSettingInfo& info, const ResinSettings& settings) {
    return info.whole ? format("%c%d", info.letter, static_cast<int>(settings[info.id]))
                      : format("%c%.6f", info.letter, settings[info.id]);
}

std::string version_line(const Printer& printer) {
    const machine::Identity& own = printer.config().identity;
    const ResinSettings& settings = printer.edited;
    return "; Version: " + own.firmware +
           format(" / %dx%d /", static_cast<int>(settings[resolution_x]),
                  static_cast<int>(settings[resolution_y])) +
           own.hardware;
}

/// The request that sets this one and those that share its line.
std::string request_text(std::size_t index, const ResinSettings& settings) {
    const auto table = resin_settings();
    std::string out = format("M%d ", int{table[index].code}) + value_text(table[index], settings);
    for (std::size_t next = index + 1; next < table.size() && table[next].joins; ++next) {
        out += " " + value_text(table[next], settings);
    }
    return out;
}

std::string_view comment_of(const ResinSettingInfo& info) {
    return info.comment.empty() ? info.help : info.comment;
}

/// What the diagnostics list, and how they call it where the backup calls it otherwise.
struct Diagnosed {
    ResinSetting id;
    std::string_view comment{};
};
constexpr std::array diagnosed{
    Diagnosed{motor_direction},
    Diagnosed{move_inverted},
    Diagnosed{start_speed},
    Diagnosed{turn_speed},
    Diagnosed{acceleration},
    Diagnosed{step},
    Diagnosed{max_speed},
    Diagnosed{home_speed},
    Diagnosed{home_again_speed},
    Diagnosed{lift_slow_speed},
    Diagnosed{lift_fast_speed},
    Diagnosed{max_height},
    Diagnosed{after_z_homing,
              "Action after XYZ return 0: Return to zero point (0,0,0) 1: Stop at the limit position"},
    Diagnosed{folders},
    Diagnosed{offset_used},
    Diagnosed{
        offset,
        "Z offset, 0: Disable offset, the stroke is determined by setting Z to zero, non-zero, the stroke is "
        "triggered by the leveling trigger position + offset value"},
    Diagnosed{logo},
    Diagnosed{screensaver},
    Diagnosed{direction_settle}};

struct StatusWord {
    const char* name;
    const char* comment;
};
constexpr std::array<StatusWord, 8> status_words{{{"e_temp", "Temporary code"},
                                                  {"e_other", "Other"},
                                                  {"e_mem", "SD card USB disk EEPROM FLASH"},
                                                  {"e_communication", "communication"},
                                                  {"e_indicator", "interrupt"},
                                                  {"e_driver", "driver"},
                                                  {"e_printer", "print"},
                                                  {"e_LCD", "LCD"}}};
constexpr std::size_t memory_word = 2;
/// Set while the stick cannot be read: the bit that is set in the recorded words after trouble with it.
constexpr std::uint32_t stick_bit = 0x400;

/// "0x350041 0x4d485001" -> "00350041-4d485001", as the file writes the words of M5002.
std::string id_text(std::string_view words) {
    std::string out;
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(' '), words.size());
        std::string_view word = words.substr(0, end);
        words.remove_prefix(std::min(end + 1, words.size()));
        word.remove_prefix(word.starts_with("0x") ? 2 : 0);
        out += std::string(8 - std::min<std::size_t>(word.size(), 8), '0') + std::string(word) + "-";
    }
    return out + "ff";
}

}  // namespace

std::string backup_text(const Printer& printer) {
    const auto table = resin_settings();
    const ResinSettings& settings = printer.edited;
    std::string out =
        version_line(printer) +
        " ';' is followed by a comment\n"
        "M8513; Clear previous configuration parameters, restore parameters to factory settings, "
        "reconfigure parameters\n";
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (table[i].in_backup && !table[i].joins) {
            out += request_text(i, settings) + "; " + std::string(comment_of(table[i])) + "\n";
        }
    }
    return out + "M9003 \"" + printer.wifi.ssid + "\"\nM8500; save configuration\n";
}

std::string diagnostics_text(const Printer& printer) {
    constexpr const char* padded = "%-19s; ";
    const ResinConfig& config = printer.config().resin;
    std::string out = version_line(printer) + "\n\"" + printer.wifi.ssid +
                      "\"\n; ID: " + id_text(printer.config().identity.serial_number) +
                      "\n;; update: update.SH4\n;; update: update.SH4\n";
    for (std::size_t i = 0; i < status_words.size(); ++i) {
        const bool broken = i == memory_word && printer.storage.state(0) == machine::DiskState::failed;
        out += format("; status.%-16s%x; %s\n", status_words[i].name,
                      config.status[i] | (broken ? stick_bit : 0), status_words[i].comment);
    }
    out += format("; current time                %lld; time\n",
                  static_cast<long long>(printer.now() / std::chrono::milliseconds(1)));
    for (const Diagnosed& line : diagnosed) {
        const auto index = static_cast<std::size_t>(line.id);
        const ResinSettingInfo& info = resin_settings()[index];
        out += format(padded, request_text(index, printer.edited).c_str()) +
               std::string(line.comment.empty() ? comment_of(info) : line.comment) + "\n";
    }
    return out + format(padded, "M8500") + "save configuration\n";
}

}  // namespace fauxboard::resin
