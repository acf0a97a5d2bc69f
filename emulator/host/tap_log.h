#pragma once

#include <string_view>

#include "emulator/host/live_observer.h"
#include "emulator/host/plain_text.h"
#include "emulator/host/text_output.h"
#include "protocol/annotate.h"

namespace fauxboard::host {

/// Prints the talk on a tapped line as it passes, a line each, with microseconds:
///
///         12.345678  screen → board  N-0 M104 S200*74             nozzle: target 200 °C
///
/// The other end is a host until it shows that it is a screen.
class TapLog final : public LiveObserver {
  public:
    struct Options {
        bool lines = true;  ///< else warnings and errors only
        bool words = false;
    };
    TapLog(TextOutput& out, Options options) : out_(out), options_(options), colours_(out.colours()) {}

    void on_received(SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override;
    void on_sent(SimTime now, board::Channel channel, std::string_view line) override;
    void on_notice(SimTime now, board::Level level, std::string_view text) override;
    void on_link(SimTime now, link::LinkState state, std::string_view why) override;

  private:
    void print(SimTime now, Ink ink, std::string_view head, std::string_view text, std::string_view words);
    void say(SimTime now, std::string_view line, protocol::Direction direction);

    TextOutput& out_;
    Options options_;
    bool colours_;
    protocol::PeerName peer_;
};

}  // namespace fauxboard::host
