// The lines that are spoken as a host speaks: of the one that is answered, where it matters which. The card
// and the EEPROM as hosts ask for them.

#include <algorithm>
#include <array>
#include <cstdint>

#include "emulator/behaviour/field_rows.h"
#include "emulator/behaviour/field_tables.h"

namespace fauxboard::behaviour::rows {
namespace {

using enum FieldType;
using machine::Machine;

constexpr FieldRows<Machine> row;

constexpr std::array<std::string_view, 4> restarts{"PowerUp", " External Reset", " Brown out Reset",
                                                   " Watchdog Reset"};
/// CRC-16 (0x1021) of what the EEPROM holds, as Marlin counts it.
constexpr auto image_crc = [](const Machine& p) {
    unsigned crc = 0;
    for (const char byte : p.eeprom_image.text()) {
        crc ^= static_cast<unsigned>(static_cast<unsigned char>(byte)) << 8U;
        for (int bit = 0; bit < 8; ++bit) {
            crc = ((crc & 0x8000U) != 0 ? crc << 1U ^ 0x1021U : crc << 1U) & 0xFFFFU;
        }
    }
    return crc;
};

constexpr std::array table{
    row.shown("host.last_line", integer, "", "number of the last good line of the USB side",
              [](const Machine& p) { return p.host_side().line().last; }),
    row.shown("host.next_line", integer, "", "number that the next line of the USB side is to have",
              [](const Machine& p) { return p.host_side().line().last + 1; }),
    row.shown("host.command", text, "", "the command of the USB side carried out last",
              [](const Machine& p) { return std::string_view{p.host_side().command()}; }),
    row.shown("host.commands", integer, "", "commands of the USB side carried out since power-on",
              [](const Machine& p) { return p.host_side().commands; }),
    row.shown("host.resends", integer, "", "lines asked of the USB side again since power-on",
              [](const Machine& p) { return p.host_side().line().resends; }),
    row.shown("host.busy", boolean, "", "a command of the USB side is being carried out",
              [](const Machine& p) { return p.host_side().running(); }),
    row.shown("host.numbered", boolean, "", "the command carried out last came in a numbered line",
              [](const Machine& p) { return p.host_side().line().numbered; }),
    row.shown("host.number", integer, "", "the number of that line",
              [](const Machine& p) { return p.host_side().line().number; }),
    row.shown(
        "host.queue_free", integer, "",
        "commands that the line has room for, the one being carried out left out (machine.host.queue_lines)",
        [](const Machine& p) {
            const auto room = static_cast<std::int64_t>(p.config().host.queue_lines) - 1;
            return std::max<std::int64_t>(room - static_cast<std::int64_t>(p.host_side().line().waiting), 0);
        }),
    row.shown("host.emergency_parser", boolean, "", "machine.host.emergency_parser",
              [](const Machine& p) { return p.config().host.emergency_parser; }),
    row.shown("job.place", integer, "bytes", "where the selected file goes on, or will begin",
              [](const Machine& p) { return p.job.place(); }),
    row.shown("card.asked", text, "", "the last part of the file name asked for last, as it was spelled",
              [](const Machine& p) { return std::string_view{p.storage.asked}; }),
    row.shown("card.looked_up", text, "", "what card.look_up found; empty: nothing",
              [](const Machine& p) { return std::string_view{p.storage.looked_up}; }),
    row.shown("eeprom.bytes", integer, "bytes", "size of what the EEPROM holds",
              [](const Machine& p) { return p.eeprom_image.size(); }),
    row.shown("eeprom.crc", integer, "", "CRC-16 of what the EEPROM holds",
              [](const Machine& p) { return image_crc(p); }),
    row.shown("eeprom.saved", boolean, "", "the EEPROM holds something else than the factory's settings",
              [](const Machine& p) { return p.eeprom_image.text() != p.factory_image; }),
    row.shown("board.restart", text, "",
              "why the board started, in Marlin's words: PowerUp, External Reset, ...",
              [](const Machine& p) { return restarts[static_cast<std::size_t>(p.restart)]; }),
};

}  // namespace

std::span<const Field> host_fields() {
    return table;
}

}  // namespace fauxboard::behaviour::rows
