#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "emulator/dlp/acfg.h"
#include "emulator/dlp/board_config.h"
#include "emulator/dlp/calendar.h"
#include "emulator/dlp/eeprom_chip.h"
#include "emulator/dlp/file_list.h"
#include "emulator/dlp/motor.h"
#include "emulator/dlp/previews.h"
#include "emulator/dlp/print.h"
#include "emulator/dlp/uv_test.h"
#include "emulator/dlp/watch.h"

namespace fauxboard::dlp {

/// What one is doing to the settings.
enum class SetupTask : std::uint8_t { none, loading, saving };

/// The whole board: its start, what its buttons ask for, and what goes on by itself. Knows neither pages nor
/// boxes.
class MksBoard final : private Listener {
  public:
    /// All outlive it; `cells` may be null.
    MksBoard(const BoardConfig& config, Stick& stick, machine::EepromCells* cells, std::uint64_t seed,
             Listener& listener);

    /// Starts the board's program. What is physical stays as it is.
    void power_on(SimTime now);
    /// The supply goes: what was being written to the EEPROM stays undone, the panel forgets its pictures.
    void cut_power(SimTime now);
    void advance(SimTime now);
    SimTime next_event() const;
    /// Sees to what comes of an action.
    void settle(SimTime now);

    bool ready() const { return ready_due_ == never; }
    bool dozing() const { return dozing_; }
    /// The fan that cools the board (0.08). What its modes mean is not known; chosen: 0 off, 1 while the
    /// lamp's fan runs, 2 always. 3, which stands for whatever is more in a settings file, is no mode: off.
    bool board_fan() const;
    /// Of the start: "", "periphery", "panel_configuring", ...
    std::string_view start_step(SimTime now) const;

    // What its buttons ask for. False: not now.
    // ------------------------------------------------------------------------
    bool print_viewed(SimTime now);
    bool print_file(const std::string& path, SimTime now);
    bool view(std::string_view name);
    bool delete_viewed();
    bool set_zero(SimTime now);
    bool load_setup(std::string_view name, SimTime now);
    bool save_setup(SimTime now);
    bool set_language(int language, SimTime now);
    /// Seconds are 0 from now on. The external clock is set, too, where the settings use it.
    void set_clock(const Moment& moment, SimTime now);
    /// Takes what the touch sensor read at the three targets, and keeps what comes of it.
    bool calibrate_touch(const std::array<GlassPoint, 3>& read, SimTime now);
    void reset_touch(SimTime now);
    bool choose_image(unsigned image, SimTime now);
    void touch_sound(SimTime now);
    void doze(SimTime now);
    void wake(SimTime now);
    void reset_counters(SimTime now);
    /// A stick came, or went.
    void stick_changed();

    // ------------------------------------------------------------------------
    struct View {
        std::string name;
        std::string path;
        std::uint64_t bytes = 0;
        std::string date;  ///< see date_text()
        std::optional<PrintFile> file;
        std::string problem;
    };
    const View& viewed() const { return view_; }
    struct Sound {
        SimTime until{0};
        SimTime last{0};
    };
    const Sound& sound() const { return sound_; }
    SetupTask setup_task() const { return task_; }
    const std::string& setup_file() const { return setup_file_; }
    /// Of the settings file loaded last; nothing before the first, and when it could not be opened.
    const std::optional<AcfgReport>& setup_report() const { return report_; }
    bool setup_opened() const { return setup_opened_; }

    const BoardConfig& config() const { return config_; }
    Stick& stick() { return stick_; }
    const Stick& stick() const { return stick_; }

    Settings settings;
    WorkCounters counters;
    Quirks quirks;
    Platform platform;
    Lamp lamp;
    UvPanel panel;
    Motor motor;
    Print print;
    UvTest uv_test;
    FileList files;
    Previews previews;
    Calendar calendar;
    ExternalClock external_clock;
    GlassPoint sensor_shift;  ///< how far beside the finger the touch sensor feels it
    Watch watch;
    EepromChip eeprom;

  private:
    void raise(Event event) override;
    void watch_event(Event event);
    void note(const std::string& text) override { listener_.note(text); }
    bool uses_external_clock() const { return settings.general.external_clock != 0 && !external_clock.dead; }
    void write_block(Block block, SimTime now);
    /// Keeps the general settings; `done` is raised when the chip has them all. False: others are being kept.
    bool keep_general(Event done, SimTime now);
    void sound_for(std::uint32_t time_ms);
    void read_setup(SimTime now);
    void end_setup(Event event);
    void count(const std::optional<Print::Worked>& worked, SimTime now);
    void start_panel(SimTime now);

    BoardConfig config_;
    Stick& stick_;
    Listener& listener_;
    View view_;
    Sound sound_;
    SetupTask task_ = SetupTask::none;
    std::optional<Event> task_event_;  ///< raised when the EEPROM has it all
    std::string setup_file_;
    std::string setup_path_;
    std::optional<AcfgReport> report_;
    bool setup_opened_ = true;
    bool dozing_ = false;
    bool supplied_ = false;
    SimTime read_due_ = never;
    SimTime hour_due_ = never;   ///< when the working times are kept next
    SimTime panel_due_ = never;  ///< when the start comes to the panel
    SimTime ready_due_ = never;
    SimTime started_{0};
    SimTime now_{0};
};

}  // namespace fauxboard::dlp
