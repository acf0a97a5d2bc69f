#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "emulator/board/front.h"
#include "emulator/screen/scene.h"
#include "emulator/touch/finger.h"
#include "emulator/touch/number_entry.h"

namespace fauxboard::touch {

/// A touch screen that is part of a board: fingers in, actions on the board's machine out. What it shows and
/// does is its profile's (screen::Display); nothing here knows a particular one. No clock, no I/O, no fonts.
/// It costs nothing between events: what it shows is worked out when somebody looks.
class TouchScreen final : public board::Front {
  public:
    /// `profile` must have a display.
    explicit TouchScreen(std::shared_ptr<const screen::ScreenProfile> profile);

    void power_on(SimTime now, behaviour::ActionContext& context) override;
    void on_event(SimTime now, machine::EventId event, behaviour::ActionContext& context) override;
    SimTime next_due(const machine::Machine& machine) const override;
    void advance(SimTime now, behaviour::ActionContext& context) override;

    /// What became of a touch.
    struct Touched {
        std::string why;  ///< it was not taken; empty when it was
        SimTime done{0};  ///< when the finger has been taken off and what comes of it is done
    };
    /// Puts a finger on the glass for `how_long`, at a pixel of the picture as the glass shows it.
    Touched touch(SimTime now, int x, int y, SimTime how_long);
    /// The same in the middle of the control called so, of those that are there now: by name or label.
    Touched touch(SimTime now, const machine::Machine& machine, std::string_view name, SimTime how_long);

    /// What it shows. `machine` is brought up to now.
    screen::Scene scene(const machine::Machine& machine) const;
    /// Where it stands, for whoever looks for a way through the pages.
    screen::Standpoint standpoint(const machine::Machine& machine) const;
    const screen::ScreenProfile& profile() const { return *profile_; }

  private:
    const screen::Display& display() const { return *profile_->display; }
    void refresh(const machine::Machine& machine) const;
    std::size_t on_top() const { return layers_.cover.value_or(layers_.box.value_or(layers_.page)); }
    SimTime idle_due(const machine::Machine& machine) const;
    void fall_idle(SimTime now, behaviour::ActionContext& context);

    void keep_place(const Contact& contact);
    /// Where the program takes the finger to be on the picture as it is drawn.
    std::pair<int, int> felt(const screen::Scene& here) const;
    void press(behaviour::ActionContext& context);
    void hold(SimTime now, behaviour::ActionContext& context);
    void release(behaviour::ActionContext& context);
    void type(const screen::Control& control);

    /// The rows' texts are kept while effects change the lists they come from.
    struct Row {
        std::size_t number = 0;
        std::string text;
        std::vector<std::string> cells;
    };
    /// False when the conditions of none hold.
    bool run(const screen::Effects& effects, const Row& row, behaviour::ActionContext& context);
    void run(const screen::Effect& effect, const Row& row, behaviour::ActionContext& context);
    void assume(const std::vector<screen::Assign>& assigns, const screen::Scope& scope);
    void go(const screen::Target& target, behaviour::ActionContext& context);
    void open_page(std::size_t page, behaviour::ActionContext& context);
    void uncover(behaviour::ActionContext& context);
    void start_entry(const screen::Entry& entry);
    void show_entry(const screen::Entry& entry);

    std::shared_ptr<const screen::ScreenProfile> profile_;
    mutable std::vector<screen::Shown> values_;
    Finger finger_;
    screen::Layers layers_;
    std::size_t before_ = 0;
    bool on_ = false;
    bool swallowed_ = false;  ///< the finger that is down has done all it does
    NumberEntry entry_;
    SimTime touched_{0};  ///< when the delay until idleness began
    SimTime idle_not_before_{0};
    int depth_ = 0;  ///< of pages whose opening opens others
};

}  // namespace fauxboard::touch
