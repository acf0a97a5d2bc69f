#pragma once

// Private to this folder: the body's fields, without the frame.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/annotate.h"

namespace fauxboard::protocol {

/// Cuts `text` (what follows the code) into fields by the rules of `infos`. What is left over at the end,
/// blanks only, goes to `tail`.
std::vector<DecodedField> decode_fields(std::string_view text, std::span<const FieldInfo> infos,
                                        std::string& tail);

/// `value` with `decimals` digits behind the point, in the C locale whatever the program's.
std::string format_number(double value, int decimals);

}  // namespace fauxboard::protocol
