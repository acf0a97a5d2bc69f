#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fauxboard::machine {

/// A file's name out of a request: up to the end of the first of `ends` that stands in it, or up to a star.
/// Empty where there is neither.
std::string_view cut_name(std::string_view name, const std::vector<std::string>& ends);

/// Equal but for the case of letters.
bool same_letters(std::string_view a, std::string_view b);

}  // namespace fauxboard::machine
