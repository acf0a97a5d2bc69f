#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/control/session.h"
#include "emulator/fault/fault_line.h"
#include "protocol/catalogue.h"

namespace fauxboard::control {

/// Why a line was not taken: "bad frame", "queue full"; empty when it was.
std::string_view refusal(board::Verdict verdict);

/// All clients of one board: hands them what passes. Is an observer of that board.
class Hub final : public board::Observer {
  public:
    /// `target` outlives this.
    explicit Hub(Target& target) : target_(target) {}

    /// The board has moved on to `now`, and its machine too (Board::refresh()). Cheap when nothing is due.
    /// Returns when it next wants to be called, machine::never if not at all. Ask anew after each visit.
    SimTime on_moved(SimTime now);
    /// The tested line's link changed; state as link::LinkState is called, `why` a sentence.
    void on_link(SimTime now, std::string_view state, std::string_view why);
    /// A changed profile is in force.
    void on_reload();
    /// A fault of the line has acted on `line`, which was as it is told; `to_board`: on its way there.
    void on_spoiled(SimTime now, const fault::Deed& deed);
    /// Whether any client has subscribed to it.
    bool wanted(TopicId topic) const;
    /// Tells those who have subscribed to it: {"event": its name, "t": ..., members...}.
    void publish(TopicId topic, SimTime now, const Json& members);
    /// The run is over.
    void on_end();

    void on_received(SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override;
    void on_sent(SimTime now, board::Channel channel, std::string_view line) override;
    void on_notice(SimTime now, board::Level level, std::string_view text) override;

    /// This client wants time to stand still, or no longer does; it goes on when nobody does.
    void hold(const Session& session, bool held);
    bool held() const { return !holding_.empty(); }

    Target& target() { return target_; }
    std::size_t size() const { return sessions_.size(); }

    /// Keeps what is noticed while it lives: for the answer to what caused it.
    class Listening {
      public:
        explicit Listening(Hub& hub) : hub_(hub) { hub_.heard_ = &notices; }
        ~Listening() { hub_.heard_ = nullptr; }
        Listening(const Listening&) = delete;
        Listening& operator=(const Listening&) = delete;
        Json notices = Json::array();

      private:
        Hub& hub_;
    };

  private:
    friend class Session;
    void add(Session& session) { sessions_.push_back(&session); }
    void remove(Session& session);
    template <class Make>
    void tell(TopicId topic, Make&& make);
    void tell_line(SimTime now, std::string_view from, std::string_view line, protocol::Direction direction,
                   board::Verdict verdict);

    Target& target_;
    std::vector<Session*> sessions_;
    std::vector<const Session*> holding_;
    Json* heard_ = nullptr;
};

}  // namespace fauxboard::control
