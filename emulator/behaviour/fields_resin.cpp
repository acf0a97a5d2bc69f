// What only resin printers have: axis, light, file, settings. Elsewhere each of these is nothing.

#include <array>
#include <utility>
#include <vector>

#include "emulator/behaviour/field_rows.h"

namespace fauxboard::behaviour::rows {
namespace {

using enum FieldType;
using machine::Resin;
using machine::ResinSetting;

/// As shown(), of the resin part.
template <class F>
constexpr Field seen(std::string_view path, FieldType type, std::string_view unit, std::string_view help, F) {
    return {
        path,   type,  unit, 0,
        0,      false, help, [](const Printer& p) { return p.resin ? as_value(F{}(p, *p.resin)) : Value{}; },
        nullptr};
}

/// As plain(), of the resin part; `ref` gives a reference to it.
template <class F>
constexpr Field kept(std::string_view path, FieldType type, std::string_view unit, double min, double max,
                     std::string_view help, F) {
    return {path,
            type,
            unit,
            min,
            max,
            false,
            help,
            [](const Printer& p) { return p.resin ? as_value(F{}(*p.resin)) : Value{}; },
            [](Printer& p, const Value& v) {
                if (p.resin) {
                    assign(F{}(*p.resin), v);
                }
            }};
}

#define FAUXBOARD_RESIN_PLACE(member) \
    [](auto& r) -> auto& {            \
        return r.member;              \
    }

constexpr std::array own{
    seen("resin.z", number, "mm", "height of the platform as the board knows it; 0 at power-on",
         [](const Printer& p, const Resin& r) { return r.axis.position(p.now()); }),
    seen("resin.homed", boolean, "", "the platform has been homed, and its motor held it since",
         [](const Printer&, const Resin& r) { return r.axis.homed(); }),
    seen("resin.moving", boolean, "", "the platform moves",
         [](const Printer&, const Resin& r) { return r.axis.busy(); }),
    seen("resin.motor", boolean, "", "the motor holds the platform",
         [](const Printer&, const Resin& r) { return r.axis.motors(); }),
    kept("resin.relative", boolean, "", 0, 1, "moves are by distances (G91)",
         FAUXBOARD_RESIN_PLACE(axis.relative)),
    seen("resin.phase", text, "",
         "of the print: idle, homing, reading, approaching, resting, exposing, lifting, waiting, finishing, "
         "held",
         [](const Printer&, const Resin& r) { return to_string(r.job.phase()); }),
    seen("resin.halted", boolean, "", "no layers are being printed: idle, or paused; D of M4000, third",
         [](const Printer& p, const Resin&) { return p.job.status() != machine::JobStatus::printing; }),
    seen("resin.led", boolean, "", "the LED shines", [](const Printer&, const Resin& r) { return r.led(); }),
    seen("resin.light", integer, "", "light of the layer being exposed as the file says it, 0 to 255",
         [](const Printer&, const Resin& r) { return r.job.light(); }),
    seen("resin.exposure_left", number, "s", "of the exposure under way or interrupted",
         [](const Printer& p, const Resin& r) { return r.job.exposure_left_s(p.now()); }),
    seen("resin.layer_z", number, "mm", "height of the layer under way, as the file says it",
         [](const Printer&, const Resin& r) { return r.job.layer_z_mm(); }),
    seen("resin.led_fan", integer, "", "fan of the LED, 0 to 256: F of M4000, first",
         [](const Printer&, const Resin& r) { return r.led_fan(); }),
    seen("resin.board_fan", integer, "", "fan of the motherboard, 0 to 256: F of M4000, second",
         [](const Printer&, const Resin& r) { return r.board_fan(); }),
    seen("resin.outcome", text, "",
         "of the file asked for last: opened, no_name, no_stick, missing, busy, unprintable, written, "
         "not_written, "
         "removed, not_removed",
         [](const Printer&, const Resin& r) { return to_string(r.outcome); }),
    seen("resin.replaced", boolean, "", "the file written last replaced another one",
         [](const Printer&, const Resin& r) { return r.replaced; }),
    seen("resin.asked", text, "", "name that was asked for last, without quotes, colon and leading slash",
         [](const Printer&, const Resin& r) { return std::string_view{r.asked}; }),
    seen("resin.file", text, "", "file opened last: its name, or /folder/name",
         [](const Printer&, const Resin& r) { return std::string_view{r.file}; }),
    seen("resin.file_bytes", integer, "bytes", "its size",
         [](const Printer&, const Resin& r) { return r.file_bytes; }),
};

// A resin board keeps its network; other boards have the same values and do not.

Field network_name() {
    return {"resin.wifi_ssid",
            text,
            "",
            0,
            39,
            true,
            "network that it joins or opens (M9003, M9005): wifi.ssid, kept",
            [](const Printer& p) { return p.resin ? as_value(p.wifi.ssid) : Value{}; },
            [](Printer& p, const Value& v) {
                if (p.resin) {
                    assign(p.wifi.ssid, v);
                }
            }};
}

Field network_kind() {
    return {"resin.wifi_kind",
            integer,
            "",
            0,
            2,
            true,
            "0 no network, 1 joins one (M9003), 2 opens its own (M9005): wifi.enabled and wifi.access_point, "
            "kept",
            [](const Printer& p) {
                return p.resin ? as_value(!p.wifi.enabled ? 0 : p.wifi.access_point ? 2 : 1) : Value{};
            },
            [](Printer& p, const Value& v) {
                if (p.resin) {
                    p.wifi.enabled = v.number > 0;
                    p.wifi.access_point = v.number == 2;
                }
            }};
}

/// A setting shows as it is edited. Whoever sets its field, unlike M8xxx, puts it into use at once.
template <std::size_t I>
Field setting() {
    static constexpr auto id = static_cast<ResinSetting>(I);
    const machine::ResinSettingInfo& info = machine::resin_settings()[I];
    return {info.path,
            info.whole ? integer : number,
            info.unit,
            info.min,
            info.max,
            true,
            info.help,
            [](const Printer& p) { return p.resin ? as_value(p.resin->edited[id]) : Value{}; },
            [](Printer& p, const Value& v) {
                if (p.resin) {
                    p.resin->edited.set(id, v.number);
                    p.resin->used.set(id, v.number);
                }
            }};
}

template <std::size_t... I>
std::vector<Field> all_rows(std::index_sequence<I...>) {
    std::vector<Field> rows(own.begin(), own.end());
    rows.push_back(kept("resin.network_name", text, "", 0, 15, "name in the network (U100)",
                        FAUXBOARD_RESIN_PLACE(network_name)));
    rows.push_back(kept("resin.wifi_password", text, "", 0, 63, "password of the network (M9003, M9005)",
                        FAUXBOARD_RESIN_PLACE(wifi_password)));
    rows.push_back(network_name());
    rows.push_back(network_kind());
    for (std::size_t i = own.size(); i < rows.size(); ++i) {
        rows[i].stored = true;
    }
    (rows.push_back(setting<I>()), ...);
    return rows;
}

}  // namespace

std::span<const Field> resin_fields() {
    static const std::vector<Field> table =
        all_rows(std::make_index_sequence<machine::resin_setting_count>{});
    return table;
}

}  // namespace fauxboard::behaviour::rows
