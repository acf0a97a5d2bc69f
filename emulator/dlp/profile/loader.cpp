#include <array>

#include "emulator/dlp/eeprom_layout.h"
#include "emulator/dlp/profile/tables.h"

namespace fauxboard::dlp {
namespace {

using behaviour::Findings;
using behaviour::Json;
using behaviour::ObjectReader;

void load_platform(const Json& node, const std::string& pointer, Findings& findings, PlatformConfig& out) {
    ObjectReader reader(node, pointer, findings);
    reader.number("travel_mm", out.travel_mm, 1, 2000);
    reader.number("start_mm", out.start_mm, 0, 2000);
    reader.number("overtravel_mm", out.overtravel_mm, 0, 100);
    reader.finish();
}

void load_quirks(const Json& node, const std::string& pointer, Findings& findings, Quirks& out) {
    ObjectReader reader(node, pointer, findings);
    for (const QuirkInfo& quirk : quirk_table) {
        reader.boolean(quirk.name, out.*quirk.member);
    }
    reader.finish();
}

void load_clock(const Json& node, const std::string& pointer, Findings& findings, BoardConfig& out) {
    ObjectReader reader(node, pointer, findings);
    Moment moment;
    reader.integer("year", moment.year, 2000, 2099);
    reader.integer("month", moment.month, 1, 12);
    reader.integer("day", moment.day, 1, month_length(moment.year, moment.month));
    reader.integer("hour", moment.hour, 0, 23);
    reader.integer("minute", moment.minute, 0, 59);
    reader.integer("second", moment.second, 0, 59);
    reader.finish();
    out.clock = moment;
}

void load_board(const Json& node, const std::string& pointer, Findings& findings, BoardConfig& out) {
    ObjectReader reader(node, pointer, findings);
    constexpr std::array<std::string_view, 2> firmwares{"0.01", "0.08"};
    auto firmware = static_cast<std::size_t>(out.firmware);
    reader.choice("firmware", firmwares, firmware);
    out.firmware = static_cast<Firmware>(firmware);
    int version = out.fpga_version;
    reader.integer("fpga_version", version, 0, 15);
    out.fpga_version = static_cast<std::uint8_t>(version);
    reader.boolean("lists_ctb", out.lists_ctb);
    if (const Json* part = reader.get("platform")) {
        load_platform(*part, reader.pointer("platform"), findings, out.platform);
    }
    if (const Json* part = reader.get("quirks")) {
        load_quirks(*part, reader.pointer("quirks"), findings, out.quirks);
    }
    if (const Json* part = reader.get("clock")) {
        load_clock(*part, reader.pointer("clock"), findings, out);
    }
    reader.finish();
}

}  // namespace

void load_config(ObjectReader& reader, Findings& findings, Config& config) {
    config.eeprom_bytes = eeprom_bytes;
    if (const Json* node = reader.get("dlp")) {
        load_board(*node, reader.pointer("dlp"), findings, config.board);
    }
}

}  // namespace fauxboard::dlp
