#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/board/board.h"
#include "emulator/control/session.h"

namespace fauxboard::control {

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
    /// The run is over.
    void on_end();

    void on_received(SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override;
    void on_sent(SimTime now, board::Channel channel, std::string_view line) override;
    void on_notice(SimTime now, board::Level level, std::string_view text) override;

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
    void remove(Session& session) { std::erase(sessions_, &session); }
    template <class Wanted, class Make>
    void tell(Wanted&& wanted, Make&& make);

    Target& target_;
    std::vector<Session*> sessions_;
    Json* heard_ = nullptr;
};

}  // namespace fauxboard::control
