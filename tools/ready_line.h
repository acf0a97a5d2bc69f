#pragma once

#include <nlohmann/json_fwd.hpp>

#include "emulator/host/text_output.h"
#include "emulator/link/event_loop.h"

namespace fauxboard::tools {

/// The line that scripts wait for: `ready` and a JSON object. Whoever reads slowly still gets all of it,
/// however long it is (a thousand boards in 90 KB, where a pipe holds 64), and the loop goes on meanwhile.
class ReadyLine {
  public:
    /// Both outlive this.
    ReadyLine(link::EventLoop& loop, host::TextOutput& out)
        : out_(out), retry_(loop, [this] { see_off(); }) {}

    /// Throws link::HostError when it can never be taken, now or out of the loop; a stdout that is closed
    /// wants to hear nothing.
    void say(const nlohmann::ordered_json& ready);

  private:
    void see_off();

    host::TextOutput& out_;
    link::Timer retry_;
};

}  // namespace fauxboard::tools
