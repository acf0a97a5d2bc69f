#include "emulator/fault/kind_rows.h"
#include "protocol/framing.h"

namespace fauxboard::fault::rows {
namespace {

bool rightly_framed(const LineEdit& line) {
    if (!line.whole()) {
        return false;
    }
    const protocol::Unframed frame = protocol::unframe(line.text(), protocol::ChecksumPolicy::required);
    return frame.prefixed && frame.has_checksum && frame.fault == protocol::FrameFault::none;
}

void edit(LineEdit& line, const Values&, Dice& dice) {
    if (!rightly_framed(line)) {
        return;
    }
    const std::size_t digits = line.bytes.rfind('*') + 1;
    unsigned right = 0;
    for (std::size_t i = digits; line.bytes[i] >= '0' && line.bytes[i] <= '9'; ++i) {
        right = right * 10 + static_cast<unsigned>(line.bytes[i] - '0');
    }
    line.bytes.replace(digits, line.text_size() - digits, std::to_string(right ^ (1 + dice.below(255))));
}

}  // namespace

constinit const Kind wrong_checksum{
    .name = "wrong_checksum",
    .help = "a framed line comes with another checksum; other lines do not count",
    .attributes = {},
    .edit = edit,
    .applies = rightly_framed};

}  // namespace fauxboard::fault::rows
