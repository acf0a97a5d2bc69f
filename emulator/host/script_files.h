#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/source.h"
#include "emulator/host/profile_files.h"
#include "emulator/script/loader.h"

namespace fauxboard::host {

/// Reads scenarios from files. A name with a slash or ending in ".json" is a path (relative to the file that
/// includes it, or to the current folder); any other is looked for beside the including file and in the
/// folder `scenarios` of profile_folders().
behaviour::SourceFinder script_finder();

/// The text of a scenario by name or path. Throws behaviour::ProfileError when there is none; then the names
/// that exist are told.
behaviour::SourceText find_script(std::string_view name);

/// All scenarios in the folders `scenarios` of profile_folders(), by name.
std::vector<ProfileEntry> list_scripts();

/// A board and the screen that plays with it: the one at its line that is named, else the one that is part of
/// it. Throws behaviour::ProfileError; of a name that stands in the scenario `named_in`, with its place
/// there.
script::Cast make_cast(std::string_view profile, std::string_view screen,
                       const behaviour::SourceText* named_in = nullptr);

/// Checks a scenario against the board and the screen that it names itself. Throws behaviour::ProfileError.
std::shared_ptr<const script::Scenario> check_script(const behaviour::SourceText& source);

}  // namespace fauxboard::host
