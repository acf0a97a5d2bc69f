#include "emulator/host/screen_files.h"

#include <algorithm>
#include <optional>
#include <string>

#include "emulator/behaviour/nearest.h"

namespace fauxboard::host {
namespace {

namespace fs = std::filesystem;

std::optional<behaviour::SourceText> find(std::string_view name, std::string_view from) {
    if (name.find('/') != std::string_view::npos || name.ends_with(".json")) {
        return profile_finder()(name, from);
    }
    const std::string file = std::string(name) + ".json";
    if (!from.empty()) {
        if (auto found = profile_finder()((fs::path(from).parent_path() / file).string(), {})) {
            return found;
        }
    }
    for (const fs::path& folder : profile_folders()) {
        if (auto found = profile_finder()((folder / "screens" / file).string(), {})) {
            return found;
        }
    }
    if (!from.empty()) {
        throw unknown_source("screen", name, list_screens());
    }
    return std::nullopt;
}

}  // namespace

behaviour::SourceFinder screen_finder() {
    return find;
}

std::shared_ptr<const screen::ScreenProfile> load_screen_by_name(std::string_view name) {
    if (const auto source = find(name, {})) {
        return screen::load_screen(*source, find);
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

std::shared_ptr<const screen::ScreenProfile> load_own_screen(std::string_view name) {
    auto out = load_screen_by_name(name);
    if (!out->display) {
        behaviour::Problem problem;
        problem.file = out->files.back();
        problem.message =
            "this screen hangs on a line; expected one with a \"display\", to be part of a board";
        throw behaviour::ProfileError({problem});
    }
    return out;
}

std::vector<ProfileEntry> list_screens() {
    std::vector<fs::path> folders = profile_folders();
    std::transform(folders.begin(), folders.end(), folders.begin(),
                   [](const fs::path& folder) { return folder / "screens"; });
    return list_profiles(folders);
}

std::shared_ptr<const screen::ScreenProfile> screen_of(const behaviour::Profile& profile) {
    for (auto file = profile.files.rbegin(); file != profile.files.rend(); ++file) {
        try {
            if (const auto source = find(fs::path(*file).stem().string(), {})) {
                return screen::load_screen(*source, find);
            }
        } catch (const behaviour::ProfileError&) {
            return nullptr;
        }
    }
    return nullptr;
}

}  // namespace fauxboard::host
