#pragma once

#include <span>
#include <string_view>

namespace fauxboard::panel {

/// A file of the page, as it was when the program was built.
struct Asset {
    std::string_view name;  ///< "app.js"; "index.html" is the page itself
    std::string_view type;  ///< as Content-Type has it
    std::string_view bytes;
};

/// All there are: nothing else is ever served.
std::span<const Asset> assets();
/// The one of that name, or null.
const Asset* find_asset(std::string_view name);

}  // namespace fauxboard::panel
