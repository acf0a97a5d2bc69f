// What can be done to the MKS DLP board.

#include <array>

#include "emulator/behaviour/action_rows.h"
#include "emulator/dlp/printer.h"
#include "emulator/dlp/profile/tables.h"

namespace fauxboard::dlp {
namespace {

using behaviour::ActionContext;
using behaviour::ActionInfo;
using behaviour::ArgInfo;
using behaviour::Args;
using behaviour::flag;
using behaviour::own;
using behaviour::refuse;
using behaviour::text_or_none;
using behaviour::whole;
using enum behaviour::ArgType;

/// Runs `act(board, arguments, now)`; what comes back false was not possible, and `why` says so.
template <class F>
void with_board(Printer& p, ActionContext& c, Args a, std::string_view why, F act) {
    const bool done = act(p.board, a, p.now());
    p.board.settle(p.now());
    if (!done) {
        refuse(c, why);
    }
}

#define FAUXBOARD_DLP_ACTION(why, expression)                                                                \
    own<[](Printer& p, ActionContext& c, Args a) {                                                           \
        with_board(p, c, a, why,                                                                             \
                   [](MksBoard& b, Args args, SimTime now) { return (void)args, (void)now, (expression); }); \
    }>

bool start(MksBoard& b, Args a, SimTime now) {
    if (text_or_none(a[0]).empty()) {
        return b.print_viewed(now);
    }
    std::string path;
    return machine::clean_path("", text_or_none(a[0]), path) && b.print_file(path, now);
}

bool set_clock(MksBoard& b, Args a, SimTime now) {
    const auto part = [&](std::size_t i, int min, int max) { return whole(a[i], min, max); };
    const auto year = part(0, 2000, 2099);
    const auto month = part(1, 1, 12);
    const auto day = part(2, 1, 31);
    const auto hour = part(3, 0, 23);
    const auto minute = part(4, 0, 59);
    if (!year || !month || !day || !hour || !minute || *day > month_length(*year, *month)) {
        return false;
    }
    b.set_clock({*year, *month, *day, *hour, *minute, 0}, now);
    return true;
}

bool calibrate_touch(MksBoard& b, Args a, SimTime now) {
    return b.calibrate_touch(
        {{{a[0].number, a[1].number}, {a[2].number, a[3].number}, {a[4].number, a[5].number}}}, now);
}

bool light(MksBoard& b, Args a, SimTime now) {
    if (b.print.active()) {
        return false;
    }
    b.uv_test.set_light(flag(a[0]), now);
    return true;
}

bool display(MksBoard& b, Args a, SimTime now) {
    if (b.print.active()) {
        return false;
    }
    b.uv_test.set_display(flag(a[0]), now);
    return true;
}

void stick_in(Printer& p, ActionContext&, Args) {
    p.insert_card(0);
    p.insert_card(1);
}
void stick_out(Printer& p, ActionContext&, Args) {
    p.remove_card(0);
    p.remove_card(1);
}

constexpr std::array path_arg{ArgInfo{"path", text, false, "on the stick; without it the file viewed"}};
constexpr std::array name_arg{ArgInfo{"name", text, true, "in the folder shown"}};
constexpr std::array mm_arg{ArgInfo{"mm", number, true, "up is positive", "mm"}};
constexpr std::array n_arg{ArgInfo{"n", number, true, "which"}};
constexpr std::array on_arg{ArgInfo{"on", boolean, true, "on or off"}};
constexpr std::array clock_args{
    ArgInfo{"year", number, true, "2000 to 2099"}, ArgInfo{"month", number, true, "1 to 12"},
    ArgInfo{"day", number, true, "1 to the last of the month"}, ArgInfo{"hour", number, true, "0 to 23"},
    ArgInfo{"minute", number, true, "0 to 59"}};

constexpr std::array tap_args{ArgInfo{"x1", number, true, "what was read at the first target"},
                              ArgInfo{"y1", number, true, "same"},
                              ArgInfo{"x2", number, true, "at the second"},
                              ArgInfo{"y2", number, true, "same"},
                              ArgInfo{"x3", number, true, "at the third"},
                              ArgInfo{"y3", number, true, "same"}};

constexpr std::string_view busy = "not now: the platform moves, or a print is under way";
constexpr std::string_view no_print = "no print is under way, or it is so already";

constexpr ActionInfo table[] = {
    {"print.start", "", "homes and prints", path_arg,
     FAUXBOARD_DLP_ACTION("nothing is printed: no such file, or the board is busy", start(b, args, now))},
    {"print.pause",
     "",
     "the print pauses as soon as it may",
     {},
     FAUXBOARD_DLP_ACTION(no_print, b.print.set_paused(true, now))},
    {"print.resume",
     "",
     "the print goes on",
     {},
     FAUXBOARD_DLP_ACTION(no_print, b.print.set_paused(false, now))},
    {"print.toggle_pause",
     "",
     "the pause button",
     {},
     FAUXBOARD_DLP_ACTION(no_print, b.print.set_paused(!b.print.paused(), now))},
    {"print.stop",
     "",
     "the print is over: dark at once, then up",
     {},
     FAUXBOARD_DLP_ACTION(no_print, b.print.stop(now))},
    {"platform.home", "", "homes the platform", {}, FAUXBOARD_DLP_ACTION(busy, b.print.home(now))},
    {"platform.jog", "", "moves the platform; steps add up while it moves", mm_arg,
     FAUXBOARD_DLP_ACTION(busy, b.print.jog(args[0].number, now))},
    {"platform.stop",
     "",
     "ends a move by hand, or homing",
     {},
     FAUXBOARD_DLP_ACTION("nothing moves by hand", b.print.stop_moving(now))},
    {"platform.set_zero",
     "",
     "Z=0 is here from now on, and is kept",
     {},
     FAUXBOARD_DLP_ACTION("not now: the platform is not homed, or moves", b.set_zero(now))},
    {"platform.raise",
     "",
     "to 100 mm, after Z=0 was set (0.08)",
     {},
     FAUXBOARD_DLP_ACTION(busy, b.print.raise_after_zero(now))},
    {"files.enter", "", "shows a folder", name_arg,
     FAUXBOARD_DLP_ACTION("there is no such folder", b.files.enter(text_or_none(args[0])))},
    {"files.up", "", "shows the folder above", {}, FAUXBOARD_DLP_ACTION("this is the root", b.files.up())},
    {"files.home", "", "shows the root", {}, FAUXBOARD_DLP_ACTION("", (b.files.home(), true))},
    {"files.delete",
     "",
     "deletes the file viewed",
     {},
     FAUXBOARD_DLP_ACTION("the file cannot be deleted", b.delete_viewed())},
    {"view.open", "", "chooses a file to print, of the folder shown", name_arg,
     FAUXBOARD_DLP_ACTION("there is no such file to print", b.view(text_or_none(args[0])))},
    {"setup.load", "", "loads a settings file of the folder shown", name_arg,
     FAUXBOARD_DLP_ACTION("not now: a print is under way, or settings are",
                          b.load_setup(text_or_none(args[0]), now))},
    {"setup.save",
     "",
     "keeps the general settings",
     {},
     FAUXBOARD_DLP_ACTION("settings are being kept already", b.save_setup(now))},
    {"setup.language", "", "0 English, 1 Russian; keeps the general settings", n_arg,
     FAUXBOARD_DLP_ACTION("there are languages 0 and 1",
                          b.set_language(whole(args[0], 0, 1).value_or(-1), now))},
    {"uvtest.image", "", "sends test image 1, 2 or 3 to the panel", n_arg,
     FAUXBOARD_DLP_ACTION("it is chosen already, or not now",
                          b.choose_image(static_cast<unsigned>(whole(args[0], 0, 9).value_or(0)), now))},
    {"uvtest.light", "", "the lamp by hand, for two minutes", on_arg,
     FAUXBOARD_DLP_ACTION("not while printing", light(b, args, now))},
    {"uvtest.display", "", "the panel by hand", on_arg,
     FAUXBOARD_DLP_ACTION("not while printing", display(b, args, now))},
    {"uvtest.leave",
     "",
     "lamp and panel by hand are off",
     {},
     FAUXBOARD_DLP_ACTION("not while printing", !b.print.active() && (b.uv_test.leave(now), true))},
    {"clock.set", "", "sets the clock, seconds 0", clock_args,
     FAUXBOARD_DLP_ACTION("there is no such date or time", set_clock(b, args, now))},
    {"touch.calibrate", "",
     "takes what the touch sensor read at the three targets, in pixels, and keeps it (0.08)", tap_args,
     FAUXBOARD_DLP_ACTION("the taps lie in one line, or settings are being kept",
                          calibrate_touch(b, args, now))},
    {"touch.reset",
     "",
     "the touch sensor is taken as it is, and that is kept (0.08)",
     {},
     FAUXBOARD_DLP_ACTION("", (b.reset_touch(now), true))},
    {"buzzer.touch", "", "sounds as for a touch", {}, FAUXBOARD_DLP_ACTION("", (b.touch_sound(now), true))},
    {"board.doze",
     "",
     "the screensaver begins: no stick, no panel, unless a print is under way",
     {},
     FAUXBOARD_DLP_ACTION("", (b.doze(now), true))},
    {"board.wake", "", "it is over", {}, FAUXBOARD_DLP_ACTION("", (b.wake(now), true))},
    {"counters.reset",
     "",
     "all working times are 0, and kept",
     {},
     FAUXBOARD_DLP_ACTION("", (b.reset_counters(now), true))},
    {"stick.in", "stick in", "puts the stick in, into whatever slot it has", {}, own<stick_in>},
    {"stick.out", "stick out", "pulls the stick out", {}, own<stick_out>},
};

}  // namespace

std::span<const ActionInfo> actions() {
    return table;
}

}  // namespace fauxboard::dlp
