#pragma once

#include "emulator/machine/event_rows.h"

namespace fauxboard::dlp {

/// What may happen to a machine with this board, beside what may happen to every machine; in the order of
/// Event.
inline constexpr auto own_events = std::to_array<machine::EventInfo>({
    {"board.ready", "the board's start is over"},
    {"print.started", "a file is open, and homing for its print begins"},
    {"print.not_opened", "the file to print cannot be opened: print.problem"},
    {"print.homing_failed", "homing for a print failed; the print is over"},
    {"print.layer_begun", "the lamp of the layer before went out, or the first layer begins"},
    {"print.displayed", "the UV panel shows another picture"},
    {"print.exposing", "the lamp was lit for a picture"},
    {"print.exposed", "the lamp went out: lamp.exposure_s"},
    {"print.paused", "the print is to pause"},
    {"print.resumed", "the print is to go on"},
    {"print.pause_reached", "a paused print stands at its height"},
    {"print.finishing", "the lamp and the panel are off, the last lift begins"},
    {"print.finished", "a print reached its end, and the platform its place"},
    {"print.cancelled", "a stopped print is over, and the platform at its place"},
    {"print.read_error", "the stick does not give what the print needs: print.problem"},
    {"platform.homed", "homing by hand has ended well"},
    {"platform.homing_failed", "a switch did not do what homing expects"},
    {"platform.zero_set", "Z=0 is where the platform stands, and is kept"},
    {"platform.stopped", "a move by hand, or homing, was stopped"},
    {"files.changed", "the folder shown was read anew: a stick came or went"},
    {"files.deleted", "the file viewed was deleted"},
    {"files.not_deleted", "the file viewed could not be deleted"},
    {"setup.loaded", "a settings file is in force and kept"},
    {"setup.failed", "a settings file was not taken to its end: setup.error, setup.error_line"},
    {"setup.saved", "the settings are kept"},
    {"setup.changed", "settings changed that the screen shows: language, rotation"},
    {"uvtest.loaded", "a test image is in the panel's bank"},
    {"uvtest.light_off", "the lamp of the UV test went out by itself"},
    {"motor.off", "the motor lost its current after a time without moves; homing is forgotten"},
    {"panel.failed", "a controller of the UV panel does not answer with its id"},
    {"clock.not_set", "the external clock did not take the time it was set to (0.08)"},
    {"touch.calibrated", "the touch sensor has a new calibration, which is kept (0.08)"},
    {"touch.not_calibrated", "the taps of a calibration say nothing: they lie in one line"},
});

/// The event that has this name, an own one or one of all machines.
consteval machine::EventId event(std::string_view name) {
    return machine::event_in(name, own_events, machine::common_events);
}

}  // namespace fauxboard::dlp
