#pragma once

#include <string>

#include "protocol/annotate.h"

namespace fauxboard::behaviour {

class Profile;

/// What a profile's "words" say of a line: those of the longest beginning of its body that has some. Empty
/// when none has.
std::string own_words(const Profile& profile, const protocol::DecodedLine& line);

/// The line in words: the profile's own where it has some, else the protocol's. For both, bytes that are no
/// letters are spelled out.
std::string explain(const Profile& profile, const protocol::DecodedLine& line);

}  // namespace fauxboard::behaviour
