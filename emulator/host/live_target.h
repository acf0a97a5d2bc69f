#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "emulator/control/hub.h"
#include "emulator/fault/fault_control.h"
#include "emulator/host/clock.h"
#include "emulator/host/curve_keeper.h"
#include "emulator/host/drawings.h"
#include "emulator/host/live_board.h"
#include "emulator/host/live_observer.h"
#include "emulator/host/screen_mirror.h"
#include "emulator/host/talk_keeper.h"
#include "emulator/link/event_loop.h"
#include "emulator/link/link.h"

namespace fauxboard::script {
class Player;
}

namespace fauxboard::host {

class ScreenPlug;

/// One live board as all who reach into it see it, be it through the control channel or the panel in the
/// browser: its hub of clients, time that jumps, faults, and what people look at beside it. Is an observer of
/// that board.
class LiveTarget final : public LiveObserver, private control::Target, private control::View {
  public:
    struct Parts {
        link::EventLoop& loop;
        board::Board& board;
        LiveBoard& live;
        Clock& clock;
        const link::Link& link;       ///< the tested line
        fault::FaultControl* faults;  ///< of it; null: it takes none
        std::function<void()> quit;   ///< ends the run; called from the event loop
        double speed = 1;             ///< virtual seconds per second; 0: as fast as it goes
        /// The touch screen that looks on, null where none is known for the board.
        std::shared_ptr<const screen::ScreenProfile> screen;
        control::Display* display = nullptr;  ///< what shows the board; null: nothing does
        /// What clients do that the board itself does not tell; may be empty.
        std::function<void(SimTime now, std::string_view sentence)> tell;
    };
    /// All of it outlives this. Follows `live`, so make it before that is started; hand it to the observers.
    explicit LiveTarget(Parts parts);
    ~LiveTarget() override;

    /// The virtual screen that is plugged into the main line, instead of one that looks on.
    void show(ScreenPlug& plug) { plug_ = &plug; }
    /// The scenario that is played.
    void show(const script::Player& player) { player_ = &player; }

    control::Hub& hub() { return hub_; }
    const board::Board& board() const override { return parts_.board; }
    SimTime now() const { return parts_.live.now(); }
    link::LinkState link_state() const { return parts_.link.state(); }
    std::size_t faults_in_force() const;
    /// A changed profile is in force.
    void on_reload() { hub_.on_reload(); }
    void on_deed(SimTime now, board::Channel channel, const fault::Deed& deed) override {
        if (channel == board::Channel::main) {
            hub_.on_spoiled(now, deed);
        }
    }
    /// The run is over: who waits is told so.
    void on_end();

    void on_received(SimTime now, board::Channel channel, std::string_view line,
                     board::Verdict verdict) override;
    void on_sent(SimTime now, board::Channel channel, std::string_view line) override;
    void on_notice(SimTime now, board::Level level, std::string_view text) override {
        hub_.on_notice(now, level, text);
    }
    void on_link(SimTime now, link::LinkState state, std::string_view why) override;

  private:
    // control::Target
    void visit(const std::function<void(board::Board&, SimTime)>& use) override { parts_.live.visit(use); }
    SimTime skip(SimTime by) override;
    void hold(bool held) override { parts_.clock.hold(held); }
    void quit() override { parts_.loop.post(parts_.quit); }
    fault::FaultControl* faults() override { return parts_.faults; }
    control::Display* display() override { return parts_.display; }
    void tell(SimTime now, std::string_view sentence) override {
        if (parts_.tell) parts_.tell(now, sentence);
    }
    control::Json status() const override;
    void on_wanted() override;
    control::View& view() override { return *this; }

    // control::View
    control::Json screen(SimTime now) override;
    control::Json press(board::Board& board, SimTime now, const control::Press& press) override;
    control::Json talk() override { return talk_.to_json(); }
    control::Json curves() override { return curves_.to_json(); }
    control::Json scenario() override;
    control::Json drawing(const board::Board& board, SimTime now) override;
    void look_at_drawing();

    void skip_on();
    ScreenMirror* mirror();
    void look();
    void look_at(control::TopicId topic, const control::Json& now);

    Parts parts_;
    control::Hub hub_;
    TalkKeeper talk_;
    CurveKeeper curves_;
    Drawings drawings_;
    std::optional<ScreenMirror> mirror_;  ///< while somebody looks
    SimTime mirror_used_{0};
    ScreenPlug* plug_ = nullptr;
    const script::Player* player_ = nullptr;
    link::Timer look_;
    bool looking_ = false;
    std::map<control::TopicId, std::string> shown_;  ///< as last told
    SimTime skip_to_{0};                             ///< virtual time is to jump that far
    /// What is posted to the event loop finds this gone when this object is.
    std::shared_ptr<int> life_ = std::make_shared<int>();
};

}  // namespace fauxboard::host
