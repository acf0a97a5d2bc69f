// What the faults of this kind show in.

#include <array>

#include "emulator/behaviour/field_rows.h"
#include "emulator/filament/printer.h"
#include "emulator/filament/profile/tables.h"

namespace fauxboard::filament {
namespace {

using enum behaviour::FieldType;

constexpr behaviour::FieldRows<Printer> row;

std::string_view alarm_words(ThermalAlarm alarm) {
    switch (alarm) {
        case ThermalAlarm::none:
            return "";
        case ThermalAlarm::too_cold:
            return "too cold";
        case ThermalAlarm::too_hot:
            return "too hot";
        case ThermalAlarm::no_rise:
            return "does not heat";
        case ThermalAlarm::runaway:
            break;
    }
    return "runs away";
}

constexpr std::array table{
    row.shown(
        "heaters.nozzle.alarm", text, "",
        "why the board gave the nozzle up: too cold, too hot, does not heat, runs away; empty when it did "
        "not, "
        "or it is heated anew",
        [](const Printer& p) { return alarm_words(p.thermal.alarm(HeaterId::nozzle)); }),
    row.shown("heaters.bed.alarm", text, "", "the same of the bed",
              [](const Printer& p) { return alarm_words(p.thermal.alarm(HeaterId::bed)); }),
    row.shown("heating.tuning", boolean, "", "the controller of a heater is being tuned",
              [](const Printer& p) { return p.tuning; }),
    row.shown("filament.moved", number, "mm",
              "filament that has really gone through the extruder since the machine was made",
              [](const Printer& p) { return p.filament_path.moved_mm; }),
    row.shown("filament.moved_m", number, "m", "the same in metres",
              [](const Printer& p) { return p.filament_path.moved_mm / 1000; }),
};

}  // namespace

std::span<const behaviour::Field> fault_fields() {
    return table;
}

}  // namespace fauxboard::filament
