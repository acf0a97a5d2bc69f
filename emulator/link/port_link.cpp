// Picks what serves a port that exists. libserialport 0.1.1 finds ports through the kernel's tty class, where
// pseudo-terminals are not.

#include <utility>

#include "emulator/link/foreign_pty_link.h"
#include "emulator/link/serial_api.h"

namespace fauxboard::link {

std::unique_ptr<Link> make_port_link(EventLoop& loop, std::string device, unsigned baud) {
    if (is_pty_path(device)) return make_foreign_pty_link(loop, std::move(device), baud);
    return make_serial_link(loop, std::move(device), baud);
}

}  // namespace fauxboard::link
