#pragma once

// Internal to emulator/link.

#include <chrono>
#include <string>

#include "emulator/link/event_loop.h"
#include "emulator/link/stream_link.h"

namespace fauxboard::link {

/// A link to something that exists apart from us: when it goes away, it is tried again every 500 ms.
class ReopeningLink : public StreamLink {
  public:
    static constexpr std::chrono::milliseconds retry_period{500};

  protected:
    explicit ReopeningLink(EventLoop& loop) : StreamLink(loop), timer_(loop, [this] { try_again(); }) {}

    /// Closes the device, half-opened ones too.
    virtual void release_device() = 0;
    /// The sentence for the log when the stream ended because of `why`.
    virtual std::string lost_sentence(const std::string& why) const = 0;
    /// One try; calls retry_later() if it fails. As it stands: open_device().
    virtual void try_again();

    void retry_later();
    void on_end(const std::string& why) final;
    void close_device() final;

  private:
    Timer timer_;
};

}  // namespace fauxboard::link
