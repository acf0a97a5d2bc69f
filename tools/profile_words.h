#pragma once

#include <CLI/App.hpp>
#include <string>

#include "emulator/behaviour/profile.h"
#include "protocol/annotate.h"

namespace fauxboard::tools {

/// What the profile says of a line; that it knows it, where it has rules for what no table has. Else empty.
std::string profile_words(const behaviour::Profile& profile, behaviour::Channel channel,
                          const protocol::DecodedLine& line);

/// --profile of a command that only reads or speaks to a board: whose words are used.
void add_words_of(CLI::App& command, std::string& profile);

}  // namespace fauxboard::tools
