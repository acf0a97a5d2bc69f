#include "tools/progress.h"

#include <unistd.h>

#include <string>
#include <utility>

#include "emulator/host/plain_text.h"

namespace fauxboard::tools {
namespace {

using namespace std::chrono_literals;
constexpr auto patience = 2s;
constexpr auto on_terminal = 100ms;
constexpr auto elsewhere = 10s;

}  // namespace

Progress::Progress()
    : out_(STDERR_FILENO),
      terminal_(::isatty(STDERR_FILENO) == 1),
      due_(Clock::now() + (terminal_ ? patience : elsewhere)) {}

void Progress::say(std::string_view text) {
    const auto now = Clock::now();
    if (now < due_) {
        return;
    }
    host::StyledLine line(false);
    if (terminal_) {
        out_.write(line.over().add(text));
        dirty_ = true;
        due_ = now + on_terminal;
    } else {
        out_.write(line.add(text).end());
        due_ = now + elsewhere;
    }
}

void Progress::clear() {
    if (std::exchange(dirty_, false)) {
        out_.write(host::StyledLine(false).over());
    }
}

}  // namespace fauxboard::tools
