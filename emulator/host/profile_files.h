#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/profile.h"

namespace fauxboard::host {

/// Where profiles are looked for by name, first hit wins: the folders of the environment variable
/// FAUXBOARD_PROFILES (parted by ':'), what was installed with the program (found from where the program
/// lies, so the installed tree can be moved), the folder it was built from.
std::vector<std::filesystem::path> profile_folders();
/// A clause about each that FAUXBOARD_PROFILES names in vain: "DIR, which is no folder; it is passed over".
std::vector<std::string> useless_profile_folders();

/// The text of a profile, screen, scenario or schema. Nothing where there is no such file. Throws
/// behaviour::ProfileError for one that cannot be read: what is there and broken is not passed over in favour
/// of another one.
std::optional<behaviour::SourceText> read_source(const std::filesystem::path& file);

/// Reads profiles from files. A name with a slash or ending in ".json" is a path (relative to the file that
/// extends it, or to the current folder); any other is looked for beside the extending file and in
/// profile_folders(). The finder throws behaviour::ProfileError for a file that is there and cannot be read.
behaviour::SourceFinder profile_finder();

/// Loads a profile by name or path. Throws behaviour::ProfileError, also when there is no such file; then the
/// names that exist are told, the nearest first.
std::shared_ptr<const behaviour::Profile> load_profile_by_name(std::string_view name);

/// A profile file that was found, for lists.
struct ProfileEntry {
    std::string name;
    std::string title;
    std::filesystem::path file;
};
/// All profiles in profile_folders(), by name; files that are no profiles are passed over.
std::vector<ProfileEntry> list_profiles();
/// That there is none of this name among `entries`, with the nearest that there is.
behaviour::UnknownSource unknown_source(std::string_view kind, std::string_view name,
                                        const std::vector<ProfileEntry>& entries);
/// The same of other folders.
std::vector<ProfileEntry> list_profiles(const std::vector<std::filesystem::path>& folders);

}  // namespace fauxboard::host
