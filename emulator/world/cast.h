#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulator/behaviour/profile.h"
#include "emulator/screen/screen_profile.h"
#include "emulator/script/scenario.h"
#include "emulator/world/print_watch.h"

namespace fauxboard::world {

/// A request that a line answers, and how the answer is known.
struct Probe {
    std::string request;
    std::string answer;                     ///< a part of it
    std::vector<std::string_view> or_else;  ///< of the answer in another state of the machine
    bool answered_by(std::string_view heard) const;
};

/// Who plays in a world: the board's profile and what goes with it. Shared by all worlds of a profile.
struct Cast {
    std::shared_ptr<const behaviour::Profile> profile;
    std::shared_ptr<const screen::ScreenProfile> screen;  ///< null: nobody touches this board
    std::shared_ptr<const script::Scenario> scenario;     ///< of a user; null: there is none
    std::map<std::string, std::string> files;             ///< on the card at first
    std::vector<std::string> requests;                    ///< codes that the main line knows
    std::vector<std::string> commands;                    ///< codes that the USB side knows
    std::array<std::optional<Probe>, behaviour::channel_count> probes;
    std::vector<std::string> prints;  ///< of the files, those that such a board begins to print
    /// One of them that it prints to its end without any heat, and what that comes to; no name: there is
    /// none.
    struct Proof {
        std::string file;
        Tally tally{};
    };
    Proof proof;
};

/// Finds out by trying what each line of a board of this profile knows and answers. A line that answers
/// nothing that was tried has no probe.
Cast make_cast(std::shared_ptr<const behaviour::Profile> profile,
               std::shared_ptr<const screen::ScreenProfile> screen = nullptr);

/// The same with a user's scenario, which is played over and over, and the files of its card.
Cast make_cast(std::shared_ptr<const script::Scenario> scenario);

/// All of a few harmless requests that a line of such a board answers when it is at rest.
std::vector<Probe> probes_of(const std::shared_ptr<const behaviour::Profile>& profile,
                             behaviour::Channel channel);

/// A file of a slicer that every board prints: heats, homes, some layers of short moves.
std::string small_print(unsigned layers);
/// One that needs no heat.
std::string cold_print();

}  // namespace fauxboard::world
