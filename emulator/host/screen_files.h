#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "emulator/host/profile_files.h"
#include "emulator/screen/screen_profile.h"

namespace fauxboard::host {

/// Loads a touch screen by name (from the folder `screens` in profile_folders()) or path. Throws
/// behaviour::ProfileError, also when there is no such file; then the names that exist are told.
std::shared_ptr<const screen::ScreenProfile> load_screen_by_name(std::string_view name);

/// Reads screens from files: as profile_finder() does, but names are those of screens.
behaviour::SourceFinder screen_finder();
/// The screen that a board of this profile is made for: the one that is called as the profile, or as one that
/// it extends, the nearest. Null when there is none, or it cannot be read.
std::shared_ptr<const screen::ScreenProfile> screen_of(const behaviour::Profile& profile);
/// The same of a screen that is part of a board: it must have a display.
std::shared_ptr<const screen::ScreenProfile> load_own_screen(std::string_view name);

/// All screens in the folders, by name.
std::vector<ProfileEntry> list_screens();

}  // namespace fauxboard::host
