#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/dlp/event.h"
#include "emulator/dlp/lamp.h"
#include "emulator/dlp/platform.h"
#include "emulator/dlp/print_file.h"
#include "emulator/dlp/quirks.h"
#include "emulator/dlp/stick.h"
#include "emulator/dlp/time.h"
#include "emulator/dlp/uv_panel.h"

namespace fauxboard::dlp {

enum class PrintState : std::uint8_t {
    idle,
    homing_preup,
    homing_fast,
    homing_up,
    homing_slow,
    free_moving,
    move_to_layer,
    light_pause,
    light,
    lift,
    drop,
    pause_lift,
    last_lift
};
std::string_view to_string(PrintState state);

/// What the process works with. All outlive it.
struct PrintParts {
    Platform& platform;
    Lamp& lamp;
    UvPanel& panel;
    Stick& stick;
    const Settings& settings;
    const Quirks& quirks;
    Listener& listener;
    Firmware firmware;
};

/// The motion of the board: homing, moves by hand, and a print from its homing to its last lift. Each state
/// ends when the platform stands, a countdown is over, or a picture is loaded.
class Print {
  public:
    explicit Print(const PrintParts& parts) : parts_(parts) {}

    void power_on();
    void advance(SimTime now);
    SimTime next_event() const;

    /// Opens the file and homes for it. False when it cannot be opened; problem() tells why.
    bool start(const std::string& path, SimTime now);
    /// The pause button: the flag, at once. False when nothing is printed, or nothing changes.
    bool set_paused(bool paused, SimTime now);
    bool stop(SimTime now);
    /// By hand. False while anything else moves.
    bool home(SimTime now);
    bool jog(double mm, SimTime now);
    bool raise_after_zero(SimTime now);
    bool stop_moving(SimTime now);
    /// The motor lost its hold.
    void forget_home() { homed_ = false; }

    PrintState state() const { return state_; }
    bool active() const { return file_.has_value() || state_ == PrintState::last_lift; }
    bool finishing() const { return state_ == PrintState::last_lift; }
    bool cancelled() const { return cancelled_; }
    bool paused() const { return paused_; }
    bool standing() const { return state_ == PrintState::pause_lift && !parts_.platform.busy() && paused_; }
    bool homing() const { return state_ >= PrintState::homing_preup && state_ <= PrintState::homing_slow; }
    bool homed() const { return homed_; }
    const std::string& path() const { return path_; }
    const std::string& problem() const { return problem_; }
    std::uint32_t layer() const { return layer_ + 1; }
    std::uint32_t layers() const { return layers_; }
    std::uint32_t sublayer() const {
        return state_ == PrintState::light && parts_.lamp.counting() ? sublayer_ + 1 : 0;
    }
    std::uint32_t antialiasing() const { return file_ ? file_->antialiasing() : 1; }
    std::uint32_t estimate_s() const { return estimate_s_; }
    std::uint32_t bad_layers() const { return bad_layers_; }
    /// The bank holds the picture sent last, line for line.
    bool picture_arrived() const { return picture_sum_ == parts_.panel.fpga().sum(0); }
    /// Of the layer that is printed, or whose picture is shown.
    const LayerPlan& plan() const { return plan_; }
    /// In 32-bit floats, as the board reckons; n / N x 100.
    float percent() const;
    /// Without homing, pauses and the last lift.
    SimTime elapsed(SimTime now) const { return elapsed_ + (counts_ ? now - counted_from_ : SimTime{0}); }
    /// All since its start; of the last print when none is under way.
    SimTime wall(SimTime now) const { return (active() ? now : wall_end_) - started_; }
    /// Of one picture of the layer: with antialiasing a part of the layer's.
    SimTime exposure() const;

    /// Working times of a print that just ended; taken by whoever keeps the counters.
    struct Worked {
        SimTime lit{0};
        SimTime wall{0};
    };
    std::optional<Worked> take_worked();
    /// Of one under way, since it was counted last; the rest comes with its end.
    std::optional<Worked> worked_so_far(SimTime now);

    /// Changes that hold from the next layer on that is read (0.08).
    struct Changes {
        std::optional<double> bottom_light_s, light_s, light_pause_s, lift_mm, lift_mm_s, drop_mm_s;
        std::optional<bool> individual;
    };
    Changes changes;
    const std::optional<PrintFile>& file() const { return file_; }

    double load_factor = 1;  ///< a slow stick: how many times as long a picture takes

  private:
    // print_motion.cpp
    void begin_homing(SimTime now);
    void homing_step(SimTime now);
    void fail_homing(SimTime now);
    void at_home(SimTime now);
    bool home_closed(SimTime now) const;
    double home_side() const { return parts_.settings.motor.home_direction < 0 ? -1 : 1; }
    void go(double mm, double mm_s, double mm_s2, SimTime now, bool switches = false);
    double slow_travel() const;
    void go_up(SimTime now);
    void go_down(SimTime now);
    void go_to_pause(SimTime now);
    void go_back_from_pause(SimTime now);
    void go_to_end(SimTime now);

    void enter(PrintState state) { state_ = state; }
    void moved(SimTime now);
    void begin_printing(SimTime now);
    bool read_plan(std::uint32_t n, LayerPlan& plan);
    void apply_changes(std::uint32_t n, LayerPlan& plan) const;
    void begin_load(SimTime now);
    void end_load(SimTime now);
    void lose_picture(const std::string& why, SimTime now);
    void lights_on(SimTime now);
    void end_light(SimTime now);
    void end_layer(SimTime now);
    void note_bad_lines(unsigned lines, SimTime now);
    void begin_pause_lift(SimTime now);
    bool stand_paused(SimTime now);
    void go_on(SimTime now);
    void complete(SimTime now);
    void finished(SimTime now);
    void count(bool on, SimTime now);
    bool step(SimTime now);
    double zero() const { return static_cast<double>(parts_.settings.general.zero_pos_mm); }

    PrintParts parts_;
    PrintState state_ = PrintState::idle;
    std::optional<PrintFile> file_;
    std::string path_;
    std::string problem_;
    LayerPlan plan_;
    std::uint32_t layer_ = 0;  ///< from 0
    std::uint32_t layers_ = 0;
    std::uint32_t sublayer_ = 0;
    std::uint32_t estimate_s_ = 0;
    std::uint32_t bad_layers_ = 0;
    bool homed_ = false;
    bool for_print_ = false;  ///< homing is for a print
    bool paused_ = false;
    bool cancelled_ = false;
    bool needs_picture_ = false;  ///< the layer's picture could not be loaded
    bool rise_told_ = false;
    std::uint64_t picture_sum_ = 0;  ///< of the lines sent, see Fpga::sum()
    SimTime load_begun_{0};
    SimTime load_due_ = never;
    SimTime until_ = never;  ///< end of a countdown
    SimTime started_{0};
    SimTime counted_to_{0};
    SimTime wall_end_{0};
    SimTime elapsed_{0};
    SimTime counted_from_{0};
    bool counts_ = false;
    std::optional<Worked> worked_;
};

}  // namespace fauxboard::dlp
