// What is broken at the machine: a field for each kind, and what its breaking shows in.

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "emulator/behaviour/field_rows.h"

namespace fauxboard::behaviour::rows {
namespace {

using machine::BreakdownId;
using machine::HeaterId;
using machine::ThermalAlarm;
using enum FieldType;

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

constexpr std::array shown_rows{
    shown("heaters.nozzle.alarm", text, "",
          "why the board gave the nozzle up: too cold, too hot, does not heat, runs away; empty when it did "
          "not, "
          "or it is heated anew",
          [](const Printer& p) { return alarm_words(p.thermal.alarm(HeaterId::nozzle)); }),
    shown("heaters.bed.alarm", text, "", "the same of the bed",
          [](const Printer& p) { return alarm_words(p.thermal.alarm(HeaterId::bed)); }),
    shown("heating.tuning", boolean, "", "the controller of a heater is being tuned",
          [](const Printer& p) { return p.tuning; }),
    shown("filament.moved", number, "mm",
          "filament that has really gone through the extruder since the machine was made",
          [](const Printer& p) { return p.filament_path.moved_mm; }),
    shown("host.active", boolean, "", "the USB side was heard within the last 10 s",
          [](const Printer& p) { return p.host_active(); }),
    shown("board.hung", boolean, "", "the board's program stands still: it hears and says nothing",
          [](const Printer& p) { return p.hung(); }),
};

/// Paths are made of the names in the machine's table, and live as long as the program.
template <std::size_t... I>
std::vector<Field> make_rows(std::index_sequence<I...>) {
    static const std::array<std::string, sizeof...(I)> paths{
        ("faults." + std::string(machine::breakdowns()[I].name))...};
    std::vector<Field> rows(shown_rows.begin(), shown_rows.end());
    (rows.push_back(shown(paths[I], boolean, "", machine::breakdowns()[I].help,
                          [](const Printer& p) { return p.breakdowns.active(static_cast<BreakdownId>(I)); })),
     ...);
    return rows;
}

}  // namespace

std::span<const Field> fault_fields() {
    static const std::vector<Field> rows = make_rows(std::make_index_sequence<machine::breakdown_count>());
    return rows;
}

}  // namespace fauxboard::behaviour::rows
