#pragma once

#include <array>
#include <string_view>

namespace fauxboard::dlp {

/// Slips of the real programs of the board. Each is off unless a profile says otherwise.
struct Quirks {
    bool end_goes_down = false;
    bool light_zero_stays_on = false;
    bool speed_times_60 = false;
    bool ignore_read_errors = false;
    bool stop_homing_keeps_print = false;
    bool short_homing_search = false;
    bool slow_homing_to_one = false;
    bool reset_without_command = false;
    bool last_line_unchecked = false;
    bool display_not_counted = false;
    bool pause_on_bad_lines = false;
};

/// A quirk as profiles name it.
struct QuirkInfo {
    std::string_view name;
    bool Quirks::*member;
    std::string_view help;
};

inline constexpr std::array<QuirkInfo, 11> quirk_table{{
    {"end_goes_down", &Quirks::end_goes_down,
     "0.01: the lift after the last layer goes to Z=0 plus the lift, which may be down into the model"},
    {"light_zero_stays_on", &Quirks::light_zero_stays_on,
     "both: an exposure of 0 s leaves the lamp on until the next exposure ends"},
    {"speed_times_60", &Quirks::speed_times_60,
     "both: lift and drop of a .photon or .cbddlp go 60 times as fast (mm/min taken for mm/s)"},
    {"ignore_read_errors", &Quirks::ignore_read_errors,
     "both: a picture that cannot be read leaves the panel dark, and the print goes on"},
    {"stop_homing_keeps_print", &Quirks::stop_homing_keeps_print,
     "0.01: stopped while it homes for a print, the next homing by hand starts that print"},
    {"short_homing_search", &Quirks::short_homing_search,
     "0.01: homing looks for its switch no further than max_pos, so that it fails from the very top"},
    {"slow_homing_to_one", &Quirks::slow_homing_to_one,
     "both: the slow run of homing goes to -1 or 1, wherever home_pos is"},
    {"reset_without_command", &Quirks::reset_without_command,
     "before 0.01: the FPGA is reset while it shows a picture, and comes up white now and then"},
    {"last_line_unchecked", &Quirks::last_line_unchecked,
     "both: whether the last line of a picture arrived is seen only when the next one is sent, if at all"},
    {"display_not_counted", &Quirks::display_not_counted,
     "0.01: the working time of the panel is never counted"},
    {"pause_on_bad_lines", &Quirks::pause_on_bad_lines,
     "none: a layer with lines that the panel never took pauses the print"},
}};

}  // namespace fauxboard::dlp
