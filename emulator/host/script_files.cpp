#include "emulator/host/script_files.h"

#include <algorithm>

#include "emulator/behaviour/document.h"
#include "emulator/behaviour/nearest.h"
#include "emulator/host/profile_files.h"
#include "emulator/host/screen_files.h"

namespace fauxboard::host {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view default_profile = "geeetech-a30t";

bool is_path(std::string_view name) {
    return name.find('/') != std::string_view::npos || name.ends_with(".json");
}

std::optional<behaviour::SourceText> find(std::string_view name, std::string_view from) {
    if (is_path(name)) {
        return profile_finder()(name, from);
    }
    const std::string file = std::string(name) + ".json";
    if (!from.empty()) {
        if (auto found = profile_finder()((fs::path(from).parent_path() / file).string(), {})) {
            return found;
        }
    }
    for (const fs::path& folder : profile_folders()) {
        if (auto found = profile_finder()((folder / "scenarios" / file).string(), {})) {
            return found;
        }
    }
    return std::nullopt;
}

/// A profile or screen that is not there is told where the scenario names it.
[[noreturn]] void rethrow_with_place(const behaviour::ProfileError& error,
                                     const behaviour::SourceText* named_in) {
    if (named_in != nullptr && error.problems().size() == 1) {
        const behaviour::Problem& first = error.problems().front();
        const behaviour::Document document = behaviour::parse_document(*named_in);
        for (const char* key : {"profile", "screen"}) {
            const auto named = document.root.find(key);
            if (named != document.root.end() && *named == first.file) {
                behaviour::Problem placed =
                    document.problem(std::string("/") + key, "\"" + first.file + "\": " + first.message);
                placed.nearest = first.nearest;
                throw behaviour::ProfileError({placed});
            }
        }
    }
    throw error;
}

}  // namespace

std::vector<ProfileEntry> list_scripts() {
    std::vector<fs::path> folders = profile_folders();
    std::transform(folders.begin(), folders.end(), folders.begin(),
                   [](const fs::path& folder) { return folder / "scenarios"; });
    return list_profiles(folders);
}

behaviour::SourceFinder script_finder() {
    return find;
}

behaviour::SourceText find_script(std::string_view name) {
    if (auto found = find(name, {})) {
        return *std::move(found);
    }
    behaviour::Problem problem;
    problem.file = std::string(name);
    const std::vector<ProfileEntry> entries = list_scripts();
    std::vector<std::string_view> names;
    if (is_path(name)) {
        problem.message = "there is no such file";
    } else {
        problem.message = "there is no scenario of this name; known:";
        for (const ProfileEntry& entry : entries) {
            names.emplace_back(entry.name);
            problem.message += ' ' + entry.name;
        }
        problem.nearest = std::string(behaviour::nearest(name, names));
    }
    throw behaviour::ProfileError({problem});
}

std::shared_ptr<const script::Scenario> check_script(const behaviour::SourceText& source) {
    const script::Head head = script::read_head(source);
    const script::Cast cast =
        make_cast(head.profile.empty() ? default_profile : head.profile, head.screen, &source);
    return script::load_scenario(source, script_finder(), cast);
}

script::Cast make_cast(std::string_view profile, std::string_view screen,
                       const behaviour::SourceText* named_in) {
    script::Cast out;
    try {
        out.profile = load_profile_by_name(profile);
        out.screen = screen.empty() ? nullptr : load_screen_by_name(screen);
    } catch (const behaviour::ProfileError& error) {
        rethrow_with_place(error, named_in);
    }
    if (!screen.empty()) {
        return out;
    }
    if (!out.profile->screen.empty()) {
        out.screen = load_own_screen(out.profile->screen);
    }
    return out;
}

}  // namespace fauxboard::host
