#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fauxboard::machine {

/// The 8.3 name that a FAT disk has for a file: itself in capitals where it fits, else the first six letters,
/// "~1" and the first three of its ending. Of two long names that begin alike the disk would count on; this
/// does not.
std::string short_name(std::string_view name);

/// A file's name out of a request: up to the end of the first of `ends` that stands in it, or up to a star.
/// Empty where there is neither.
std::string_view cut_name(std::string_view name, const std::vector<std::string>& ends);

/// Equal but for the case of letters.
bool same_letters(std::string_view a, std::string_view b);

}  // namespace fauxboard::machine
