#pragma once

#include <memory>
#include <optional>
#include <span>

#include "emulator/screen/tour.h"
#include "tools/screen_session.h"

namespace fauxboard::tools {

/// Lets a tour, or a few presses, happen on a live screen, with the limits on waiting that all of them have:
/// it starts a moment after the board's first word, or when that is overdue for a board that only answers;
/// it ends when the tour is done, or when the board has said nothing at all in the time allowed.
class ScreenWalk : public host::ScreenUser {
  public:
    explicit ScreenWalk(ScreenSession& session) : session_(session) {}

    host::SimTime on_turn(host::SimTime now) final;
    void on_judged(const screen::Judgement&) override {}
    void on_link(link::LinkState state, std::string_view why) override;

    /// What has been pressed so far.
    std::span<const screen::TourResult> results() const;

  protected:
    /// The tour, or nothing when there is nothing to press.
    virtual std::unique_ptr<screen::Tour> make_tour(host::SimTime now) = 0;
    virtual void on_result(const screen::TourResult&) {}
    /// The tour is over. Returns when to be called again; ends the session when all is said.
    virtual host::SimTime on_done(host::SimTime now) = 0;

    ScreenSession& session() const { return session_; }
    const screen::Tour* tour() const { return tour_.get(); }

  private:
    ScreenSession& session_;
    std::unique_ptr<screen::Tour> tour_;
    std::optional<host::SimTime> heard_;  ///< the first word
    bool started_ = false;
    std::size_t told_ = 0;
};

}  // namespace fauxboard::tools
