// What is in the file of the job, the touch screen, the stepper drivers, the job cut off by a power loss.

#include <array>

#include "emulator/behaviour/field_rows.h"
#include "emulator/filament/printer.h"
#include "emulator/filament/profile/tables.h"

namespace fauxboard::filament {
namespace {

using enum behaviour::FieldType;

constexpr behaviour::FieldRows<Printer> row;

constexpr auto driver = [](auto& p) -> auto& {
    return p.steppers.drivers[static_cast<std::size_t>(p.steppers.selected)];
};

constexpr std::array table{
    row.shown(
        "job.layer_by_height", integer, "",
        "layer of the job by the nozzle's height, (Z - 0.1 mm) / layer height, where the file tells that "
        "height; else as its comments count",
        [](const Printer& p) { return p.runner.layer_by_height(); }),
    row.shown("job.lines", integer, "", "lines of the file read in this job, comments included",
              [](const Printer& p) { return p.runner.counts().lines; }),
    row.shown("job.moves", integer, "", "moves of the file carried out in this job (G0 to G3)",
              [](const Printer& p) { return p.runner.counts().moves; }),
    row.shown("job.unknown_codes", integer, "",
              "lines of the file skipped in this job because their code is unknown",
              [](const Printer& p) { return p.runner.counts().unknown_codes; }),
    row.shown("job.lines_cut", integer, "",
              "lines of the file in this job that were too long to be read to their ends",
              [](const Printer& p) { return p.runner.counts().lines_cut; }),
    row.shown("job.executed_byte", integer, "bytes",
              "where the line of the move under way begins in the file: what a power cut loses begins here",
              [](const Printer& p) { return p.runner.executed_byte(); }),
    row.shown("host.moves", integer, "", "moves of the USB side carried out since power-on (G0 to G3)",
              [](const Printer& p) { return p.host.moves(); }),
    row.shown("host.writing", boolean, "",
              "lines of the USB side are written to a file (M28) and not carried out",
              [](const Printer& p) { return p.host.writing(); }),
    row.plain("screen.known", boolean, "", 0, 1, "the screen has told its firmware since power-on",
              FAUXBOARD_PLACE(screen.known)),
    row.plain("screen.firmware", text, "", 0, 64, "firmware of the screen as it told it",
              FAUXBOARD_PLACE(screen.firmware)),
    row.plain("screen.move_step", integer, "", 0, 4,
              "step of the move page: 0 to 4 are 30, 10, 1, 0.5, 0.1 mm", FAUXBOARD_PLACE(screen.move_step)),
    row.plain("screen.level_step", integer, "", 0, 3,
              "step of the auto-level page: 0 to 3 are 10, 1, 0.1, 0.05 mm",
              FAUXBOARD_PLACE(screen.level_step)),
    row.plain("screen.update_state", integer, "", 0, 5, "last step of the screen's firmware update (M2100 S)",
              FAUXBOARD_PLACE(screen.update_state)),
    row.plain("screen.update_file", text, "", 0, 64,
              "file name offered for the screen's firmware update (L8)", FAUXBOARD_PLACE(screen.update_file)),
    row.plain("stepper.selected", integer, "", 0, 3, "closed-loop driver that M2132 speaks of (SM)",
              FAUXBOARD_PLACE(steppers.selected)),
    row.plain(
        "stepper.closed_loop", boolean, "", 0, 1, "the selected driver runs closed loop",
        [](auto& p) -> auto& { return driver(p).closed_loop; }),
    row.plain(
        "stepper.calibration_error", integer, "", 0, 65535, "result of the calibration test (TC)",
        [](auto& p) -> auto& { return driver(p).calibration_error; }),
    row.plain(
        "stepper.enable_level", integer, "", 0, 1, "level that enables the motor (ED)",
        [](auto& p) -> auto& { return driver(p).enable_level; }),
    row.plain(
        "stepper.direction_level", integer, "", 0, 1, "level of the direction pin (DI)",
        [](auto& p) -> auto& { return driver(p).direction_level; }),
    row.plain(
        "stepper.microsteps", integer, "", 1, 256, "microsteps (MS)",
        [](auto& p) -> auto& { return driver(p).microsteps; }),
    row.plain(
        "stepper.max_current", integer, "mA", 0, 5000, "highest current (MC)",
        [](auto& p) -> auto& { return driver(p).max_current_ma; }),
    row.plain(
        "stepper.hold_current", integer, "mA", 0, 5000, "current at rest (HC)",
        [](auto& p) -> auto& { return driver(p).hold_current_ma; }),
    row.plain(
        "stepper.position", integer, "", -65536, 65536, "angle read back (C7)",
        [](auto& p) -> auto& { return driver(p).position; }),
    row.plain(
        "stepper.error_limit", integer, "", 0, 65535, "largest error allowed (C9)",
        [](auto& p) -> auto& { return driver(p).error_limit; }),
    row.shown("power_loss.saved_job", boolean, "", "a job that was cut off can be taken up again",
              [](const Printer& p) { return p.recovery.saved() != nullptr; }),
    row.shown("power_loss.resumes", boolean, "",
              "the file of the job to go on with is there, and has its size",
              [](const Printer& p) { return p.recovery.file_there(); }),
    row.shown("power_loss.path", text, "", "its file",
              [](const Printer& p) {
                  return p.recovery.saved() != nullptr ? std::string_view{p.recovery.saved()->path}
                                                       : std::string_view{};
              }),
    row.shown("power_loss.byte", integer, "bytes", "where in its file it goes on",
              [](const Printer& p) {
                  return p.recovery.saved() != nullptr ? static_cast<double>(p.recovery.saved()->byte) : 0.0;
              }),
};

}  // namespace

std::span<const behaviour::Field> device_fields() {
    return table;
}

}  // namespace fauxboard::filament
