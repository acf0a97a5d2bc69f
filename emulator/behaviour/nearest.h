#pragma once

#include <span>
#include <string_view>

namespace fauxboard::behaviour {

/// The name most like `word` by edit distance, if it is near enough to be what was meant; else an empty view.
/// Names are expected to be short; longer than 64 bytes are compared by their first 64.
std::string_view nearest(std::string_view word, std::span<const std::string_view> names);

}  // namespace fauxboard::behaviour
