#pragma once

#include "emulator/script/player.h"

namespace fauxboard::script {

/// How it stands, at any time: {"name", "title", "steps": [{"words", "state": "waiting", "running", "passed"
/// or "failed", "at", "sentence"}], "branches": [{"name", "words", "since"}], and at the end "verdict",
/// "sentence"}.
Json progress_json(const Player& player);

}  // namespace fauxboard::script
