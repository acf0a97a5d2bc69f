#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace fauxboard::behaviour {

/// JSON is UTF-8, the line carries bytes: every character up to U+00FF becomes one byte ("\u00ff" is 0xFF).
/// Nothing when the text holds a character beyond that.
std::optional<std::string> to_wire(std::string_view utf8);

/// The other way: each byte becomes the character of the same number. Never fails.
std::string from_wire(std::string_view bytes);

/// Bytes for a person: printable ASCII as it is, all else as \xHH.
std::string as_ascii(std::string_view bytes);

}  // namespace fauxboard::behaviour
