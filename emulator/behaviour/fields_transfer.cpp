// A file on its way onto the chosen disk, or off it.

#include <array>

#include "emulator/behaviour/field_rows.h"
#include "emulator/behaviour/field_tables.h"

namespace fauxboard::behaviour::rows {
namespace {

using enum FieldType;
using machine::Machine;
using machine::Transfer;

constexpr FieldRows<Machine> row;

constexpr std::array table{
    row.shown("transfer.mode", text, "", "what is open: none, upload, download",
              [](const Machine& p) { return to_string(p.transfer.mode()); }),
    row.shown(
        "transfer.outcome", text, "",
        "of the last request or piece: done, busy, in_use, not_open, no_name, no_disk, missing, resend, "
        "write_failed, at_end",
        [](const Machine& p) { return to_string(p.transfer.outcome); }),
    row.shown("transfer.name", text, "", "of the file that is open, or was; as it was asked for",
              [](const Machine& p) -> const std::string& { return p.transfer.name(); }),
    row.shown("transfer.asked", text, "", "the name that was asked for last, refused or not",
              [](const Machine& p) -> const std::string& { return p.transfer.asked(); }),
    row.shown("transfer.asked_part", text, "", "the last part of that name, behind the folders",
              [](const Machine& p) {
                  const std::string_view name = p.transfer.asked();
                  return name.substr(name.rfind('/') + 1);
              }),
    row.shown("transfer.existed", boolean, "", "a file of that name was there when the upload began",
              [](const Machine& p) { return p.transfer.existed(); }),
    row.shown("transfer.position", integer, "bytes", "where the next piece or block begins",
              [](const Machine& p) { return p.transfer.position(); }),
    row.shown("transfer.bytes", integer, "bytes", "size of the file that is downloaded",
              [](const Machine& p) { return p.transfer.bytes(); }),
    row.shown("transfer.by_network", boolean, "", "the request that is carried out came as a datagram",
              [](const Machine& p) { return p.transfer.by_network(); }),
};

}  // namespace

std::span<const Field> transfer_fields() {
    return table;
}

}  // namespace fauxboard::behaviour::rows
