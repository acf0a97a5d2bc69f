#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "emulator/control/target.h"
#include "emulator/host/clock.h"
#include "emulator/host/live_board.h"
#include "emulator/host/live_observer.h"
#include "emulator/host/screen_plug.h"
#include "emulator/script/player.h"

namespace fauxboard::host {

/// A scenario on a live board: gives the player its turns, and the player its stage. Is an observer of that
/// board. Everything happens on the event loop's thread.
class ScriptHost final : public LiveObserver, private script::Stage {
  public:
    /// All but `screen` and `display` must be there; they outlive this object. `on_done` is called once, from
    /// inside a turn.
    struct Parts {
        LiveBoard& live;
        Clock& clock;
        fault::FaultControl* faults;
        ScreenPlug* screen;
        std::function<void()> on_done;
        std::function<void(std::string_view words)> say;
        control::Display* display = nullptr;  ///< what shows the board; null: nothing does
    };
    ScriptHost(Parts parts, std::shared_ptr<const script::Scenario> scenario, Speed speed);

    /// The scenario begins with the board's time.
    void start();
    /// It was ended from outside: "by SIGTERM".
    void interrupt(std::string_view why);
    const script::Player& player() const { return player_; }

    void on_received(SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override;
    void on_sent(SimTime now, board::Channel channel, std::string_view line) override;
    void on_notice(SimTime, board::Level, std::string_view) override {}
    void on_event(SimTime now, machine::EventId event) override;
    void on_link(SimTime, link::LinkState, std::string_view) override {}

  private:
    void visit(const std::function<void(board::Board&, SimTime)>& use) override { parts_.live.visit(use); }
    fault::FaultControl* faults() override { return parts_.faults; }
    const screen::Screen* screen() override {
        return parts_.screen == nullptr ? nullptr : &parts_.screen->screen();
    }
    screen::PressResult press(std::string_view path) override { return parts_.screen->press(path); }
    void note(std::string_view words) override { parts_.say(words); }
    control::Display* display() override { return parts_.display; }
    std::string keep_picture(const std::string& file, std::string_view png) override;

    void turn();
    void wake();

    Parts parts_;
    script::Player player_;
    std::unique_ptr<Alarm> alarm_;
    SimTime due_{0};  ///< what the player last returned
    SimTime real_start_{0};
    bool in_turn_ = false;
    bool running_ = false;
};

}  // namespace fauxboard::host
