#pragma once

#include <chrono>
#include <string_view>

#include "emulator/host/text_output.h"

namespace fauxboard::tools {

/// How far long work has got, on stderr: nothing in the first two seconds, then a line that is written over
/// and over on a terminal; elsewhere, in a log of CI, one every ten seconds.
class Progress {
  public:
    Progress();
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Whether say() would say anything now.
    bool due() const { return Clock::now() >= due_; }
    /// Called as often as one likes.
    void say(std::string_view text);
    /// Takes the terminal's line away, before something else is said.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    host::TextOutput out_;
    bool terminal_;
    bool dirty_ = false;
    Clock::time_point due_;
};

}  // namespace fauxboard::tools
