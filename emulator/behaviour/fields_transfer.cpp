// A file on its way onto the chosen disk, or off it.

#include <array>

#include "emulator/behaviour/field_rows.h"

namespace fauxboard::behaviour::rows {
namespace {

using enum FieldType;
using machine::Transfer;

constexpr std::array table{
    shown("transfer.mode", text, "", "what is open: none, upload, download",
          [](const Printer& p) { return to_string(p.transfer.mode()); }),
    shown("transfer.outcome", text, "",
          "of the last request or piece: done, busy, in_use, not_open, no_name, no_disk, missing, resend, "
          "write_failed, at_end",
          [](const Printer& p) { return to_string(p.transfer.outcome); }),
    shown("transfer.name", text, "", "of the file that is open, or was; as it was asked for",
          [](const Printer& p) -> const std::string& { return p.transfer.name(); }),
    shown("transfer.asked", text, "", "the name that was asked for last, refused or not",
          [](const Printer& p) -> const std::string& { return p.transfer.asked(); }),
    shown("transfer.existed", boolean, "", "a file of that name was there when the upload began",
          [](const Printer& p) { return p.transfer.existed(); }),
    shown("transfer.position", integer, "bytes", "where the next piece or block begins",
          [](const Printer& p) { return p.transfer.position(); }),
    shown("transfer.bytes", integer, "bytes", "size of the file that is downloaded",
          [](const Printer& p) { return p.transfer.bytes(); }),
    shown("transfer.by_network", boolean, "", "the request that is carried out came as a datagram",
          [](const Printer& p) { return p.transfer.by_network(); }),
};

}  // namespace

std::span<const Field> transfer_fields() {
    return table;
}

}  // namespace fauxboard::behaviour::rows
