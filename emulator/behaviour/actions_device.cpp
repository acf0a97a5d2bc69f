// Card, job, EEPROM, the board itself.

#include <algorithm>
#include <array>
#include <optional>

#include "emulator/behaviour/action_rows.h"
#include "emulator/behaviour/action_tables.h"
#include "emulator/behaviour/eeprom.h"
#include "emulator/behaviour/fields.h"

namespace fauxboard::behaviour::rows {
namespace {

using enum ArgType;

void card_choose(ActionContext& c, Args a) {
    if (!c.machine.storage.choose(whole(a[0], 0, 1).value_or(-1))) {
        refuse(c, "no such disk; expected 0 (SD card) or 1 (U-disk)");
    }
}

void card_enter(ActionContext& c, Args a) {
    std::string_view name = a[0].text;
    if (name.starts_with("file:")) {
        name.remove_prefix(5);
    }
    if (!c.machine.storage.enter(name)) {
        refuse(c, "no such folder on the card: \"" + std::string(name) + '"');
    }
}

void job_start(ActionContext& c, Args) {
    if (!c.machine.start_or_resume_job()) {
        c.notices.notice(Level::info, "nothing to start: no file is selected, or a job is under way");
    }
}

/// What of the profile's variables is kept: nothing where nobody says what they are.
std::optional<Variables> kept(const ActionContext& c) {
    return c.infos == nullptr ? std::nullopt : std::optional<Variables>({c.variables, *c.infos});
}

void eeprom_load(ActionContext& c, Args a) {
    const auto variables = kept(c);
    load_fields(c.machine, a[0].text, variables ? &*variables : nullptr);
}

void eeprom_defaults(ActionContext& c, Args a) {
    const auto variables = kept(c);
    apply_image(c.machine, c.machine.factory_image, a[0].text, variables ? &*variables : nullptr);
}

void eeprom_save(ActionContext& c, Args a) {
    const auto variables = kept(c);
    if (!save_fields(c.machine, a[0].text, variables ? &*variables : nullptr)) {
        c.notices.notice(Level::error,
                         "the EEPROM could not be written; the settings live only until power-off");
    }
}

void board_stall(ActionContext& c, Args a) {
    const double least = std::clamp(a[0].number, 0.0, 60000.0);
    const double most = std::clamp(number_or(a[1], least), least, 60000.0);
    c.machine.loop.stall(machine::from_seconds((least + (most - least) * c.machine.random()) / 1000));
}

constexpr std::array disk_args{ArgInfo{"disk", number, true, "0 SD card, 1 U-disk", {}, nullptr, 0, 1}};
constexpr std::array folder_args{
    ArgInfo{"name", text, true, "folder, as M20 file: names it; an empty one is the root"}};
constexpr std::array file_args{
    ArgInfo{"name", text, true, "file, relative to the folder shown"},
    ArgInfo{"replaces", number, false, "1: a job under way is dropped for it, not it refused"}};
constexpr std::array seek_args{ArgInfo{"byte", number, true, "position in the file"}};
constexpr std::array prefix_args{
    ArgInfo{"fields", text, false, "only fields whose path starts so; all if left out"}};
constexpr std::array timer_args{ArgInfo{"ms", number, true, "how long from now, ms", "ms"}};
constexpr std::array stall_args{ArgInfo{"ms", number, true, "time, ms", "ms"},
                                ArgInfo{"most_ms", number, false, "upper end of a random range", "ms"}};

constexpr std::array table{
    ActionInfo{"card.insert",
               "card in",
               "the SD card is put in",
               {},
               [](ActionContext& c, Args) { c.machine.insert_card(0); }},
    ActionInfo{"card.remove",
               "card out",
               "the SD card is taken out",
               {},
               [](ActionContext& c, Args) { c.machine.remove_card(0); }},
    ActionInfo{"card.fail",
               "card broken",
               "the SD card is in its slot and cannot be read; card.insert puts a good one in",
               {},
               [](ActionContext& c, Args) { c.machine.fail_card(0); }},
    ActionInfo{"udisk.insert",
               "udisk in",
               "the U-disk is put in, where the board has a port for one",
               {},
               [](ActionContext& c, Args) { c.machine.insert_card(1); }},
    ActionInfo{"udisk.remove",
               "udisk out",
               "the U-disk is taken out",
               {},
               [](ActionContext& c, Args) { c.machine.remove_card(1); }},
    ActionInfo{"udisk.fail",
               "udisk broken",
               "the U-disk is in its port and cannot be read; udisk.insert puts a good one in",
               {},
               [](ActionContext& c, Args) { c.machine.fail_card(1); }},
    ActionInfo{"card.mount",
               "",
               "takes the card in the slot, if any, into use (M21)",
               {},
               [](ActionContext& c, Args) { c.machine.storage.mount(0); }},
    ActionInfo{"card.release",
               "",
               "puts the card out of use; it stays in its slot (M22)",
               {},
               [](ActionContext& c, Args) { c.machine.storage.release(0); }},
    ActionInfo{"card.choose", "", "chooses SD card or U-disk (M2115)", disk_args, card_choose},
    ActionInfo{"card.enter", "",
               "enters a folder; one that is not there, or outside the card, changes nothing", folder_args,
               card_enter},
    ActionInfo{"card.root",
               "",
               "shows the root folder",
               {},
               [](ActionContext& c, Args) { c.machine.storage.enter_root(); }},
    ActionInfo{"card.told",
               "",
               "the card's list was told: card.news is no more",
               {},
               [](ActionContext& c, Args) { c.machine.card_told(); }},
    ActionInfo{"job.select", "", "selects a file; raises file.selected, file.missing or file.unreadable",
               file_args,
               [](ActionContext& c, Args a) { c.machine.select_file(a[0].text, number_or(a[1], 0) != 0); }},
    ActionInfo{"job.start", "", "starts the file selected, or resumes the paused job", {}, job_start},
    ActionInfo{
        "job.continue",
        "",
        "the user continues: a job that waits for that goes on, and so does a board that waits without one",
        {},
        [](ActionContext& c, Args) { c.machine.user_continues(); }},
    ActionInfo{"job.pause",
               "",
               "pauses: finishes the moves planned, parks the head, then raises job.paused; asked again "
               "meanwhile raises job.pausing",
               {},
               [](ActionContext& c, Args) { c.machine.pause_job(); }},
    ActionInfo{"job.stop",
               "",
               "stops the job; heaters off",
               {},
               [](ActionContext& c, Args) { c.machine.stop_job(); }},
    ActionInfo{"job.close",
               "",
               "a finished job is no longer shown: the board is idle",
               {},
               [](ActionContext& c, Args) { c.machine.close_job(); }},
    ActionInfo{"job.finish",
               "job finished",
               "the job is at its end",
               {},
               [](ActionContext& c, Args) { c.machine.finish_job(); }},
    ActionInfo{"job.seek", "", "position in the file (M26)", seek_args,
               [](ActionContext& c, Args a) { c.machine.seek_job(a[0].number); }},
    ActionInfo{"eeprom.save", "", "stores settings (M500)", prefix_args, eeprom_save},
    ActionInfo{"eeprom.load", "", "takes stored settings back (M501)", prefix_args, eeprom_load},
    ActionInfo{"eeprom.defaults", "", "factory settings (M502); the EEPROM itself stays until the next save",
               prefix_args, eeprom_defaults},
    ActionInfo{"machine.stop",
               "emergency stop",
               "job, heaters and motors off at once",
               {},
               [](ActionContext& c, Args) { c.machine.emergency_stop(); }},
    ActionInfo{"timer.start", "", "raises timer.over after a time; a timer that runs is set anew", timer_args,
               [](ActionContext& c, Args a) {
                   const double ms = std::clamp(a[0].number, 0.0, 86'400'000.0);
                   c.machine.start_timer(machine::from_seconds(ms / 1000));
               }},
    ActionInfo{
        "machine.kill",
        "",
        "the same, and the board stops for good (M112): after what board.killed makes it say nothing is "
        "heard or said until a reset",
        {},
        [](ActionContext& c, Args) { c.machine.kill(); }},
    ActionInfo{"board.stall", "", "the main loop, and with it the schedule, stands still for a time",
               stall_args, board_stall},
    ActionInfo{"board.reset",
               "board reset",
               "restarts the board as its reset button does; what is physical stays",
               {},
               [](ActionContext& c, Args) {
                   c.reset = true;
                   c.machine.restart = 1;
               }},
};

}  // namespace

std::span<const ActionInfo> device_actions() {
    return table;
}

}  // namespace fauxboard::behaviour::rows
