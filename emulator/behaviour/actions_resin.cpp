// What can be done to a resin printer only. On any other machine each of these is refused.

#include <algorithm>
#include <array>
#include <cmath>

#include "emulator/behaviour/action_rows.h"
#include "emulator/resin/resin_files.h"

namespace fauxboard::behaviour::rows {
namespace {

using enum ArgType;
using machine::Resin;

/// The resin part, or nothing, and it is said why.
Resin* part(ActionContext& c) {
    if (!c.printer.resin) {
        refuse(c, "this is no resin printer; its profile has no machine.resin");
    }
    return c.printer.resin.get();
}

/// Nothing moves by hand while a print does.
Resin* at_rest(ActionContext& c) {
    Resin* const resin = part(c);
    if (resin != nullptr && c.printer.job.status() == machine::JobStatus::printing) {
        refuse(c, "not while printing; pause the print first");
        return nullptr;
    }
    return resin;
}

void check_queue(ActionContext& c, bool taken) {
    if (!taken) {
        refuse(c, "move lost: the motion queue is full");
    }
}

void move(ActionContext& c, Args a) {
    if (Resin* const resin = at_rest(c)) {
        const bool relative = resin->axis.relative || flag(a[2]);
        check_queue(c, resin->axis.move(a[0].number, relative, number_or(a[1], 0), c.printer.now()));
    }
}

void home(ActionContext& c, Args) {
    if (Resin* const resin = at_rest(c)) {
        check_queue(c, resin->axis.home(c.printer.now()));
    }
}

void stir(ActionContext& c, Args) {
    if (Resin* const resin = at_rest(c)) {
        check_queue(c, resin->axis.stir(c.printer.config().resin->stir_cycles, c.printer.now()));
    }
}

void motor_off(ActionContext& c, Args) {
    if (Resin* const resin = at_rest(c)) {
        resin->axis.motors_off(c.printer.now());
    }
}

void fan(ActionContext& c, Args a) {
    if (Resin* const resin = part(c)) {
        resin->fan = static_cast<int>(std::lround(std::clamp(a[0].number, 0.0, 256.0)));
    }
}

void choose(ActionContext& c, Args a) {
    if (Resin* const resin = part(c)) {
        resin->choose(a[0].is_text() ? a[0].text : std::string_view{});
    }
}

void start(ActionContext& c, Args) {
    if (Resin* const resin = part(c)) {
        resin->start();
    }
}

void print(ActionContext& c, Args a) {
    Resin* const resin = part(c);
    if (resin == nullptr) {
        return;
    }
    choose(c, a);
    if (resin->outcome == Resin::Outcome::opened) {
        resin->start();
    }
}

void remove(ActionContext& c, Args a) {
    if (Resin* const resin = part(c)) {
        resin->remove(a[0].is_text() ? a[0].text : std::string_view{});
    }
}

template <std::string (*Text)(const machine::Printer&)>
void write(ActionContext& c, Args a) {
    if (Resin* const resin = part(c)) {
        resin->write(a[0].is_text() ? a[0].text : std::string_view{}, Text(c.printer));
    }
}

/// Each letter of the request that this code has a setting for.
void config_set(ActionContext& c, Args) {
    Resin* const resin = part(c);
    if (resin == nullptr || c.command == nullptr) {
        return;
    }
    for (char letter = 'A'; letter <= 'Z'; ++letter) {
        const auto value = c.command->number_of(letter);
        const auto* info = value ? machine::find_resin_setting(c.command->number, letter) : nullptr;
        if (info == nullptr) {
            continue;
        }
        if (*value < info->min || *value > info->max) {
            c.notices.notice(Level::info, std::string(info->path) + ": value kept within its bounds");
        }
        resin->edited.set(info->id, *value);
    }
}

void config_use(ActionContext& c, Args) {
    if (Resin* const resin = part(c)) {
        resin->use_settings();
    }
}

/// "ssid","password": with or without quotes, in whatever form the quotes come.
void wifi(ActionContext& c, Args a, bool access_point) {
    Resin* const resin = part(c);
    if (resin == nullptr) {
        return;
    }
    const auto take = [](std::string_view& from) {
        constexpr std::string_view marks = "\"'` ";
        const std::size_t comma = std::min(from.find(','), from.size());
        std::string_view word = from.substr(0, comma);
        from.remove_prefix(std::min(comma + 1, from.size()));
        word.remove_prefix(std::min(word.find_first_not_of(marks), word.size()));
        return word.substr(0, word.find_last_not_of(marks) + 1);
    };
    std::string_view rest = a[0].text;
    machine::Wifi& net = c.printer.wifi;
    net.ssid = take(rest).substr(0, 39);
    resin->wifi_password = take(rest).substr(0, 63);
    net.enabled = true;
    net.access_point = access_point;
}

void reboot(ActionContext& c, Args a) {
    if (Resin* const resin = part(c)) {
        const double ms = std::clamp(number_or(a[0], 0), 0.0, 3600e3);
        resin->reboot_in(machine::from_seconds(ms / 1000), c.printer.now());
    }
}

/// A board that cannot take its requests as fast as they come.
void wedge(ActionContext& c, Args a) {
    if (machine::to_seconds(c.printer.now()) - a[0].number < a[1].number / 1000) {
        refuse(c, "requests came too fast: the board hangs until it is reset");
        c.printer.hang(true);
    }
}

constexpr std::array move_args{
    ArgInfo{"z", number, true, "mm"}, ArgInfo{"f", number, false, "feed, mm/min"},
    ArgInfo{"relative", boolean, false, "by this distance, whatever G90 and G91 say"}};
constexpr std::array fan_args{ArgInfo{"value", number, true, "0 to 256"}};
constexpr std::array name_args{
    ArgInfo{"name", text, false,
            "file, relative to the root; quotes and the colon of an absolute path are taken off"}};
constexpr std::array wifi_args{ArgInfo{"network", text, true, "name and password: \"name\",\"password\""}};
constexpr std::array reboot_args{ArgInfo{"ms", number, false, "how long from now; at once if left out"}};

constexpr std::array wedge_args{ArgInfo{"since", number, true, "board.seconds of the request before"},
                                ArgInfo{"ms", number, true, "what comes sooner than this is too fast"}};

constexpr std::array table{
    ActionInfo{"resin.move", "", "moves the platform, within its limits", move_args, move},
    ActionInfo{"resin.home", "", "homes the platform; raises motion.homed at its end", {}, home},
    ActionInfo{
        "resin.stir", "", "moves the platform up and down, machine.resin.stir_cycles times (G29)", {}, stir},
    ActionInfo{
        "resin.motor_off", "", "the motor lets the platform go; the homing is forgotten", {}, motor_off},
    ActionInfo{"resin.fan", "", "speed of the LED's fan, whatever the settings say (M106)", fan_args, fan},
    ActionInfo{"resin.choose", "",
               "opens a file of the stick to print it (M23); resin.outcome says what became of it", name_args,
               choose},
    ActionInfo{"resin.start",
               "",
               "prints the file opened, or goes on with a paused print; resin.outcome says whether it did",
               {},
               start},
    ActionInfo{"resin.print", "", "opens a file and prints it (M6030); resin.outcome says what became of it",
               name_args, print},
    ActionInfo{"resin.remove", "", "removes a file of the stick (M30); resin.outcome says what became of it",
               name_args, remove},
    ActionInfo{"resin.write_backup", "", "writes the settings into a file of the stick, as requests (M8512)",
               name_args, write<machine::backup_text>},
    ActionInfo{"resin.write_diagnostics", "",
               "writes words of status and settings into a file of the stick (M8093)", name_args,
               write<machine::diagnostics_text>},
    ActionInfo{"config.set",
               "",
               "settings of this code (M8xxx), by the letters of the request; the machine uses them after "
               "config.use",
               {},
               config_set},
    ActionInfo{"config.use", "", "the machine uses the settings as they are now (M8510)", {}, config_use},
    ActionInfo{"wifi.join", "", "joins a network (M9003)", wifi_args,
               [](ActionContext& c, Args a) { wifi(c, a, false); }},
    ActionInfo{"wifi.open", "", "opens a network of its own (M9005)", wifi_args,
               [](ActionContext& c, Args a) { wifi(c, a, true); }},
    ActionInfo{"board.wedge", "", "the board hangs if less than a time has passed since a moment", wedge_args,
               wedge},
    ActionInfo{"board.reboot", "", "raises board.reboot_due after a time (M6040)", reboot_args, reboot},
};

}  // namespace

std::span<const ActionInfo> resin_actions() {
    return table;
}

}  // namespace fauxboard::behaviour::rows
