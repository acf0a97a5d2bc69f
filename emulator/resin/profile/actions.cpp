// What can be done to a resin printer.

#include <algorithm>
#include <array>
#include <cmath>

#include "emulator/behaviour/action_rows.h"
#include "emulator/resin/printer.h"
#include "emulator/resin/profile/tables.h"
#include "emulator/resin/resin_files.h"

namespace fauxboard::resin {
namespace {

using behaviour::ActionContext;
using behaviour::ActionInfo;
using behaviour::ArgInfo;
using behaviour::Args;
using behaviour::flag;
using behaviour::Level;
using behaviour::number_or;
using behaviour::own;
using behaviour::refuse;
using behaviour::text_or_none;
using enum behaviour::ArgType;

/// Nothing moves by hand while a print does.
bool at_rest(const Printer& p, ActionContext& c) {
    const bool rests = p.job.status() != JobStatus::printing;
    if (!rests) {
        refuse(c, "not while printing; pause the print first");
    }
    return rests;
}

void check_queue(ActionContext& c, bool taken) {
    if (!taken) {
        refuse(c, "move lost: the motion queue is full");
    }
}

void move(Printer& p, ActionContext& c, Args a) {
    if (at_rest(p, c)) {
        const bool relative = p.axis.relative || flag(a[2]);
        check_queue(c, p.axis.move(a[0].number, relative, number_or(a[1], 0), p.now()));
    }
}

void home(Printer& p, ActionContext& c, Args) {
    if (at_rest(p, c)) {
        check_queue(c, p.axis.home(p.now()));
    }
}

void stir(Printer& p, ActionContext& c, Args) {
    if (at_rest(p, c)) {
        check_queue(c, p.axis.stir(p.config().resin.stir_cycles, p.now()));
    }
}

void motor_off(Printer& p, ActionContext& c, Args) {
    if (at_rest(p, c)) {
        p.axis.motors_off(p.now());
    }
}

void fan(Printer& p, ActionContext&, Args a) {
    p.fan = static_cast<int>(std::lround(std::clamp(a[0].number, 0.0, 256.0)));
}

void choose(Printer& p, ActionContext&, Args a) {
    p.choose(text_or_none(a[0]));
}

void start(Printer& p, ActionContext&, Args) {
    p.start();
}

void print(Printer& p, ActionContext&, Args a) {
    p.choose(text_or_none(a[0]));
    if (p.outcome == Printer::Outcome::opened) {
        p.start();
    }
}

void remove(Printer& p, ActionContext&, Args a) {
    p.remove(text_or_none(a[0]));
}

template <std::string (*Text)(const Printer&)>
void write(Printer& p, ActionContext&, Args a) {
    p.write(text_or_none(a[0]), Text(p));
}

/// Each letter of the request that this code has a setting for.
void config_set(Printer& p, ActionContext& c, Args) {
    if (c.command == nullptr) {
        return;
    }
    for (char letter = 'A'; letter <= 'Z'; ++letter) {
        const auto value = c.command->number_of(letter);
        const auto* info = value ? find_resin_setting(c.command->number, letter) : nullptr;
        if (info == nullptr) {
            continue;
        }
        if (*value < info->min || *value > info->max) {
            c.notices.notice(Level::info, std::string(info->path) + ": value kept within its bounds");
        }
        p.edited.set(info->id, *value);
    }
}

void config_use(Printer& p, ActionContext&, Args) {
    p.use_settings();
}

/// "ssid","password": with or without quotes, in whatever form the quotes come.
void wifi(Printer& p, Args a, bool access_point) {
    const auto take = [](std::string_view& from) {
        constexpr std::string_view marks = "\"'` ";
        const std::size_t comma = std::min(from.find(','), from.size());
        std::string_view word = from.substr(0, comma);
        from.remove_prefix(std::min(comma + 1, from.size()));
        word.remove_prefix(std::min(word.find_first_not_of(marks), word.size()));
        return word.substr(0, word.find_last_not_of(marks) + 1);
    };
    std::string_view rest = a[0].text;
    machine::Wifi& net = p.wifi;
    net.ssid = take(rest).substr(0, 39);
    p.wifi_password = take(rest).substr(0, 63);
    net.enabled = true;
    net.access_point = access_point;
}

void reboot(Printer& p, ActionContext&, Args a) {
    const double ms = std::clamp(number_or(a[0], 0), 0.0, 3600e3);
    p.reboot_in(from_seconds(ms / 1000));
}

/// A board that cannot take its requests as fast as they come.
void wedge(Printer& p, ActionContext& c, Args a) {
    if (to_seconds(p.now()) - a[0].number < a[1].number / 1000) {
        refuse(c, "requests came too fast: the board hangs until it is reset");
        p.hang(true);
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
    ActionInfo{"resin.move", "", "moves the platform, within its limits", move_args, own<move>},
    ActionInfo{"resin.home", "", "homes the platform; raises motion.homed at its end", {}, own<home>},
    ActionInfo{"resin.stir",
               "",
               "moves the platform up and down, machine.resin.stir_cycles times (G29)",
               {},
               own<stir>},
    ActionInfo{
        "resin.motor_off", "", "the motor lets the platform go; the homing is forgotten", {}, own<motor_off>},
    ActionInfo{"resin.fan", "", "speed of the LED's fan, whatever the settings say (M106)", fan_args,
               own<fan>},
    ActionInfo{"resin.choose", "",
               "opens a file of the stick to print it (M23); resin.outcome says what became of it", name_args,
               own<choose>},
    ActionInfo{"resin.start",
               "",
               "prints the file opened, or goes on with a paused print; resin.outcome says whether it did",
               {},
               own<start>},
    ActionInfo{"resin.print", "", "opens a file and prints it (M6030); resin.outcome says what became of it",
               name_args, own<print>},
    ActionInfo{"resin.remove", "", "removes a file of the stick (M30); resin.outcome says what became of it",
               name_args, own<remove>},
    ActionInfo{"resin.write_backup", "", "writes the settings into a file of the stick, as requests (M8512)",
               name_args, own<write<backup_text>>},
    ActionInfo{"resin.write_diagnostics", "",
               "writes words of status and settings into a file of the stick (M8093)", name_args,
               own<write<diagnostics_text>>},
    ActionInfo{"config.set",
               "",
               "settings of this code (M8xxx), by the letters of the request; the machine uses them after "
               "config.use",
               {},
               own<config_set>},
    ActionInfo{
        "config.use", "", "the machine uses the settings as they are now (M8510)", {}, own<config_use>},
    ActionInfo{"wifi.join", "", "joins a network (M9003)", wifi_args,
               own<[](Printer& p, ActionContext&, Args a) { wifi(p, a, false); }>},
    ActionInfo{"wifi.open", "", "opens a network of its own (M9005)", wifi_args,
               own<[](Printer& p, ActionContext&, Args a) { wifi(p, a, true); }>},
    ActionInfo{"board.wedge", "", "the board hangs if less than a time has passed since a moment", wedge_args,
               own<wedge>},
    ActionInfo{"board.reboot", "", "raises board.reboot_due after a time (M6040)", reboot_args, own<reboot>},
};

}  // namespace

std::span<const behaviour::ActionInfo> actions() {
    return table;
}

}  // namespace fauxboard::resin
