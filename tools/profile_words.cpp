#include "tools/profile_words.h"

#include <CLI/Option.hpp>

#include "emulator/behaviour/own_words.h"
#include "protocol/framing.h"

namespace fauxboard::tools {

std::string profile_words(const behaviour::Profile& profile, behaviour::Channel channel,
                          const protocol::DecodedLine& line) {
    std::string words = behaviour::own_words(profile, line);
    if (words.empty() && line.code == nullptr && line.direction == protocol::Direction::to_board) {
        const auto command = protocol::parse_command(line.code_text);
        if (command && profile.rules_for(channel, *command) != nullptr) {
            words = line.code_text + ": the profile's own";
        }
    }
    return words;
}

void add_words_of(CLI::App& command, std::string& profile) {
    command
        .add_option("--profile", profile,
                    "Use the words that this profile has for codes of its own: a name of `fauxboard "
                    "profiles`, or a file")
        ->type_name("NAME|FILE");
}

}  // namespace fauxboard::tools
