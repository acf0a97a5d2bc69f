#include "emulator/host/screen_files.h"

#include <algorithm>
#include <optional>
#include <string>

#include "emulator/behaviour/nearest.h"

namespace fauxboard::host {
namespace {

namespace fs = std::filesystem;

std::optional<behaviour::SourceText> find(std::string_view name) {
    if (name.find('/') != std::string_view::npos || name.ends_with(".json")) {
        return profile_finder()(name, {});
    }
    for (const fs::path& folder : profile_folders()) {
        const fs::path file = folder / "screens" / (std::string(name) + ".json");
        if (auto found = profile_finder()(file.string(), {})) {
            return found;
        }
    }
    return std::nullopt;
}

}  // namespace

std::shared_ptr<const screen::ScreenProfile> load_screen_by_name(std::string_view name) {
    if (const auto source = find(name)) {
        return screen::load_screen(*source, profile_finder());
    }
    behaviour::Problem problem;
    problem.file = std::string(name);
    if (name.find('/') != std::string_view::npos || name.ends_with(".json")) {
        problem.message = "there is no such file";
    } else {
        const std::vector<ProfileEntry> entries = list_screens();
        std::vector<std::string_view> names;
        problem.message = "there is no screen of this name; known:";
        for (const ProfileEntry& entry : entries) {
            names.emplace_back(entry.name);
            problem.message += ' ' + entry.name;
        }
        problem.nearest = std::string(behaviour::nearest(name, names));
    }
    throw behaviour::ProfileError({problem});
}

std::vector<ProfileEntry> list_screens() {
    std::vector<fs::path> folders = profile_folders();
    std::transform(folders.begin(), folders.end(), folders.begin(),
                   [](const fs::path& folder) { return folder / "screens"; });
    return list_profiles(folders);
}

}  // namespace fauxboard::host
