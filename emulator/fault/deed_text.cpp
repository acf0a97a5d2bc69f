#include "emulator/fault/deed_text.h"

#include <fmt/format.h>

#include "emulator/behaviour/wire_text.h"
#include "emulator/fault/fault_line.h"
#include "protocol/secrets.h"

namespace fauxboard::fault {

std::string deed_text(const Deed& deed, std::string_view peer) {
    return fmt::format("{} {} {}: {}", deed.kind, deed.direction == Direction::to_board ? "from" : "to", peer,
                       behaviour::as_ascii(protocol::mask_secrets(deed.line)));
}

}  // namespace fauxboard::fault
