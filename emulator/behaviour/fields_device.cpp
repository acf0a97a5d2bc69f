// Card, job, screen, network and the board itself.

#include <array>
#include <cmath>
#include <vector>

#include "emulator/behaviour/field_rows.h"

namespace fauxboard::behaviour::rows {
namespace {

using enum FieldType;

constexpr auto driver = [](auto& p) -> auto& {
    return p.steppers.drivers[static_cast<std::size_t>(p.steppers.selected)];
};

constexpr std::array table{
    shown("card.code", integer, "",
          "SD of L2: 0 card, 1 none, 2 failed; plus 16, 32 for the U-disk where there is a port",
          [](const Printer& p) { return p.disk_code(); }),
    shown("card.usable", boolean, "", "the chosen disk is there and works",
          [](const Printer& p) { return p.storage.usable(p.storage.chosen()); }),
    shown("card.chosen", integer, "", "disk chosen by M2115: 0 SD card, 1 U-disk",
          [](const Printer& p) { return p.storage.chosen(); }),
    shown("card.entries", integer, "", "entries of the folder shown",
          [](const Printer& p) {
              std::vector<machine::CardEntry> entries;
              p.storage.listing(entries, p.config().card.max_listed);
              return entries.size();
          }),
    shown("card.folder", text, "", "folder shown, empty at the root",
          [](const Printer& p) { return std::string_view{p.storage.folder()}; }),

    shown("job.status", integer, "", "PS of L3: 0 idle, 1 printing, 2 paused, 3 recovery, 4 finished",
          [](const Printer& p) { return static_cast<int>(p.job.status()); }),
    shown("job.volume", integer, "", "VL of L3: disk the job is on, 0 SD card, 1 U-disk",
          [](const Printer& p) { return p.job.volume(); }),
    shown("job.path", text, "", "file selected, relative to its disk",
          [](const Printer& p) { return std::string_view{p.job.path()}; }),
    shown("job.name", text, "", "last part of job.path",
          [](const Printer& p) {
              const std::string_view path = p.job.path();
              return path.substr(path.rfind('/') + 1);
          }),
    shown("job.shown_path", text, "",
          "FN of L3: job.path while a job is under way or has just finished, else empty",
          [](const Printer& p) {
              return p.job.status() == machine::JobStatus::idle ? std::string_view{}
                                                                : std::string_view{p.job.path()};
          }),
    shown("job.selected", boolean, "", "a file is selected",
          [](const Printer& p) { return p.job.selected(); }),
    shown("job.pausing", boolean, "", "a pause was asked for and the head is on its way to park",
          [](const Printer& p) { return p.job.pausing(); }),
    shown("job.active", boolean, "", "a job prints or is paused",
          [](const Printer& p) { return p.job.active(); }),
    shown("job.progress", integer, "%", "PG of L3",
          [](const Printer& p) { return p.job.progress_percent(); }),
    shown("job.seconds", integer, "s", "TM of L3: time printed, pauses left out",
          [](const Printer& p) {
              return static_cast<double>(p.job.elapsed(p.now()) / std::chrono::seconds(1));
          }),
    plain("job.layer", integer, "", 0, 1e6, "LA of L3", FAUXBOARD_PLACE(job.layer)),
    plain("job.layers", integer, "", 0, 1e6, "LC of L3", FAUXBOARD_PLACE(job.layers)),
    shown("job.byte", integer, "bytes", "position in the file, 0 when idle",
          [](const Printer& p) { return p.job.byte(); }),
    shown("job.bytes", integer, "bytes", "size of the file, 0 when idle",
          [](const Printer& p) { return p.job.bytes(); }),
    shown("job.file_bytes", integer, "bytes", "size of the file selected, whatever the job's state",
          [](const Printer& p) { return p.job.file_bytes(); }),

    shown("job.estimate", integer, "s", "how long the slicer thinks the print takes, 0 when it did not say",
          [](const Printer& p) { return std::floor(p.job.estimate_s); }),
    shown("job.message", text, "", "text of the last M117 in the file",
          [](const Printer& p) { return std::string_view{p.job.message}; }),
    shown("job.waits_for_user", boolean, "", "the file has come to an M0, M1 or M600 and waits",
          [](const Printer& p) { return p.job.waits_for_user; }),
    shown("job.lines", integer, "", "lines of the file read in this job, comments included",
          [](const Printer& p) { return p.runner.counts().lines; }),
    shown("job.moves", integer, "", "moves of the file carried out in this job (G0 to G3)",
          [](const Printer& p) { return p.runner.counts().moves; }),
    shown("job.unknown_codes", integer, "",
          "lines of the file skipped in this job because their code is unknown",
          [](const Printer& p) { return p.runner.counts().unknown_codes; }),
    shown("job.executed_byte", integer, "bytes",
          "where the line of the move under way begins in the file: what a power cut loses begins here",
          [](const Printer& p) { return p.runner.executed_byte(); }),

    shown("host.last_line", integer, "", "number of the last good line of the USB side",
          [](const Printer& p) { return p.host.last_line; }),
    shown("host.next_line", integer, "", "number that the next line of the USB side is to have",
          [](const Printer& p) { return p.host.last_line + 1; }),
    shown("host.command", text, "", "the command of the USB side carried out last",
          [](const Printer& p) { return std::string_view{p.host.command()}; }),
    shown("host.commands", integer, "", "commands of the USB side carried out since power-on",
          [](const Printer& p) { return p.host.commands; }),
    shown("host.moves", integer, "", "moves of the USB side carried out since power-on (G0 to G3)",
          [](const Printer& p) { return p.host.moves(); }),
    shown("host.resends", integer, "", "lines asked of the USB side again since power-on",
          [](const Printer& p) { return p.host.resends; }),
    shown("host.busy", boolean, "", "a command of the USB side is being carried out",
          [](const Printer& p) { return p.host.running(); }),
    shown("host.writing", boolean, "",
          "lines of the USB side are written to a file (M28) and not carried out",
          [](const Printer& p) { return p.host.writing(); }),

    plain("screen.known", boolean, "", 0, 1, "the screen has told its firmware since power-on",
          FAUXBOARD_PLACE(screen.known)),
    plain("screen.firmware", text, "", 0, 64, "firmware of the screen as it told it",
          FAUXBOARD_PLACE(screen.firmware)),
    plain("screen.move_step", integer, "", 0, 4, "step of the move page: 0 to 4 are 30, 10, 1, 0.5, 0.1 mm",
          FAUXBOARD_PLACE(screen.move_step)),
    plain("screen.level_step", integer, "", 0, 3,
          "step of the auto-level page: 0 to 3 are 10, 1, 0.1, 0.05 mm", FAUXBOARD_PLACE(screen.level_step)),
    plain("screen.update_state", integer, "", 0, 5, "last step of the screen's firmware update (M2100 S)",
          FAUXBOARD_PLACE(screen.update_state)),
    plain("screen.update_file", text, "", 0, 64, "file name offered for the screen's firmware update (L8)",
          FAUXBOARD_PLACE(screen.update_file)),

    plain("wifi.module", boolean, "", 0, 1, "a WiFi module is fitted (WF)", FAUXBOARD_PLACE(wifi.module)),
    plain("wifi.enabled", boolean, "", 0, 1, "WiFi is on (WT)", FAUXBOARD_PLACE(wifi.enabled)),
    plain("wifi.auto_connect", boolean, "", 0, 1, "connects by itself (CF)",
          FAUXBOARD_PLACE(wifi.auto_connect)),
    plain("wifi.access_point", boolean, "", 0, 1, "is being set up as an access point (AP)",
          FAUXBOARD_PLACE(wifi.access_point)),
    plain("wifi.server", integer, "", 0, 2, "server: 0 closed, 1 opening, 2 connected (SS)",
          FAUXBOARD_PLACE(wifi.server_state)),
    plain("wifi.signal", integer, "", 0, 5, "signal strength (RS)", FAUXBOARD_PLACE(wifi.signal)),
    plain("wifi.router", integer, "", 0, 2, "router: 0 closed, 1 opening, 2 gave an address (RE)",
          FAUXBOARD_PLACE(wifi.router_state)),
    plain("wifi.router_ip", text, "", 0, 39, "address from the router (RI)", FAUXBOARD_PLACE(wifi.router_ip)),
    plain("wifi.ssid", text, "", 0, 39, "network name (RA)", FAUXBOARD_PLACE(wifi.ssid)),
    plain("wifi.server_ip", text, "", 0, 39, "address of the server (SA)", FAUXBOARD_PLACE(wifi.server_ip)),

    plain("stepper.selected", integer, "", 0, 3, "closed-loop driver that M2132 speaks of (SM)",
          FAUXBOARD_PLACE(steppers.selected)),
    plain(
        "stepper.closed_loop", boolean, "", 0, 1, "the selected driver runs closed loop",
        [](auto& p) -> auto& { return driver(p).closed_loop; }),
    plain(
        "stepper.calibration_error", integer, "", 0, 65535, "result of the calibration test (TC)",
        [](auto& p) -> auto& { return driver(p).calibration_error; }),
    plain(
        "stepper.enable_level", integer, "", 0, 1, "level that enables the motor (ED)",
        [](auto& p) -> auto& { return driver(p).enable_level; }),
    plain(
        "stepper.direction_level", integer, "", 0, 1, "level of the direction pin (DI)",
        [](auto& p) -> auto& { return driver(p).direction_level; }),
    plain(
        "stepper.microsteps", integer, "", 1, 256, "microsteps (MS)",
        [](auto& p) -> auto& { return driver(p).microsteps; }),
    plain(
        "stepper.max_current", integer, "mA", 0, 5000, "highest current (MC)",
        [](auto& p) -> auto& { return driver(p).max_current_ma; }),
    plain(
        "stepper.hold_current", integer, "mA", 0, 5000, "current at rest (HC)",
        [](auto& p) -> auto& { return driver(p).hold_current_ma; }),
    plain(
        "stepper.position", integer, "", -65536, 65536, "angle read back (C7)",
        [](auto& p) -> auto& { return driver(p).position; }),
    plain(
        "stepper.error_limit", integer, "", 0, 65535, "largest error allowed (C9)",
        [](auto& p) -> auto& { return driver(p).error_limit; }),

    shown("power_loss.saved_job", boolean, "", "a job that was cut off can be taken up again",
          [](const Printer& p) { return p.recovery.saved() != nullptr; }),
    shown("power_loss.path", text, "", "its file",
          [](const Printer& p) {
              return p.recovery.saved() != nullptr ? std::string_view{p.recovery.saved()->path}
                                                   : std::string_view{};
          }),
    shown("power_loss.byte", integer, "bytes", "where in its file it goes on",
          [](const Printer& p) {
              return p.recovery.saved() != nullptr ? static_cast<double>(p.recovery.saved()->byte) : 0.0;
          }),

    shown("identity.device_name", text, "", "DN of L9",
          [](const Printer& p) { return std::string_view{p.config().identity.device_name}; }),
    shown("identity.model", text, "", "DM of L9",
          [](const Printer& p) { return std::string_view{p.config().identity.model}; }),
    shown("identity.serial_number", text, "", "SN of L9",
          [](const Printer& p) { return std::string_view{p.config().identity.serial_number}; }),
    shown("identity.firmware", text, "", "FV of L9",
          [](const Printer& p) { return std::string_view{p.config().identity.firmware}; }),
    shown("identity.volume", text, "", "PV of L9",
          [](const Printer& p) { return std::string_view{p.config().identity.volume_text}; }),
    shown("identity.hardware", text, "", "HV of L9",
          [](const Printer& p) { return std::string_view{p.config().identity.hardware}; }),
    shown("board.seconds", number, "s", "time since the board's world began",
          [](const Printer& p) { return machine::to_seconds(p.now()); }),
};

}  // namespace

std::span<const Field> device_fields() {
    return table;
}

}  // namespace fauxboard::behaviour::rows
