#include "tools/version.h"

#include <filesystem>

#include "commit.h"  // made by tools/commit.cmake at each build
#include "emulator/host/profile_files.h"

namespace fauxboard::tools {

std::string version_text() {
    std::string text = "fauxboard " FAUXBOARD_VERSION;
    if (const std::string commit = FAUXBOARD_COMMIT; !commit.empty()) {
        text += " (commit " + commit + ")";
    }
    text += "\nIt is an emulator, no real printer. Profiles come from";
    for (const std::filesystem::path& folder : host::profile_folders()) {
        text += "\n  " + folder.string();
    }
    return text;
}

}  // namespace fauxboard::tools
