#pragma once

// Internal to emulator/link.

#include <string>
#include <system_error>

namespace fauxboard::link {

/// "No such file or directory" for ENOENT.
inline std::string error_text(int error) {
    return std::system_category().message(error);
}

}  // namespace fauxboard::link
