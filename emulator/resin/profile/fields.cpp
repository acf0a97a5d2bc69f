// Axis, light, file, settings.

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "emulator/behaviour/field_rows.h"
#include "emulator/resin/printer.h"
#include "emulator/resin/profile/tables.h"

namespace fauxboard::resin {
namespace {

using behaviour::Field;
using behaviour::Value;
using enum behaviour::FieldType;

constexpr behaviour::FieldRows<Printer> row;

constexpr std::array own{
    row.shown("resin.z", number, "mm",
              "height of the platform as the board knows it; 0 at power-on, and not below while it homes",
              [](const Printer& p) {
                  const double z = p.axis.position(p.now());
                  return p.axis.homing() ? std::max(z, 0.0) : z;
              }),
    row.shown("resin.homed", boolean, "", "the platform has been homed, and its motor held it since",
              [](const Printer& p) { return p.axis.homed(); }),
    row.shown("resin.moving", boolean, "", "the platform moves",
              [](const Printer& p) { return p.axis.busy(); }),
    row.shown("resin.motor", boolean, "", "the motor holds the platform",
              [](const Printer& p) { return p.axis.motors(); }),
    row.plain("resin.relative", boolean, "", 0, 1, "moves are by distances (G91)",
              FAUXBOARD_PLACE(axis.relative)),
    row.shown(
        "resin.phase", text, "",
        "of the print: idle, homing, reading, approaching, resting, exposing, lifting, waiting, finishing, "
        "held",
        [](const Printer& p) { return to_string(p.print.phase()); }),
    row.shown("resin.halted", boolean, "", "no layers are being printed: idle, or paused; D of M4000, third",
              [](const Printer& p) { return p.job.status() != JobStatus::printing; }),
    row.shown("resin.led", boolean, "", "the LED shines", [](const Printer& p) { return p.led(); }),
    row.shown("resin.light", integer, "", "light of the layer being exposed as the file says it, 0 to 255",
              [](const Printer& p) { return p.print.light(); }),
    row.shown("resin.exposure_left", number, "s", "of the exposure under way or interrupted",
              [](const Printer& p) { return p.print.exposure_left_s(p.now()); }),
    row.shown("resin.layer_z", number, "mm", "height of the layer under way, as the file says it",
              [](const Printer& p) { return p.print.layer_z_mm(); }),
    row.shown("resin.led_fan", integer, "", "fan of the LED, 0 to 256: F of M4000, first",
              [](const Printer& p) { return p.led_fan(); }),
    row.shown("resin.board_fan", integer, "", "fan of the motherboard, 0 to 256: F of M4000, second",
              [](const Printer& p) { return p.board_fan(); }),
    row.shown("resin.outcome", text, "",
              "of the file asked for last: opened, no_name, no_stick, missing, busy, unprintable, written, "
              "not_written, "
              "removed, not_removed",
              [](const Printer& p) { return to_string(p.outcome); }),
    row.shown("resin.replaced", boolean, "", "the file written last replaced another one",
              [](const Printer& p) { return p.replaced; }),
    row.shown("resin.asked", text, "",
              "name that was asked for last, without quotes, colon and leading slash",
              [](const Printer& p) { return std::string_view{p.asked}; }),
    row.shown("resin.file", text, "", "file opened last: its name, or /folder/name",
              [](const Printer& p) { return std::string_view{p.file}; }),
    row.shown("resin.file_bytes", integer, "bytes", "its size",
              [](const Printer& p) { return p.file_bytes; }),
};

// A resin board keeps its network; other boards have the same values and do not.

Field network_name() {
    return row.stored("resin.wifi_ssid", text, "", 0, 39,
                      "network that it joins or opens (M9003, M9005): wifi.ssid, kept",
                      FAUXBOARD_PLACE(wifi.ssid));
}

Field network_kind() {
    return row.handled(
        "resin.wifi_kind", integer, "", 0, 2,
        "0 no network, 1 joins one (M9003), 2 opens its own (M9005): wifi.enabled and wifi.access_point, "
        "kept",
        [](const Printer& p) { return !p.wifi.enabled       ? 0
                                      : p.wifi.access_point ? 2
                                                            : 1; },
        [](Printer& p, const Value& v) {
            p.wifi.enabled = v.number > 0;
            p.wifi.access_point = v.number == 2;
        });
}

/// A setting shows as it is edited. Whoever sets its field, unlike M8xxx, puts it into use at once.
template <std::size_t I>
Field setting() {
    static constexpr auto id = static_cast<ResinSetting>(I);
    const ResinSettingInfo& info = resin_settings()[I];
    Field made = row.handled(
        info.path, info.whole ? integer : number, info.unit, info.min, info.max, info.help,
        [](const Printer& p) { return p.edited[id]; },
        [](Printer& p, const Value& v) {
            p.edited.set(id, v.number);
            p.used.set(id, v.number);
        });
    made.stored = true;
    return made;
}

template <std::size_t... I>
std::vector<Field> all_rows(std::index_sequence<I...>) {
    std::vector<Field> rows(own.begin(), own.end());
    rows.push_back(row.plain("resin.network_name", text, "", 0, 15, "name in the network (U100)",
                             FAUXBOARD_PLACE(network_name)));
    rows.push_back(row.plain("resin.wifi_password", text, "", 0, 63, "password of the network (M9003, M9005)",
                             FAUXBOARD_PLACE(wifi_password)));
    rows.back().secret = true;
    rows.push_back(network_name());
    rows.push_back(network_kind());
    for (std::size_t i = own.size(); i < rows.size(); ++i) {
        rows[i].stored = true;
    }
    (rows.push_back(setting<I>()), ...);
    return rows;
}

}  // namespace

std::span<const behaviour::Field> fields() {
    static const std::vector<Field> table = all_rows(std::make_index_sequence<resin_setting_count>{});
    return table;
}

}  // namespace fauxboard::resin
