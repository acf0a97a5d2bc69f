#pragma once

#include <string>
#include <string_view>

namespace fauxboard::protocol {

/// A line as it may be shown to others: what stands behind the network's name in M9003 and M9005 of ChiTu
/// boards (`M9003 "ssid","password"`) is `"***"`, whatever quotes it had. A checksum that was right is right
/// again, so that the line still means the same. Any other line, a line end included, is as it was.
std::string mask_secrets(std::string_view line);

}  // namespace fauxboard::protocol
