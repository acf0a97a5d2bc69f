#pragma once

#include "emulator/machine/event_rows.h"

namespace fauxboard::filament {

/// What may happen to a printer that melts filament, beside what may happen to every machine.
inline constexpr auto own_events = std::to_array<machine::EventInfo>({
    {"job.ended", "job.end was done, whether or not there was a job"},
    {"motion.axis_homed", "homing of single axes has ended"},
    {"motion.bad_arc", "a G2 or G3 has no usable centre; nothing moves"},
    {"motion.cold", "filament was to be moved through a nozzle that is too cold (extruder.min); it is not"},
    {"motion.too_long", "more filament was to be moved at once than the board allows; it is not"},
    {"motion.touched", "one of the touches that M48 asked for"},
    {"motion.repeated", "one point has been probed as often as was asked for (M48)"},
    {"motion.bed_probed", "the nine points of the bed have been probed"},
    {"motion.probed", "the probe has measured one point"},
    {"motion.parked", "the head has reached its parking place"},
    {"babystep.changed", "the babystep offset has a new value"},
    {"leveling.probe_alarm", "the 3D Touch gives alarm, or was to probe while it does"},
    {"heating.wait_started", "the board began to wait for a temperature (M109, M190)"},
    {"heating.wait_report",
     "the waiting loop is due to report the temperatures, every 2 s with a hiccup each 51.2 s"},
    {"heating.wait_done", "the temperature waited for is there, or the wait was broken off"},
    {"heating.pid_question", "the board tunes the controller of a heater and asks whether to end that"},
    {"heater.nozzle_abnormal",
     "the nozzle does not heat, runs away, is too hot, or its sensor is broken (heaters.nozzle.alarm); both "
     "heaters are off"},
    {"heater.bed_abnormal", "the same of the bed (heaters.bed.alarm)"},
    {"filament.piece", "the extruder has begun one more piece while loading, unloading or cleaning"},
    {"filament.stopped", "loading, unloading or cleaning has come to its end"},
    {"filament.too_cold", "the nozzle is too cold to move filament"},
    {"filament.inserted", "filament was put into the detector"},
    {"filament.removed", "filament was taken out of the detector"},
    {"job.no_marker", "the file wants to go back (M808) and has set no marker"},
    {"job.too_many_markers", "the file has set more markers than there is room for (M808 L)"},
    {"report.temperatures", "reports.temperatures seconds have passed (M155)"},
    {"report.position", "reports.position seconds have passed (M154)"},
    {"report.job", "reports.job seconds have passed (M27 S)"},
    {"filament.out", "the enabled detector ran empty while printing"},
});

/// The event that has this name, an own one or one of all machines.
consteval machine::EventId event(std::string_view name) {
    return machine::event_in(name, own_events, machine::common_events);
}

}  // namespace fauxboard::filament
