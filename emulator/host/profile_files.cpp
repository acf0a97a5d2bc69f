#include "emulator/host/profile_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "emulator/behaviour/nearest.h"
#include "emulator/behaviour/parse_json.h"
#include "emulator/host/text_file.h"

namespace fauxboard::host {
namespace {

namespace fs = std::filesystem;

bool is_path(std::string_view name) {
    return name.find('/') != std::string_view::npos || name.ends_with(".json");
}

std::optional<behaviour::SourceText> find(std::string_view name, std::string_view from) {
    const fs::path beside = from.empty() ? fs::path{} : fs::path(from).parent_path();
    if (is_path(name)) {
        return read_source(from.empty() ? fs::path(name) : beside / name);
    }
    const std::string file = std::string(name) + ".json";
    if (!from.empty()) {
        if (auto found = read_source(beside / file)) {
            return found;
        }
    }
    for (const fs::path& folder : profile_folders()) {
        if (auto found = read_source(folder / file)) {
            return found;
        }
    }
    if (!from.empty()) {
        throw unknown_source("profile", name, list_profiles());
    }
    return std::nullopt;
}

bool has_json(const fs::path& folder) {
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        if (at->path().extension() == ".json") {
            return true;
        }
    }
    return false;
}

/// The folders of FAUXBOARD_PROFILES, as they are named there.
std::vector<fs::path> named_folders() {
    std::vector<fs::path> folders;
    if (const char* list = std::getenv("FAUXBOARD_PROFILES"); list != nullptr) {
        std::string_view rest(list);
        while (!rest.empty()) {
            const std::size_t colon = std::min(rest.find(':'), rest.size());
            if (colon != 0) {
                folders.emplace_back(rest.substr(0, colon));
            }
            rest.remove_prefix(std::min(colon + 1, rest.size()));
        }
    }
    return folders;
}

}  // namespace

std::optional<behaviour::SourceText> read_source(const fs::path& file) {
    FileText found = read_text_file(file);
    if (!found.trouble.empty()) {
        behaviour::Problem problem;
        problem.file = file.string();
        problem.message = std::move(found.trouble);
        throw behaviour::ProfileError({problem});
    }
    return found.text ? std::optional(behaviour::SourceText{file.string(), *std::move(found.text)})
                      : std::nullopt;
}

std::vector<fs::path> profile_folders() {
    std::vector<fs::path> folders = named_folders();
    std::error_code error;
    std::erase_if(folders, [&error](const fs::path& folder) { return !fs::is_directory(folder, error); });
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    const fs::path beside = (program.parent_path() / FAUXBOARD_PROFILES_FROM_PROGRAM).lexically_normal();
    for (const fs::path& folder : {beside, fs::path(FAUXBOARD_SOURCE_PROFILES)}) {
        if (fs::is_directory(folder, error)) {
            folders.push_back(folder);
        }
    }
    return folders;
}

std::vector<std::string> useless_profile_folders() {
    std::vector<std::string> out;
    for (const fs::path& folder : named_folders()) {
        std::error_code error;
        if (!fs::is_directory(folder, error)) {
            out.push_back(folder.string() + ", which is no folder; it is passed over");
        } else if (!has_json(folder) && !has_json(folder / "screens") && !has_json(folder / "scenarios")) {
            out.push_back(folder.string() + ", which holds no profile, no screens/ and no scenarios/");
        }
    }
    return out;
}

behaviour::SourceFinder profile_finder() {
    return find;
}

std::shared_ptr<const behaviour::Profile> load_profile_by_name(std::string_view name) {
    const auto source = find(name, {});
    if (source) {
        return behaviour::load_profile(*source, find);
    }
    behaviour::Problem problem;
    problem.file = std::string(name);
    if (is_path(name)) {
        problem.message = "there is no such file";
    } else {
        const std::vector<ProfileEntry> entries = list_profiles();
        std::vector<std::string_view> names;
        problem.message = "there is no profile of this name; known:";
        for (const ProfileEntry& entry : entries) {
            names.emplace_back(entry.name);
            problem.message += ' ' + entry.name;
        }
        problem.nearest = std::string(behaviour::nearest(name, names));
    }
    throw behaviour::ProfileError({problem});
}

behaviour::UnknownSource unknown_source(std::string_view kind, std::string_view name,
                                        const std::vector<ProfileEntry>& entries) {
    std::vector<std::string_view> names;
    for (const ProfileEntry& entry : entries) {
        names.emplace_back(entry.name);
    }
    return {fmt::format("there is no {} \"{}\"", kind, name), behaviour::nearest(name, names)};
}

std::vector<ProfileEntry> list_profiles() {
    return list_profiles(profile_folders());
}

std::vector<ProfileEntry> list_profiles(const std::vector<fs::path>& folders) {
    std::vector<ProfileEntry> entries;
    for (const fs::path& folder : folders) {
        std::error_code error;
        for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
            const fs::directory_entry& item = *at;
            if (item.path().extension() != ".json") {
                continue;
            }
            const FileText source = read_text_file(item.path());
            if (!source.text) {
                continue;
            }
            const auto json = behaviour::parse_json(*source.text);
            if (!json.is_object() || !json.contains("name") || !json["name"].is_string()) {
                continue;
            }
            const auto title = json.find("title");
            entries.push_back(
                {json["name"].get<std::string>(),
                 title != json.end() && title->is_string() ? title->get<std::string>() : std::string{},
                 item.path()});
        }
    }
    std::stable_sort(entries.begin(), entries.end(),
                     [](const ProfileEntry& a, const ProfileEntry& b) { return a.name < b.name; });
    // The same name twice: the first folder's file is the one that is used.
    entries.erase(std::unique(entries.begin(), entries.end(),
                              [](const ProfileEntry& a, const ProfileEntry& b) { return a.name == b.name; }),
                  entries.end());
    return entries;
}

}  // namespace fauxboard::host
