#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace fauxboard::control {

/// Bytes as JSON can carry them (RFC 4648, with padding).
std::string to_base64(std::string_view bytes);
/// The way back; nothing for a text that is none.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace fauxboard::control
