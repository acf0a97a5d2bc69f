#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/behaviour/notice.h"
#include "emulator/behaviour/profile.h"
#include "emulator/board/code_queue.h"
#include "emulator/board/command_queue.h"
#include "emulator/board/front.h"
#include "emulator/board/message_queue.h"
#include "emulator/board/network_outbox.h"
#include "emulator/board/output_buffer.h"
#include "emulator/board/ring_intake.h"
#include "emulator/board/schedule_runner.h"
#include "emulator/machine/machine.h"
#include "emulator/machine/sim_time.h"
#include "protocol/chitu_chunk.h"
#include "protocol/framing.h"
#include "protocol/host_line.h"

namespace fauxboard::board {

using behaviour::Channel;
using behaviour::Level;
using machine::SimTime;

/// Who speaks on a line, for logs: the other end, and the board's own.
constexpr std::string_view other_end(Channel channel) {
    constexpr std::string_view names[] = {"screen", "host", "network"};
    return names[static_cast<std::size_t>(channel)];
}
constexpr std::string_view own_end(Channel channel) {
    constexpr std::string_view names[] = {"board", "usb", "module"};
    return names[static_cast<std::size_t>(channel)];
}

/// What became of a received line.
enum class Verdict : std::uint8_t { accepted, bad_frame, queue_full };

/// Told what passes, as it passes. Must not call back into the board.
class Observer {
  public:
    virtual ~Observer() = default;
    /// One line arrived, line end removed, prefix and checksum still on it. The verdict is that of the
    /// moment: whether it was taken; an unknown code is found out only when the line is executed.
    virtual void on_received(SimTime now, Channel channel, std::string_view line, Verdict verdict) = 0;
    /// One line was put on the wire, line end removed.
    virtual void on_sent(SimTime now, Channel channel, std::string_view line) = 0;
    /// Something a person wants to know: a clamped value, an unknown code, a lost message.
    virtual void on_notice(SimTime now, Level level, std::string_view text) = 0;
    /// The board's program begins anew, by power, by reset or by itself: what waited is lost, what was begun
    /// is over without a word.
    virtual void on_power_on(SimTime /*now*/) {}
    /// Something happened to the machine (see machine::events()); told before the profile's rules for it are
    /// carried out.
    virtual void on_event(SimTime /*now*/, machine::EventId /*event*/) {}
    /// A datagram came from `peer`, or goes to it, whole. Requests and answers in it are told as lines too,
    /// with Channel::network; pieces of files are not.
    virtual void on_datagram(SimTime /*now*/, std::uint64_t /*peer*/, bool /*to_board*/,
                             std::string_view /*bytes*/) {}
    /// Something is done to the machine by world() or act(), in the words of behaviour::action_words(); told
    /// before it is done.
    virtual void on_world(SimTime /*now*/, std::string_view /*words*/) {}
};

struct Options {
    bool pacing = true;  ///< replies leave on the transmit tick; without it, at once
    std::uint64_t seed = 1;
    Observer* observer = nullptr;
    Front* front = nullptr;  ///< outlives the board
};

/// Everything that was counted since the board was made.
struct Counters {
    std::uint64_t lines_received = 0;
    std::uint64_t lines_sent = 0;
    std::uint64_t bad_frames = 0;  ///< wrong, missing or malformed checksum where one was needed
    std::uint64_t unknown_codes = 0;
    std::uint64_t unmatched = 0;      ///< known code, but no rule for its parameters
    std::uint64_t requests_lost = 0;  ///< more waiting than the board has room for; or it hung
    std::uint64_t messages_lost = 0;  ///< same, outwards
    std::uint64_t lines_cut = 0;      ///< frames longer than a line may be
    std::uint64_t bytes_lost = 0;     ///< received while the board's ring was full
};

/// One virtual control board: bytes in, bytes out, time in. No clock, no I/O, no threads; many boards may
/// share a profile.
///
/// Use: power_on(), then advance() when the time it returned has come, and receive() when bytes come. After
/// each call take output(). Times never go back. advance() stops at the first output, so that every output
/// has its exact time; call it before receive() for the same reason, though receive() makes up for what is
/// overdue.
class Board final : private behaviour::NoticeSink, private machine::FileCommands {
  public:
    Board(std::shared_ptr<const behaviour::Profile> profile, machine::Services services, Options options);
    ~Board() override;
    Board(const Board&) = delete;
    Board& operator=(const Board&) = delete;

    /// Switches the board on, or resets it: queues are emptied, the boot messages queued, the schedule starts
    /// anew.
    void power_on(SimTime now);

    /// Bytes from the other end of a line; any split of the stream gives the same result.
    void receive(SimTime now, std::string_view bytes, Channel channel = Channel::main);
    /// Whether somebody is at the other end of a line: of the main line somebody always is, of the others at
    /// first nobody. What would go to nobody is not said.
    void connect(Channel channel, bool connected) { ports_[index(channel)].connected = connected; }
    /// One whole line, line end left off, as if it had come on the main line: beside whatever half line is
    /// arriving there.
    void hear(SimTime now, std::string_view line);
    /// Whether a line that speaks as a host has sent so much ahead that its sender should be held up, as USB
    /// does it: what comes all the same is lost at some point, and told.
    bool crowded(Channel channel) const { return port(channel).commands.crowded(); }
    /// Commands of such a line that wait for their turn.
    std::size_t waiting(Channel channel) const { return port(channel).commands.size(); }
    /// A datagram of the network from `peer`, a number that is not 0: one request, or a piece of the file
    /// that it uploads. Carried out at once; what the board says to it is for take_datagrams().
    void receive_datagram(SimTime now, std::uint64_t peer, std::string_view bytes);
    /// Calls out(peer, bytes) for each datagram to send, and forgets them.
    template <class Out>
    void take_datagrams(Out&& out) {
        network_.take(std::forward<Out>(out));
    }
    /// Does something to the machine: an action without required arguments, by name or by phrase ("filament
    /// in"). False when there is none of that name.
    bool world(SimTime now, std::string_view phrase);
    /// Carries out one compiled action, as world() does. What the machine has against it, also told as a
    /// notice; empty when it was done.
    std::string act(SimTime now, const behaviour::ActionCall& call);
    /// Calls `use` with the machine brought up to now, and sees to what comes of it.
    /// `words`, if any, are told as what was done by hand, see Observer::on_world().
    void tinker(SimTime now, const std::function<void(machine::Machine& machine)>& use,
                std::string_view words = {});
    /// Sends one of the profile's frames, as a rule does; it has no request to take parameters from.
    void send_frame(SimTime now, const behaviour::Send& entry);
    /// Puts bytes on the wire to the screen, at once and as they are but for the line end, which is added
    /// when there is none.
    void send_raw(SimTime now, std::string_view bytes);
    /// Brings the machine up to `now`, so that its values are those of that moment and not of the last thing
    /// done. Changes nothing of what the board will say.
    void refresh(SimTime now);

    /// Does what is due up to `now`, but stops as soon as there is output. Returns when it wants to be called
    /// next; that may be in the past if it stopped early.
    SimTime advance(SimTime now);

    /// Bytes for the other end of a line, since the last clear_output(), which is for all of them.
    std::string_view output(Channel channel = Channel::main) const {
        return ports_[index(channel)].output.view();
    }
    void clear_output() {
        for (Port& port : ports_) {
            port.output.clear();
            port.deaf_at = nowhen;  // whoever was told of a bad line may send it again, at this very moment
        }
    }
    /// The moment of the last thing done.
    SimTime time() const { return time_; }

    /// Puts a changed profile in force: frames, rules and schedule at once; the machine's constants at the
    /// next start of the program. State, queues and variables of the same name stay. A profile of another
    /// kind of machine changes nothing.
    void reload(std::shared_ptr<const behaviour::Profile> profile);

    const Counters& counters() const { return counters_; }
    std::uint64_t lines_too_long() const;
    std::uint64_t nul_bytes() const;
    const behaviour::Profile& profile() const { return *profile_; }
    machine::Machine& machine() { return *machine_; }
    const machine::Machine& machine() const { return *machine_; }
    /// Of the profile's own variables, in its order.
    std::span<const double> variables() const { return variables_; }

  private:
    static constexpr SimTime nowhen{-1};
    /// One of the board's lines.
    struct Port {
        protocol::LineSplitter splitter;
        OutputBuffer output{0};
        bool connected = false;
        CommandQueue commands{0, 0};  ///< of a line that speaks as a host
        SimTime deaf_at = nowhen;     ///< a bad line came at that moment: what came with it is thrown away
    };
    static constexpr std::size_t index(Channel channel) { return static_cast<std::size_t>(channel); }
    Port& port(Channel channel) { return ports_[index(channel)]; }
    const Port& port(Channel channel) const { return ports_[index(channel)]; }

    void notice(Level level, std::string_view text) override;
    void take_line(Channel channel, std::string_view line);
    bool takes_commands(Channel channel) const;
    protocol::HostLineRules host_rules() const;
    protocol::HostLineFault judge(const protocol::HostLine& line, std::int64_t last, bool writing) const;
    std::string urgent_command(std::string_view line, const protocol::HostLine& framed,
                               protocol::HostLineFault fault) const;
    void take_command_line(Channel channel, std::string_view bytes);
    bool carry_out(std::string_view command, char letter, int code) override;
    void complain(Channel channel, machine::EventId event);
    bool begin_command();
    void carry_out(Channel channel, std::string_view command, bool acted);
    void tell_received(Channel channel, std::string_view line, Verdict verdict);
    void run_host();
    void run_own_requests();
    bool unframe(std::string_view line, std::string_view& body) const;
    /// Whether it was answered with its acknowledgement. `begun`: it is the command that HostCommands began.
    bool execute(Channel channel, std::string_view body, bool begun = false);
    std::optional<Channel> asker_on(Channel channel) const;
    void take_piece(std::uint64_t peer, const protocol::Chunk& chunk);
    machine::Transfer::Mishap mishap();
    void put_datagrams(std::span<char> message, bool block);
    void take_request(std::string_view bytes);
    void run_rule(const behaviour::Rule& rule, const behaviour::Scope& scope);
    struct Held;
    void hold(Held held);
    void end_held();
    bool run_rules(const std::vector<behaviour::Rule>& rules, const protocol::Command* command);
    void run_events();
    template <class Call>
    void call_front(Call&& call);
    SimTime front_due() const {
        return options_.front == nullptr ? machine::never : options_.front->next_due(*machine_);
    }
    void settle(std::optional<Channel> asker = std::nullopt);
    void send(const behaviour::Send& send, const behaviour::Scope& scope);
    std::size_t room_for(const behaviour::Frame& frame);
    void send_to(Channel to, const behaviour::Send& send, const behaviour::Scope& scope);
    void say_after();
    /// A message while it is written.
    struct Draft {
        std::span<char> room;
        std::size_t size = 0;
        unsigned lines = 0;
    };
    std::span<char> scratch();
    void compose(const behaviour::Frame& frame, const behaviour::Scope& scope, Draft& draft);
    void compose_line(const behaviour::Frame& frame, const behaviour::FrameTemplate& text,
                      const behaviour::Scope& scope, std::size_t end, Draft& draft);
    void queue(const behaviour::Send& send, const behaviour::Scope& scope);
    void said(std::size_t frame, const behaviour::Scope& scope);
    bool put_in_queue(std::string_view message);
    void emit(std::string_view message);
    void emit_code(std::size_t frame);
    void tell_sent(Channel channel, std::string_view message);
    bool quiet() const;
    void step(SimTime due);
    void catch_up(SimTime now);
    void run_slots(SimTime end);
    void run_tick();
    SimTime next_tick() const;
    SimTime next_due() const;
    SimTime nothing_before() const;
    void report_unknown(std::string_view word, std::string_view why);
    behaviour::Scope scope(const protocol::Command* command = nullptr) const;

    std::shared_ptr<const behaviour::Profile> profile_;
    Options options_;
    std::unique_ptr<machine::Machine> machine_;
    ScheduleRunner schedule_;
    std::array<Port, behaviour::channel_count> ports_;
    NetworkOutbox network_;
    MessageQueue inbox_;   ///< of the main line
    MessageQueue outbox_;  ///< same
    CodeQueue codes_;      ///< same, of a board that stores no messages
    RingIntake ring_;      ///< of the main line, if the board's is small
    /// A request of the main line that is still being carried out, and the rule it is carried out by.
    struct Held {
        const behaviour::Rule* rule = nullptr;
        std::string body;
        bool waits = false;  ///< for something else than moves
    };
    Held held_;
    std::optional<Channel>
        asker_;               ///< whom a frame goes to that does not say it itself; nothing: nobody asked
    bool unasked_ = false;    ///< a request is the machine's own: nobody is to be answered
    bool held_back_ = false;  ///< commands wait until output has been taken
    bool muted_ = false;      ///< a file's command: nobody hears what is for whoever asked
    bool answered_ = false;   ///< what is being carried out has been acknowledged by its answer
    const behaviour::Rule* after_ = nullptr;  ///< of the command that runs: what is said when it is over
    std::unique_ptr<char[]> scratch_;
    std::vector<double> variables_;
    Counters counters_;
    SimTime time_{0};
    SimTime power_on_{0};
    SimTime last_tick_{0};
    SimTime idle_before_ =
        nowhen;  ///< nothing falls due before that; known from catching up to the first change
    SimTime unfinished_due_ = machine::never;  ///< when an unfinished line of the main line counts as whole
    std::set<std::string, std::less<>> told_;  ///< unknown codes already warned of, bounded
};

}  // namespace fauxboard::board
