#pragma once

#include <string>
#include <string_view>

namespace fauxboard::fault {

struct Deed;

/// "drop to screen: N-0 L1 X0.000*13"; `peer` is the other end of the line. Secrets are masked, and nothing
/// in it steers a terminal.
std::string deed_text(const Deed& deed, std::string_view peer);

}  // namespace fauxboard::fault
