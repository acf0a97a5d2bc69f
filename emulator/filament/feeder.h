#pragma once

#include "emulator/filament/config.h"
#include "emulator/filament/names.h"

namespace fauxboard::filament {

/// Loading, unloading and cleaning: pieces of filament, one after the other, until stopped (M2105).
class Feeder {
  public:
    enum class Mode : std::uint8_t { idle, load, unload, clean };

    explicit Feeder(const FilamentConfig& config) : config_(config) {}

    void power_on();
    void advance(SimTime now, EventQueue& events);
    SimTime next_event() const { return mode_ == Mode::idle ? never : next_; }

    /// The first piece starts now; each further one raises `filament.piece` when it starts.
    void start(Mode mode, SimTime now);
    /// One piece of 10 mm, after which `filament.stopped` is raised.
    void feed_once(SimTime now);
    /// Ends the run: at once, or, when the piece under way is well begun, after it (measured on three stops).
    void stop(SimTime now, EventQueue& events);

    Mode mode() const { return mode_; }
    /// Filament that the extruder was turned for since the machine was made, mm; back is negative.
    double fed_mm() const { return fed_; }

  private:
    const FilamentConfig& config_;
    Mode mode_ = Mode::idle;
    SimTime piece_start_{0};
    SimTime next_ = never;
    bool stopping_ = false;
    double fed_ = 0;
};

}  // namespace fauxboard::filament
