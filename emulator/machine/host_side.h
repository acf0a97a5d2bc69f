#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "emulator/machine/commands.h"
#include "emulator/machine/sim_time.h"

namespace fauxboard::machine {

class EventQueue;

/// The commands of the lines that are spoken as a host speaks, one after the other: each begins when the one
/// before it is over. This one has no codes but those that the profile answers, and each is over at once; a
/// kind whose commands take their time, or that has codes of its own, derives from it.
class HostSide : public BegunCommand {
  public:
    /// The lines that commands may come on, by number; what is counted is counted for each.
    static constexpr std::size_t line_count = 2;
    static constexpr std::size_t usb_port = 1;
    struct Line {
        std::int64_t last = 0;      ///< number of the last good line
        std::uint64_t resends = 0;  ///< lines asked for again, since power-on
        std::uint64_t unanswered =
            0;                    ///< commands that by the dialect have no acknowledgement, since power-on
        std::size_t waiting = 0;  ///< commands that wait for their turn; its owner says it
        std::int64_t number = 0;  ///< of the command begun last, if it was numbered; the same
        bool numbered = false;
    };

    explicit HostSide(EventQueue& events) : events_(events) {}
    HostSide(const HostSide&) = delete;
    HostSide& operator=(const HostSide&) = delete;

    virtual void power_on();

    /// Whether `command` of line `from` may begin now. None may while one runs.
    virtual bool ready(std::size_t /*from*/, std::string_view /*command*/, SimTime /*now*/) {
        return !running_;
    }
    /// It begins. Ends by over(), however it is carried out.
    virtual void begin(std::size_t from, std::string_view command, SimTime now);
    bool run_code(bool /*by_rule*/) override { return false; }
    /// It has been carried out, one way or other, as far as that can be done now.
    virtual void settle() {}
    bool running() const { return running_; }
    /// Whether the command begun still does something.
    virtual bool under_way(SimTime /*now*/) const { return false; }
    /// It is done; raises `host.done`, unless it was acknowledged already.
    virtual void over();
    /// What answered it was its acknowledgement as well ("ok T:..").
    void acknowledge() { acknowledged_ = true; }
    /// By the dialect it has none.
    void leave_unanswered() {
        acknowledge();
        ++line().unanswered;
    }

    /// Whether a file of that line is open, so that its commands are kept and not carried out.
    virtual bool writing(std::size_t /*from*/) const { return false; }
    /// The command begun is kept instead of carried out: it becomes a line of a file. False when not.
    virtual bool write(std::string_view /*command*/, SimTime /*now*/) { return false; }
    /// After a command that may have begun or ended a transfer.
    virtual void follow_transfer() {}

    /// The line that the last command came on, or was complained about: what fields and replies speak of.
    std::size_t speaker = usb_port;
    std::array<Line, line_count> lines{};
    Line& line() { return lines[speaker]; }
    const Line& line() const { return lines[speaker]; }

    std::uint64_t commands = 0;                              ///< carried out, since power-on
    const std::string& command() const { return command_; }  ///< the last one begun

  private:
    EventQueue& events_;
    std::string command_;
    bool running_ = false;
    bool acknowledged_ = false;
};

}  // namespace fauxboard::machine
