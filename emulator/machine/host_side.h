#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "emulator/machine/sim_time.h"

namespace fauxboard::machine {

class EventQueue;

/// The commands of a computer on the USB port, one after the other: each begins when the one before it is
/// over. This one has no codes but those that the profile answers, and each is over at once; a kind whose
/// commands take their time, or that has codes of its own, derives from it.
class HostSide {
  public:
    explicit HostSide(EventQueue& events) : events_(events) {}
    virtual ~HostSide() = default;
    HostSide(const HostSide&) = delete;
    HostSide& operator=(const HostSide&) = delete;

    virtual void power_on();

    /// Whether `command` may begin now. None may while one runs.
    virtual bool ready(std::string_view /*command*/) { return !running_; }
    /// It begins. Ends by over(), however it is carried out.
    virtual void begin(std::string_view command, SimTime now);
    /// Carries out the command begun by the kind's own codes; false when it has no such code.
    virtual bool run_code() { return false; }
    bool running() const { return running_; }
    /// Whether the command begun still does something.
    virtual bool under_way(SimTime /*now*/) const { return false; }
    /// It is done; raises `host.done`, unless it was acknowledged already.
    virtual void over();
    /// What answered it was its acknowledgement as well ("ok T:..").
    void acknowledge() { acknowledged_ = true; }

    /// The command begun is kept instead of carried out: it becomes a line of a file. False when not.
    virtual bool write(std::string_view /*command*/, SimTime /*now*/) { return false; }
    /// After a command that may have begun or ended a transfer.
    virtual void follow_transfer() {}

    std::int64_t last_line = 0;                              ///< number of the last good line
    std::uint64_t resends = 0;                               ///< lines asked for again, since power-on
    std::uint64_t commands = 0;                              ///< carried out, since power-on
    const std::string& command() const { return command_; }  ///< the last one begun, at most 96 bytes of it

  private:
    EventQueue& events_;
    std::string command_;
    bool running_ = false;
    bool acknowledged_ = false;
};

}  // namespace fauxboard::machine
