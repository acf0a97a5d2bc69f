// The keys of a profile's `machine` that only a resin printer has.

#include <array>

#include "emulator/resin/profile/tables.h"

namespace fauxboard::resin {
namespace {

using behaviour::Findings;
using behaviour::Json;
using behaviour::ObjectReader;

void load_resin(const Json& node, const std::string& pointer, Findings& findings, ResinConfig& out) {
    ObjectReader reader(node, pointer, findings);
    reader.number("travel_mm", out.travel_mm, 1, 2000);
    reader.number("power_on_mm", out.power_on_mm, 0, 2000);
    reader.number("homing_bounce_mm", out.homing_bounce_mm, 0, 100);
    reader.number("pause_lift_mm", out.pause_lift_mm, 0, 2000);
    reader.number("pause_from_s", out.pause_from_s, 0, 600);
    reader.number("pause_to_s", out.pause_to_s, 0, 600);
    reader.number("stick_visible_s", out.stick_visible_s, 0, 600);
    reader.integer("stir_cycles", out.stir_cycles, 0, 60);
    if (const Json* status = reader.get("status")) {
        constexpr std::array<std::string_view, 8> words{"temp",      "other",  "mem",     "communication",
                                                        "indicator", "driver", "printer", "lcd"};
        ObjectReader row(*status, reader.pointer("status"), findings);
        for (std::size_t i = 0; i < words.size(); ++i) {
            row.unsigned_integer(words[i], out.status[i], 0, 0x7FFFFFFFU);
        }
        row.finish();
    }
    reader.finish();
}

}  // namespace

void load_config(ObjectReader& reader, Findings& findings, Config& config) {
    if (const Json* node = reader.get("resin")) {
        load_resin(*node, reader.pointer("resin"), findings, config.resin);
    }
}

}  // namespace fauxboard::resin
