#include "emulator/machine/events.h"

namespace fauxboard::machine {
namespace {

constexpr std::array<EventInfo, event_count> table{{
    {EventId::motion_homed, "motion.homed", "a full homing run has ended; X, Y and Z are known"},
    {EventId::motion_axis_homed, "motion.axis_homed", "homing of single axes has ended"},
    {EventId::motion_homing_failed, "motion.homing_failed",
     "an end stop did not trigger; what was still to be done is dropped"},
    {EventId::motion_bed_probed, "motion.bed_probed", "the nine points of the bed have been probed"},
    {EventId::motion_probed, "motion.probed", "the probe has measured one point"},
    {EventId::motion_parked, "motion.parked", "the head has reached its parking place"},
    {EventId::babystep_changed, "babystep.changed", "the babystep offset has a new value"},
    {EventId::leveling_probe_alarm, "leveling.probe_alarm",
     "the 3D Touch gives alarm, or was to probe while it does"},
    {EventId::heating_wait_started, "heating.wait_started",
     "the board began to wait for a temperature (M109, M190)"},
    {EventId::heating_wait_report, "heating.wait_report",
     "the waiting loop is due to report the temperatures, every 2 s with a hiccup each 51.2 s"},
    {EventId::heating_wait_done, "heating.wait_done",
     "the temperature waited for is there, or the wait was broken off"},
    {EventId::heating_pid_question, "heating.pid_question",
     "the board tunes the controller of a heater and asks whether to end that"},
    {EventId::heater_nozzle_abnormal, "heater.nozzle_abnormal",
     "the nozzle does not heat, runs away, is too hot, or its sensor is broken (heaters.nozzle.alarm); both "
     "heaters are off"},
    {EventId::heater_bed_abnormal, "heater.bed_abnormal", "the same of the bed (heaters.bed.alarm)"},
    {EventId::filament_piece, "filament.piece",
     "the extruder has begun one more piece while loading, unloading or cleaning"},
    {EventId::filament_stopped, "filament.stopped", "loading, unloading or cleaning has come to its end"},
    {EventId::filament_too_cold, "filament.too_cold", "the nozzle is too cold to move filament"},
    {EventId::filament_inserted, "filament.inserted", "filament was put into the detector"},
    {EventId::filament_removed, "filament.removed", "filament was taken out of the detector"},
    {EventId::filament_out, "filament.out", "the enabled detector ran empty while printing"},
    {EventId::card_inserted, "card.inserted", "the SD card or the U-disk was put in"},
    {EventId::card_removed, "card.removed", "the SD card or the U-disk was taken out"},
    {EventId::card_missing, "card.missing", "after power-on the board found that there is no SD card"},
    {EventId::card_failed, "card.failed", "the SD card or the U-disk can no longer be read"},
    {EventId::file_selected, "file.selected", "a file to print was selected"},
    {EventId::file_missing, "file.missing", "the file to select does not exist"},
    {EventId::file_unreadable, "file.unreadable", "the file to select cannot be opened"},
    {EventId::job_started, "job.started", "the selected file starts to print"},
    {EventId::job_pausing, "job.pausing", "a pause was asked for again while the first one is under way"},
    {EventId::job_paused, "job.paused", "the job has come to rest with the head parked"},
    {EventId::job_resumed, "job.resumed", "a paused job goes on"},
    {EventId::job_stopped, "job.stopped", "the job was stopped before its end"},
    {EventId::job_finished, "job.finished", "the job reached its end"},
    {EventId::job_closed, "job.closed", "the finished job is no longer shown; the board is idle"},
    {EventId::job_refused, "job.refused", "what was asked for cannot be done while a job is under way"},
    {EventId::job_file_lost, "job.file_lost",
     "the file being printed is gone; the job pauses and resuming tries again"},
    {EventId::job_file_unreadable, "job.file_unreadable",
     "the file being printed is there and cannot be read; the job pauses and resuming tries again"},
    {EventId::job_message, "job.message", "the file being printed has a message (M117): job.message"},
    {EventId::job_waits_for_user, "job.waits_for_user",
     "the file being printed, or the USB side, waits for the user (M0, M1, M600); resuming goes on"},
    {EventId::host_done, "host.done",
     "a command of the USB side is over, and nothing of its own has acknowledged it"},
    {EventId::host_busy, "host.busy",
     "the USB side has been waiting for its command for machine.host.busy_s"},
    {EventId::host_unknown, "host.unknown", "the USB side sent a command that nobody knows: host.command"},
    {EventId::host_wrong_number, "host.wrong_number",
     "a line of the USB side has not the number after host.last_line"},
    {EventId::host_wrong_checksum, "host.wrong_checksum", "a line of the USB side has a wrong checksum"},
    {EventId::host_no_checksum, "host.no_checksum", "a numbered line of the USB side has no checksum"},
    {EventId::host_no_number, "host.no_number", "a line of the USB side has a checksum and no number"},
    {EventId::host_write_failed, "host.write_failed",
     "the disk does not take what the USB side writes to a file (M28); its lines go nowhere until M29"},
    {EventId::power_lost, "power.lost",
     "the supply breaks down; there is still time to store what must be kept"},
    {EventId::job_layer_done, "job.layer_done", "a layer of a resin print has been exposed"},
    {EventId::board_reboot_due, "board.reboot_due", "the time that board.reboot was given has passed"},
    {EventId::transfer_piece, "transfer.piece",
     "a piece of an uploaded file came in; transfer.outcome says what became of it, and what is sent goes to "
     "its "
     "sender"},
}};

consteval bool ordered() {
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (static_cast<std::size_t>(table[i].id) != i) {
            return false;
        }
    }
    return true;
}
static_assert(ordered(), "the table stands in the order of EventId");

}  // namespace

std::span<const EventInfo> events() {
    return table;
}

std::optional<EventId> find_event(std::string_view name) {
    for (const EventInfo& event : table) {
        if (event.name == name) {
            return event.id;
        }
    }
    return std::nullopt;
}

}  // namespace fauxboard::machine
