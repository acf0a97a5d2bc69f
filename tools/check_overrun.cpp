// Whether a board's list of files may be more at once than the screen it is made for can take.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "emulator/behaviour/profile.h"
#include "emulator/host/profile_files.h"
#include "emulator/host/screen_files.h"
#include "tools/check_files.h"

namespace fauxboard::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t entry_bytes = 9;    // "L7 P63 " and the line's end
constexpr std::size_t around_bytes = 46;  // the lines before and behind
constexpr std::size_t frame_bytes = 8;    // "N-0 " and "*123"
constexpr std::size_t usual_name = 49;    // what a screen has room for

/// The screen of the profile's name, or of the nearest that it extends; null when there is none.
std::shared_ptr<const screen::ScreenProfile> screen_of(const behaviour::Profile& profile) {
    for (auto file = profile.files.rbegin(); file != profile.files.rend(); ++file) {
        const std::string name = fs::path(*file).stem().string();
        for (const fs::path& folder : host::profile_folders()) {
            std::error_code error;
            if (fs::is_regular_file(folder / "screens" / (name + ".json"), error)) {
                return host::load_screen_by_name(name);
            }
        }
    }
    return nullptr;
}

bool lists(const behaviour::Frame& frame) {
    return frame.to != behaviour::Channel::host &&
           std::any_of(frame.lines.begin(), frame.lines.end(),
                       [](const behaviour::Frame::Line& line) { return line.for_each_entry; });
}

}  // namespace

std::string overrun_remark(const behaviour::Profile& profile) {
    const auto screen = screen_of(profile);
    if (screen == nullptr || std::none_of(profile.frames.begin(), profile.frames.end(), lists)) {
        return {};
    }
    const machine::CardConfig& card = profile.machine->card;
    const std::size_t name = card.name_bytes != 0 ? card.name_bytes : usual_name;
    const std::size_t line = name + entry_bytes + (profile.line.framed ? frame_bytes : 0);
    const std::size_t all = card.max_listed * line + around_bytes;
    const std::size_t burst =
        profile.burst_bytes != 0 ? std::min<std::size_t>(all, profile.burst_bytes) : all;
    if (burst <= screen->line.buffer_bytes) {
        return {};
    }
    return fmt::format(
        "a list of {} names of {} characters is {} bytes in one go, and its screen {} holds {}: "
        "lines of it would be lost (transmit.burst_bytes lets a list leave in pieces)",
        card.max_listed, name, burst, screen->name, screen->line.buffer_bytes);
}

}  // namespace fauxboard::tools
